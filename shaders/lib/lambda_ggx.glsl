/*---
title    = "Smith's Lambda for GGX"
equation = '''
\Lambda(w) = \frac{-1 + \sqrt{1 + 1/a^2}}{2},\quad a = \frac{\cos\theta_w}{\alpha \sin\theta_w}'''
source   = "Heitz 2014, eq. 72"
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"

// w.z (1 + 2 Lambda(w)) = sqrt(cos^2 + (alpha sin)^2): a sum of squares, finite on the horizon (alpha).
// w.z [0, 1], alpha [ALPHA_MIN, 1] -> [alpha, 1]; narrower is taken as ALPHA_MIN.
float slopeGgx(vec3 w, float alpha) {
    float width = max(alpha, ALPHA_MIN);
    return sqrt(w.z * w.z + width * width * dot(w.xy, w.xy));
}

// Lambda(w) = x^2 / (2 cos (cos + sqrt(cos^2 + x^2))), x = alpha sin: (slope - cos) / (2 cos) would
// cancel. -> [0, alpha / (2 GRAZING_COS)]: held at that cosine's value down to the horizon.
float lambdaGgx(vec3 w, float alpha) {
    float width = max(alpha, ALPHA_MIN);
    float x2 = width * width * dot(w.xy, w.xy);
    return 0.5 * x2 / ((w.z + slopeGgx(w, alpha)) * max(w.z, GRAZING_COS));
}
