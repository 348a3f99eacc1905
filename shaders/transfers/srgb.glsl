/*---
title    = "sRGB"
equation = '12.92\, c\ (c \le 0.0031308),\quad 1.055\, c^{1/2.4} - 0.055'
source   = "IEC 61966-2-1:1999"
about    = "What displays expect. Within 0.0006 of a code of 255, without pow()."
---*/
#include "lib/display.glsl"

// The curve's straight toe ends here.
const float SRGB_TOE = 0.0031308;

// c^(1/2.4) = y^(5/3), y = c^(1/4) by two square roots: minimax fit of the curve above its toe by a
// polynomial in y that is 1 at y = 1. A pow() costs three times as much.
// The last sum may round to one step above 1 there, hence the min.
vec3 transfer(vec3 linear) {
    vec3 c = displayRange(linear);
    vec3 y = sqrt(sqrt(c));
    vec3 tail = -0.8453809 + y * (0.6465620 + y * (-0.3108092 + y * 0.0660283));
    vec3 curve = -0.0595898 + y * (0.1401667 + y * (1.3630230 + y * tail));
    return min(mix(curve, 12.92 * c, lessThanEqual(c, vec3(SRGB_TOE))), 1.0);
}
