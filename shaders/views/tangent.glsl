/*---
title  = "Tangents"
equation = '\frac{1}{2} + \frac{1}{2} t'
about  = """
The direction in which u grows on the surface, x y z as red green blue, -1 to 1 as 0 to 1."""
signed = true
---*/
#if DRAWS_OBJECTS
#include "stages/varyings.glsl"
#include "lib/material.glsl"

vec3 inspect(Material m) {
    return normalize(v_tangent.xyz);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(0.5 + 0.5 * radiance);
}
#endif
