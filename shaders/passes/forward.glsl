/*---
title = "Forward shading"
about = "Every object once, every light in turn, into linear radiance."
draw  = "objects"

[writes.radiance]
format = "rgba32f"
scale  = "samples"
depth  = true

[parameters.sphere_error]
kind    = "float"
default = 0.1
range   = [0.01, 4.0]
step    = 0.01
unit    = "px"
label   = "Sphere silhouette error"

[parameters.subdivision]
kind    = "int"
default = -1
range   = [-1, 7]
step    = 1
label   = "Sphere subdivision (-1 follows the error)"
---*/
#if VERTEX

uniform mat4 u_model;
uniform mat4 u_view_projection;
in vec3 a_position;
#if LIGHT_COUNT
uniform mat3 u_normal_matrix;
in vec3 a_normal;
out vec3 v_position;
out vec3 v_normal;
#endif

void main() {
    vec4 position = u_model * vec4(a_position, 1.0);
    gl_Position = u_view_projection * position;
#if LIGHT_COUNT
    v_position = position.xyz;
    v_normal = u_normal_matrix * a_normal;
#endif
}

#endif
#if FRAGMENT

#include "lib/material.glsl"
#include "lib/light.glsl"
#include <ambient>
#if LIGHT_COUNT
#include "lib/frame.glsl"
#include <model>
#include <shadow>
#endif
#if POSITIONAL_LIGHT_COUNT
#include <attenuation>
#endif
#if SPOT_LIGHT_COUNT
#include "lib/spot.glsl"
#endif

#for MATERIAL_FIELDS
uniform @{type} u_@{name};
#endfor
#for LIGHTS
uniform vec3 u_light@{index}_intensity;
#if @{positional}
uniform vec3 u_light@{index}_position;
#for LIGHT_FIELDS
uniform @{type} u_light@{index}_@{name};
#endfor
#else
uniform vec3 u_light@{index}_direction;
#endif
#if @{spot}
uniform vec3 u_light@{index}_axis;
uniform float u_light@{index}_cos_inner;
uniform float u_light@{index}_cos_outer;
#endif
#endfor

out vec4 o_radiance;

#if LIGHT_COUNT
in vec3 v_position;
in vec3 v_normal;

#if !BRDF_COS
vec3 brdfCos(Material m, vec3 l, vec3 v) {
    return brdf(m, l, v) * l.z;
}
#endif
#endif

#if POSITIONAL_LIGHT_COUNT
// A light nearer than 1e-12 m stands on the surface: it has no direction and adds nothing.
const float MIN_SQUARED_DISTANCE = 1e-24;
#endif

void main() {
    Material m;
#for MATERIAL_FIELDS
    m.@{name} = u_@{name};
#endfor
    vec3 radiance = ambient(m);

#if LIGHT_COUNT
    vec3 toEye = -normalize(v_position);
    vec3 n = facingNormal(unitNormal(v_normal, toEye), toEye);
    mat3 frame = basis(n);
    vec3 v = toEye * frame;
#endif

#for LIGHTS
    {
#if @{positional}
        vec3 offset = u_light@{index}_position - v_position;
        float squared = dot(offset, offset);
        float inverse = inversesqrt(max(squared, MIN_SQUARED_DISTANCE));
        float distance = squared * inverse;
        vec3 toLight = offset * inverse;
#else
        vec3 toLight = u_light@{index}_direction;
#endif
        vec3 l = toLight * frame;
        Light light;
        light.intensity = u_light@{index}_intensity;
#if @{positional}
#for LIGHT_FIELDS
        light.@{name} = u_light@{index}_@{name};
#endfor
        light.intensity *= attenuation(distance, light);
#endif
#if @{spot}
        light.intensity *= spot(-dot(toLight, u_light@{index}_axis),
                                u_light@{index}_cos_inner, u_light@{index}_cos_outer);
#endif
        vec3 reflected = brdfCos(m, l, v) * light.intensity * shadow(v_position);
        radiance += l.z > 0.0 ? reflected : vec3(0.0);
    }
#endfor

    o_radiance = vec4(radiance, 1.0);
}

#endif
