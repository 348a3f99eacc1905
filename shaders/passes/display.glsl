/*---
title = "Display"
about = "The linear picture through the chosen view to the display's code values."
draw  = "screen"
reads = ["linear"]

[writes.display]
format = "rgba8"
---*/
#include "lib/screen.glsl"
#if FRAGMENT

#include <view>
#include <quantisation>

out vec4 o_display;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 code = view(texelFetch(u_linear, pixel, 0).rgb);
    o_display = vec4(quantise(code, pixel), 1.0);
}

#endif
