/*---
title = "Light after light"
about = "What the surface sends to the viewer of the lights' direct light, light by light."
---*/
#include "lib/frame.glsl"
#include "lib/light.glsl"
#include "lib/receiver.glsl"
#include "stages/light_uniforms.glsl"
#if !(REFLECTED || TERM || SEEN)
#include <model>
#endif
#if CASTER_COUNT && !UNSHADOWED
#include <shadow>
#endif
#if POSITIONAL_LIGHT_COUNT && !(TERM || SEEN || (TONE_LEVEL && !REFLECTED))
#include <attenuation>
#endif
#if SPOT_LIGHT_COUNT
#include "lib/spot.glsl"
#endif

// Distance of a light that is at none.
const float FAR_AWAY = 3e38;

#if POSITIONAL_LIGHT_COUNT
// A light nearer than 1e-12 m stands on the surface: it has no direction and adds nothing.
const float MIN_SQUARED_DISTANCE = 1e-24;
#endif

#if !(BRDF_COS || REFLECTED || TERM || SEEN)
vec3 brdfCos(Material m, vec3 l, vec3 v) {
    return brdf(m, l, v) * l.z;
}
#endif

// r has all but what the light adds; toEye unit, world. Sum over the lights of brdf(l, v) E cos(theta_l). Of a model
// with tones, the tone of the mean level. Of a view of a term or of the shadows, their mean over the
// lights that the surface faces.
vec3 fromLights(Material m, Receiver r, vec3 toEye) {
    mat3 frame = basis(r.normal);
    vec3 v = toEye * frame;
    vec3 sum = vec3(0.0);
    float facing = 0.0;
#for LIGHTS
    {
#if @{positional}
        vec3 offset = u_light@{index}_position - r.position;
        float squared = dot(offset, offset);
        float inverse = inversesqrt(max(squared, MIN_SQUARED_DISTANCE));
        float distance = squared * inverse;
        vec3 toLight = offset * inverse;
#else
        vec3 toLight = u_light@{index}_direction;
#endif
        vec3 l = toLight * frame;
#if TERM
        sum += l.z > 0.0 ? term(m, l, v) : vec3(0.0);
        facing += l.z > 0.0 ? 1.0 : 0.0;
#else
        float share = 1.0;
#if @{casts} && !UNSHADOWED
        r.toLight = toLight;
        r.NoL = l.z;
#if @{positional}
        r.distance = distance;
#else
        r.distance = FAR_AWAY;
#endif
        share = shadow(@{index}, r);
#endif
#if SEEN
        sum += l.z > 0.0 ? seen(share) : vec3(0.0);
        facing += l.z > 0.0 ? 1.0 : 0.0;
#else
#if @{spot}
        share *= spot(-dot(toLight, u_light@{index}_axis),
                      u_light@{index}_cos_inner, u_light@{index}_cos_outer);
#endif
#if TONE_LEVEL && !REFLECTED
        facing += toneLevel(max(l.z, 0.0) * share);
#else
        Light light;
        light.intensity = u_light@{index}_intensity;
#if @{positional}
#for LIGHT_FIELDS
        light.@{name} = u_light@{index}_@{name};
#endfor
        light.intensity *= attenuation(distance, light);
#endif
#if REFLECTED
        vec3 answer = reflected(m, l, v);
#else
        vec3 answer = brdfCos(m, l, v);
#endif
        sum += l.z > 0.0 ? answer * light.intensity * share : vec3(0.0);
#endif
#endif
#endif
    }
#endfor
#if TERM || SEEN
    return sum / max(facing, 1.0);
#elif TONE_LEVEL && !REFLECTED
    return toned(m, facing / float(LIGHT_COUNT));
#else
    return sum;
#endif
}
