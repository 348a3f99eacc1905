/*---
title  = "F alone"
equation = 'F(v \cdot h)'
about  = """
The share of light that a facet mirrors, per channel. The mean over the lights that the surface faces."""
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"
#include "lib/frame.glsl"
#include <fresnel>

vec3 term(Material m, vec3 l, vec3 v) {
    return v.z > 0.0 ? fresnel(m, dot(v, halfVector(l, v))) : vec3(0.0);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(radiance);
}
#endif
