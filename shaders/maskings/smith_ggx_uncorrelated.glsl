/*---
title    = "Smith for GGX, uncorrelated"
equation = 'G = \frac{1}{(1 + \Lambda(l))(1 + \Lambda(v))}'
source   = "Smith 1967; Walter et al. 2007, eqs. 23 and 34"
domain   = { alpha = [1e-4, 1.0] }
about    = """
As if being lit and being seen had nothing to do with each other: darker than the correlated form, \
most where both are grazing."""
---*/
#include "lib/lambda_ggx.glsl"

// 0 on and below the horizon.
float masking(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z <= 0.0 || v.z <= 0.0) {
        return 0.0;
    }
    return 1.0 / ((1.0 + lambdaGgx(l, alpha)) * (1.0 + lambdaGgx(v, alpha)));
}

// On both horizons 1 / alpha^2.
float visibility(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z < 0.0 || v.z < 0.0) {
        return 0.0;
    }
    return 1.0 / ((l.z + slopeGgx(l, alpha)) * (v.z + slopeGgx(v, alpha)));
}
