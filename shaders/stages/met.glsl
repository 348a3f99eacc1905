/*---
title = "What a ray met"
about = "Where rasterisation interpolates between vertices, a shape gives its own values at a point."
---*/
#include "stages/nearest.glsl"
#include "stages/varyings.glsl"

#if TAKES_STEPS
// Of a ray through the next pixel to the right and of the one above: how far they are away, after a
// metre or (orthographic) anywhere. And how far the ray has come before it was sent on.
vec3 nextRight;
vec3 nextUp;
float travelled = 0.0;

// Where a ray beside meets the plane across n, from where the ray itself does.
vec3 beside(vec3 offset, vec3 direction, vec3 n) {
    float along = dot(direction, n);
    return along == 0.0 ? offset : offset - direction * (dot(offset, n) / along);
}
#endif

#if LISTED
#include "stages/met_listed.glsl"
#elif TAKES_OWN
#include "stages/met_own.glsl"
#endif

void met(inout Hit hit, Ray ray) {
    vec3 right = vec3(0.0);
    vec3 up = vec3(0.0);
#if TAKES_STEPS
    travelled += hit.distance;
#if ORTHOGRAPHIC
    float away = 1.0;
#else
    float away = travelled;
#endif
    right = beside(away * nextRight, ray.direction, hit.normal);
    up = beside(away * nextUp, ray.direction, hit.normal);
#endif
#if TAKES_FRONT
    v_front = dot(ray.direction, hit.normal) < 0.0;
#if LISTED
    v_front = v_front || int(hit.what.y) % 2 == 0;
#else
#for OBJECTS
#if !@{double}
    v_front = v_front || hit.object == @{index};
#endif
#endfor
#endif
#endif
#if TAKES_UV1
    v_uv1 = vec2(0.0);
#endif
#if TAKES_UV1 && TAKES_STEPS
    v_uv1_steps = vec4(0.0);
#endif
#if LISTED || TAKES_OWN
    metOwn(hit, right, up);
#endif
#if TAKES_POSITION
    v_position = hit.position;
#endif
#if TAKES_NORMAL
    v_normal = hit.shading;
#endif
#if TAKES_TO_EYE
    v_to_eye = -ray.direction;
#endif
}
