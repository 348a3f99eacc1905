/*---
title  = "Texture coordinates"
about  = """
u as red and v as green, each repeating from 0 to 1; v grows down the image."""
---*/
#if DRAWS_OBJECTS
#include "stages/varyings.glsl"
#include "lib/material.glsl"

vec3 inspect(Material m) {
    return vec3(fract(v_uv0), 0.0);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(radiance);
}
#endif
