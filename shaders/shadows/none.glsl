/*---
title    = "None"
equation = 'V = 1'
source   = "direct light without an occlusion test"
unit     = "1"
about    = "Every light reaches every point that faces it, through whatever stands between. Free."
---*/
#include "lib/receiver.glsl"

float shadow(int light, Receiver r) {
    return 1.0;
}

bool unshadowed() {
    return true;
}
