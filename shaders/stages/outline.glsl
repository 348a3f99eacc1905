/*---
title = "Edges of normals and distances"
source = "Akenine-Moller et al. 2018, Real-Time Rendering, 4th ed., section 15.2.3"
about = """
The Sobel operator over the buffer of normals and distances. Its step shrinks with distance, as \
things do, down to a pixel."""
reads = ["normal_distance"]

[parameters.outline_threshold]
kind    = "float"
default = 0.6
range   = [0.05, 4.0]
step    = 0.05
label   = "Outline threshold"

[parameters.outline_width]
kind    = "float"
default = 6.0
range   = [1.0, 40.0]
step    = 0.5
unit    = "px"
label   = "Outline step at 1 m, in a picture 1000 high"
---*/
#include "lib/sobel.glsl"

// Step in pixels between the operator's samples at a distance, in a picture so many rows high; the
// background counts as far.
int outlineStep(float distance, int rows) {
    float width = u_outline_width * float(rows) / 1000.0;
    return distance > 0.0 ? max(1, int(width / distance + 0.5)) : 1;
}

vec4 edges(ivec2 pixel) {
    ivec2 last = textureSize(u_normal_distance, 0) - 1;
    int d = outlineStep(texelFetch(u_normal_distance, pixel, 0).a, last.y + 1);
    vec4 s[9];
    for (int i = 0; i < 9; ++i) {
        ivec2 at = clamp(pixel + d * ivec2(i % 3 - 1, 1 - i / 3), ivec2(0), last);
        s[i] = texelFetch(u_normal_distance, at, 0);
    }
    return sobel(s[0], s[1], s[2], s[3], s[5], s[6], s[7], s[8]);
}
