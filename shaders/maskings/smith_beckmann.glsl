/*---
title    = "Smith for Beckmann"
equation = 'G = \frac{1}{1 + \Lambda(l) + \Lambda(v)}'
source   = "Smith 1967; Walter et al. 2007, eq. 27; Heitz 2014, eq. 99"
domain   = { alpha = [1e-4, 1.0] }
about    = """
Beckmann's own masking, with the usual rational fit of its Lambda: G1 is within 0.31 % of the \
exact one. With GGX it hides too little: albedo up to 1.76."""
---*/
#include "lib/lambda_beckmann.glsl"
#include "lib/smith.glsl"

// 0 on and below the horizon.
float masking(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z <= 0.0 || v.z <= 0.0) {
        return 0.0;
    }
    return 1.0 / (1.0 + lambdaBeckmann(l, alpha) + lambdaBeckmann(v, alpha));
}

// Towards the horizon of one direction 0.884 / alpha over the other's cosine.
float visibility(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z < 0.0 || v.z < 0.0) {
        return 0.0;
    }
    return smithCorrelated(l.z, v.z, cosLambdaBeckmann(l, alpha), cosLambdaBeckmann(v, alpha));
}
