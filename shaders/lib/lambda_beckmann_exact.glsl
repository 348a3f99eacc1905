/*---
title    = "Smith's Lambda for Beckmann, exact"
equation = '''
\Lambda(w) = \frac{\mathrm{erf}(a) - 1}{2} + \frac{e^{-a^2}}{2 a \sqrt{\pi}},\quad
a = \frac{\cos\theta_w}{\alpha \sin\theta_w}'''
source   = "Smith 1967; Heitz 2014, eq. 66"
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"
#include "lib/erf.glsl"

// 1 / (2 sqrt(pi)).
const float HALF_INV_SQRT_PI = 0.282094791773878;

// Lambda is below 1e-12 from here on, where a^2 of a narrow lobe would go on to overflow.
const float BECKMANN_A_MAX = 5.0;

// w.z Lambda(w), finite on the horizon (alpha / (2 sqrt(pi))), where Lambda itself is not.
// alpha sin times a Lambda(a) = e^(-a^2) / (2 sqrt(pi)) - a erfc(a) / 2: what cancels for a large a
// is small beside the a that it is added to. w.z [0, 1], alpha [ALPHA_MIN, 1]; narrower is taken as
// ALPHA_MIN.
float cosLambdaBeckmannExact(vec3 w, float alpha) {
    float width = max(alpha, ALPHA_MIN) * length(w.xy);
    if (w.z >= BECKMANN_A_MAX * width) {
        return 0.0;
    }
    float a = w.z / width;
    return width * max(HALF_INV_SQRT_PI * exp(-a * a) - 0.5 * a * erfc(a), 0.0);
}

// Lambda(w) -> [0, 0.28 alpha / GRAZING_COS]: held at that cosine's value down to the horizon.
float lambdaBeckmannExact(vec3 w, float alpha) {
    return cosLambdaBeckmannExact(w, alpha) / max(w.z, GRAZING_COS);
}
