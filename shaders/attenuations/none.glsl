/*---
title    = "None"
equation = 'A = 1'
source   = "a light as strong at any distance"
unit     = "1"
about    = "For a light that is to look the same wherever it stands: its intensity is an illuminance."
---*/
#include "lib/light.glsl"

float attenuation(float distance, Light light) {
    return 1.0;
}
