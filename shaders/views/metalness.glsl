/*---
title  = "Metalness"
about  = """
The material's metalness alone, after its maps, without any light."""
material = ["metalness"]
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"

vec3 inspect(Material m) {
    return vec3(m.metalness);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(radiance);
}
#endif
