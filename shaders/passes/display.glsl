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

out vec4 o_display;

void main() {
    o_display = vec4(view(texelFetch(u_linear, ivec2(gl_FragCoord.xy), 0).rgb), 1.0);
}

#endif
