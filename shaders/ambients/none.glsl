/*---
title    = "None"
equation = 'L_a = 0'
source   = "direct light only"
unit     = "cd/m^2"
about    = "What no light reaches is black."
---*/
#include "lib/material.glsl"

vec3 ambient(Material m) {
    return vec3(0.0);
}
