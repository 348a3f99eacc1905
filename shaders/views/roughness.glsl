/*---
title  = "Roughness"
about  = """
The material's roughness alone, after its maps, without any light."""
material = ["roughness"]
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"

vec3 inspect(Material m) {
    return vec3(m.roughness);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(radiance);
}
#endif
