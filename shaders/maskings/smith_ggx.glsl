/*---
title    = "Smith for GGX"
equation = 'G = \frac{1}{1 + \Lambda(l) + \Lambda(v)}'
source   = "Smith 1967; Heitz 2014, eqs. 72 and 99"
domain   = { alpha = [1e-4, 1.0] }
about    = """
Facets at random heights, the low ones hidden from light and view alike: GGX's own masking. Two \
square roots; with Beckmann's D it takes up to 43 % from grazing views."""
---*/
#include "lib/constants.glsl"
#include "lib/lambda_ggx.glsl"

// 0 on and below the horizon.
float masking(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z <= 0.0 || v.z <= 0.0) {
        return 0.0;
    }
    return 1.0 / (1.0 + lambdaGgx(l, alpha) + lambdaGgx(v, alpha));
}

// Towards the horizon of one direction 1 / (2 alpha) over the other's cosine.
float visibility(vec3 l, vec3 v, vec3 h, float alpha) {
    float d = v.z * slopeGgx(l, alpha) + l.z * slopeGgx(v, alpha);
    return l.z < 0.0 || v.z < 0.0 ? 0.0 : 0.5 / max(d, VISIBILITY_FLOOR);
}
