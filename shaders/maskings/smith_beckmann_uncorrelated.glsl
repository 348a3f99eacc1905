/*---
title    = "Smith for Beckmann, uncorrelated"
equation = 'G = \frac{1}{(1 + \Lambda(l))(1 + \Lambda(v))}'
source   = "Smith 1967; Walter et al. 2007, eqs. 23 and 27"
domain   = { alpha = [1e-4, 1.0] }
about    = """
Beckmann's Lambda, as if being lit and being seen had nothing to do with each other: too dark \
where both are grazing."""
---*/
#include "lib/lambda_beckmann.glsl"
#include "lib/smith.glsl"

// 0 on and below the horizon.
float masking(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z <= 0.0 || v.z <= 0.0) {
        return 0.0;
    }
    return 1.0 / ((1.0 + lambdaBeckmann(l, alpha)) * (1.0 + lambdaBeckmann(v, alpha)));
}

// On both horizons 3.12 / alpha^2.
float visibility(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z < 0.0 || v.z < 0.0) {
        return 0.0;
    }
    return smithSeparable(l.z, v.z, cosLambdaBeckmann(l, alpha), cosLambdaBeckmann(v, alpha));
}
