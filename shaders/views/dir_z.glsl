/*---
title  = "Ray direction, z"
equation = '\frac{1}{2} + \frac{1}{2} d_z'
source = "a lab script on ray tracing, eq. 1.16"
about  = "The z of the direction from the eye, unit, to what is seen: -1 to 1 as 0 to 1 of blue."
signed = true
---*/
#if DRAWS_OBJECTS
#include "stages/eye.glsl"
#include "lib/material.glsl"

vec3 inspect(Material m) {
    float d = -towardsEye().z;
    return vec3(0.0, 0.0, d);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    float d = 0.5 + 0.5 * radiance.z;
    return displayRange(vec3(0.0, 0.0, d));
}
#endif
