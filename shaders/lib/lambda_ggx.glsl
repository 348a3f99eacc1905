/*---
title    = "Smith's Lambda for GGX"
equation = '''
\Lambda(w) = \frac{-1 + \sqrt{1 + 1/a^2}}{2},\quad a = \frac{\cos\theta_w}{\alpha \sin\theta_w}'''
source   = "Heitz 2014, eq. 72"
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"

// w.z Lambda(w), finite on the horizon (alpha / 2), where Lambda itself is not.
// x2 / (2 (cos + sqrt(cos^2 + x2))), x2 = (alpha sin)^2: (sqrt(cos^2 + x2) - cos) / 2 would cancel.
// w.z [0, 1], alpha [ALPHA_MIN, 1] -> [0, alpha / 2]; narrower is taken as ALPHA_MIN.
float cosLambdaGgx(vec3 w, float alpha) {
    float width = max(alpha, ALPHA_MIN);
    float x2 = width * width * dot(w.xy, w.xy);
    return 0.5 * x2 / (w.z + sqrt(w.z * w.z + x2));
}

// Lambda(w) -> [0, alpha / (2 GRAZING_COS)]: held at that cosine's value down to the horizon.
float lambdaGgx(vec3 w, float alpha) {
    return cosLambdaGgx(w, alpha) / max(w.z, GRAZING_COS);
}
