/*---
title    = "Gamma"
equation = 'c^{1/\gamma}'
source   = "ITU-R BT.1886 without its black level"
domain   = { gamma = [1.0, 4.0] }
about    = """
A plain power, as old displays had. At 2.2 up to 9 codes of 255 away from sRGB in the shadows."""

[parameters.gamma]
kind    = "float"
default = 2.2
range   = [1.0, 4.0]
step    = 0.05
label   = "Gamma"
---*/
#include "lib/display.glsl"

// The base is in [0, 1] and the exponent positive, where pow() is defined.
vec3 transfer(vec3 linear) {
    return pow(displayRange(linear), vec3(1.0 / u_gamma));
}
