/*---
title  = "Depth"
equation = '1 - d / d_\mathrm{black}'
about  = """
The distance from the eye, in metres; white is near, black as far as the slider says or farther."""

[parameters.depth_range]
kind    = "float"
default = 10.0
range   = [0.1, 1000.0]
step    = 0.1
scale   = "log"
unit    = "m"
label   = "Black from"
---*/
#if DRAWS_OBJECTS
#include "stages/varyings.glsl"
#include "lib/material.glsl"

vec3 inspect(Material m) {
    return vec3(length(v_position));
}
#else
#include "lib/display.glsl"

// The background, where nothing was drawn, counts as far.
vec3 view(vec3 radiance) {
    float d = radiance.x > 0.0 ? radiance.x : u_depth_range;
    return displayRange(vec3(1.0 - d / u_depth_range));
}
#endif
