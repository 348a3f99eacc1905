/*---
title  = "G alone"
equation = 'G(l, v, h)'
about  = """
The share of facets that both the light and the viewer see. The mean over the lights that the surface faces."""
material = ["roughness"]
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"
#include "lib/alpha.glsl"
#include "lib/frame.glsl"
#include <masking>

vec3 term(Material m, vec3 l, vec3 v) {
    return v.z > 0.0 ? vec3(masking(l, v, halfVector(l, v), alphaFromRoughness(m.roughness))) : vec3(0.0);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(radiance);
}
#endif
