/*---
title  = "D alone"
equation = 'D(h)'
about  = """
The density of facets that mirror the light to the viewer, in 1/sr. The mean over the lights that the surface faces."""
material = ["roughness"]
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"
#include "lib/alpha.glsl"
#include "lib/frame.glsl"
#include <distribution>

vec3 term(Material m, vec3 l, vec3 v) {
    return v.z > 0.0 ? vec3(distribution(halfVector(l, v), alphaFromRoughness(m.roughness))) : vec3(0.0);
}
#else
#include <tonemap>
#include <transfer>

vec3 view(vec3 radiance) {
    return transfer(tonemap(radiance));
}
#endif
