/*---
title  = "Overdraw"
about  = """
How often each pixel is shaded when nothing is hidden: black none, then blue, green, yellow, red for as many as the slider says or more."""

[parameters.overdraw_range]
kind    = "float"
default = 8.0
range   = [1.0, 64.0]
step    = 1.0
unit    = "layers"
label   = "Red from"
---*/
#include "lib/heat.glsl"

vec3 view(vec3 radiance) {
    return heat(radiance.x / u_overdraw_range);
}
