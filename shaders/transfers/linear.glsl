/*---
title    = "Linear"
equation = "c' = c"
source   = "the identity"
about    = """
No encoding, for a target that is linear itself; an ordinary display shows it far too dark."""
---*/
#include "lib/display.glsl"

vec3 transfer(vec3 linear) {
    return displayRange(linear);
}
