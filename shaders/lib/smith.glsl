/*---
title  = "Smith's joint masking-shadowing over 4 NoL NoV"
source = "Heitz 2014, eqs. 98 and 99"
---*/
#include "lib/constants.glsl"

// Both functions are G2 / (4 NoL NoV) from NoL, NoV >= 0 and the products cosine times Lambda of
// each direction, so that no factor is 0/0 on the horizon.

// Height-correlated: G2 = 1 / (1 + Lambda(l) + Lambda(v)). Finite unless both lie on the horizon.
float smithCorrelated(float NoL, float NoV, float cosLambdaL, float cosLambdaV) {
    float d = NoL * NoV + NoV * cosLambdaL + NoL * cosLambdaV;
    return 0.25 / max(d, VISIBILITY_FLOOR);
}

// Separable: G2 = 1 / ((1 + Lambda(l)) (1 + Lambda(v))). Finite everywhere.
float smithSeparable(float NoL, float NoV, float cosLambdaL, float cosLambdaV) {
    return 0.25 / ((NoL + cosLambdaL) * (NoV + cosLambdaV));
}
