/*---
title  = "Base colour"
about  = """
The material's base colour alone, after its maps, without any light."""
material = ["base_color"]
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"

vec3 inspect(Material m) {
    return m.base_color;
}
#else
#include "lib/display.glsl"
#include <transfer>

vec3 view(vec3 radiance) {
    return transfer(displayRange(radiance));
}
#endif
