/*---
title = "Tracing"
about = "A ray through the middle of each pixel."
draw  = "screen"
when  = "technique != 'raster' && view != 'light_depth' && view != 'overdraw'"

[writes.radiance]
format = "rgba32f"
scale  = "samples"
---*/
#include "lib/screen.glsl"
#if FRAGMENT

#include "lib/ray.glsl"
#include <technique>

uniform vec2 u_resolution;
uniform vec3 u_ray_right;
uniform vec3 u_ray_up;
uniform vec3 u_ray_forward;

out vec4 o_radiance;

// The eye is the origin of all positions. Of an orthographic camera the rays are parallel, and
// forward is their direction.
Ray primaryRay(vec2 pixel) {
    vec2 at = pixel / u_resolution * 2.0 - 1.0;
#if ORTHOGRAPHIC
#if TAKES_STEPS
    nextRight = 2.0 / u_resolution.x * u_ray_right;
    nextUp = 2.0 / u_resolution.y * u_ray_up;
#endif
    return Ray(at.x * u_ray_right + at.y * u_ray_up, u_ray_forward);
#else
    vec3 through = throughPicture(at, u_ray_right, u_ray_up, u_ray_forward);
    float away = length(through);
#if TAKES_STEPS
    nextRight = 2.0 / (away * u_resolution.x) * u_ray_right;
    nextUp = 2.0 / (away * u_resolution.y) * u_ray_up;
#endif
    return Ray(vec3(0.0), through / away);
#endif
}

void main() {
    o_radiance = vec4(trace(primaryRay(gl_FragCoord.xy)), 1.0);
}

#endif
