/*---
title    = "White where it is too bright"
equation = 'T(L) = \max(L_r, L_g, L_b) > 1\ ?\ 1 : L'
source   = "a lab script on ray tracing, its main loop"
about    = "No curve: a pixel with any channel above 1 is white, so that nothing too bright is missed."
---*/
#include "lib/invalid.glsl"

// What is NaN, infinite or negative is none of the picture's light, and stays to be seen.
vec3 tonemap(vec3 radiance) {
    bool over = any(greaterThan(radiance, vec3(1.0)));
    return over && !invalid(radiance) ? vec3(1.0) : radiance;
}
