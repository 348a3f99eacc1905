/*---
title    = "Sobel on normals"
equation = '\max_{x, y, z} (|g_x| + |g_y|) > \mathrm{threshold}'
source   = "Gonzalez & Wintz, Digital Image Processing"
about    = """
An outline where the normal turns within a pixel. Where two objects meet with the same normal it \
sees no edge."""
---*/
#include "stages/outline.glsl"

float outline(ivec2 pixel) {
    vec3 g = edges(pixel).xyz;
    return max(max(g.x, g.y), g.z) > u_outline_threshold ? 1.0 : 0.0;
}
