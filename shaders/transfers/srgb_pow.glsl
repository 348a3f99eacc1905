/*---
title    = "sRGB, with its power"
equation = '12.92\, c\ (c \le 0.0031308),\quad 1.055\, c^{1/2.4} - 0.055'
source   = "IEC 61966-2-1:1999"
about    = """
The same curve with pow(), as the standard prints it: no approximation, and twice as dear as the \
square roots."""
---*/
#include "lib/display.glsl"

// The curve's straight toe ends here.
const float SRGB_TOE = 0.0031308;

// 1.055 (p - 1) + 1 is 1.055 p - 0.055 and exactly 1 in white.
vec3 transfer(vec3 linear) {
    vec3 c = displayRange(linear);
    vec3 curve = 1.055 * (pow(c, vec3(1.0 / 2.4)) - 1.0) + 1.0;
    return mix(curve, 12.92 * c, lessThanEqual(c, vec3(SRGB_TOE)));
}
