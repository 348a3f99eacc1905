/*---
title = "Outlines"
about = "Lines over the picture, where the outline choice finds an edge."
draw  = "screen"
reads = ["linear"]
when  = "outline != 'none'"

[writes.linear]
format = "rgba32f"

[parameters.outline_color]
kind    = "color"
default = [0.0, 0.0, 0.0]
label   = "Outline colour"
---*/
#include "lib/screen.glsl"
#if FRAGMENT

#include <outline>

out vec4 o_linear;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 behind = texelFetch(u_linear, pixel, 0).rgb;
    o_linear = vec4(mix(behind, u_outline_color, outline(pixel)), 1.0);
}

#endif
