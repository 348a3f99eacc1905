/*---
title = "Overdraw"
about = "Every fragment of every object adds one, whatever hides it."
draw  = "objects"
when  = "view == 'overdraw'"
blend = "add"

[writes.radiance]
format = "rgba32f"
scale  = "samples"
---*/
#include "stages/object.glsl"
#if FRAGMENT

#include "stages/opacity.glsl"

out vec4 o_radiance;

void main() {
    readOpacity(readTexels());
    o_radiance = vec4(1.0);
}

#endif
