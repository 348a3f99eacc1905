/*---
title    = "Sobel on normals and distance"
equation = '\max_{x, y, z} (|g_x| + |g_y|) > \mathrm{threshold} \;\lor\; \frac{|g_x| + |g_y|}{d} > \mathrm{jump}'
source   = "Decaudin 1996, Cartoon-Looking Rendering of 3D Scenes"
about    = """
Also an outline where the distance jumps, so that the silhouette between two objects of the same \
normal is not missed. The jump is a share of the distance itself."""

[parameters.outline_jump]
kind    = "float"
default = 0.3
range   = [0.01, 4.0]
step    = 0.01
label   = "Outline distance jump"
---*/
#include "stages/outline.glsl"

float outline(ivec2 pixel) {
    vec4 g = edges(pixel);
    float d = texelFetch(u_normal_distance, pixel, 0).a;
    bool turns = max(max(g.x, g.y), g.z) > u_outline_threshold;
    bool jumps = d > 0.0 && g.w > u_outline_jump * d;
    return turns || jumps ? 1.0 : 0.0;
}
