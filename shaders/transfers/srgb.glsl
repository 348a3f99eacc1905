/*---
title    = "sRGB"
equation = '12.92\, c\ (c \le 0.0031308),\quad 1.055\, c^{1/2.4} - 0.055'
source   = "IEC 61966-2-1:1999"
about    = "What displays expect. Within 0.0006 of a code of 255, without pow()."
---*/
#include "lib/display.glsl"

// The curve's straight toe ends here.
const float SRGB_TOE = 0.0031308;

// c^(1/2.4) by three square roots: minimax fit of the curve above its toe in c^(1/2), c^(1/4),
// c^(3/8), c^(5/8) and 1, which is 1 at c = 1. A pow() costs three times as much.
// The last sum rounds to one step above 1 there, hence the min.
vec3 transfer(vec3 linear) {
    vec3 c = displayRange(linear);
    vec3 r2 = sqrt(c);
    vec3 r4 = sqrt(r2);
    vec3 r8 = sqrt(r4);
    vec3 curve = r2 * (0.3983829 - 0.0567664 * r8) + r4 * (0.7829168 * r8 - 0.0709507) - 0.0535826;
    return min(mix(curve, 12.92 * c, lessThanEqual(c, vec3(SRGB_TOE))), 1.0);
}
