/*---
title    = "Smith's Lambda for Beckmann, rational fit"
equation = '''
\Lambda(w) = \frac{1 - 1.259 a + 0.396 a^2}{3.535 a + 2.181 a^2}\ (a < 1.6),\quad
a = \frac{\cos\theta_w}{\alpha \sin\theta_w}'''
source   = "Walter et al. 2007, eq. 27"
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"

// w.z Lambda(w), finite on the horizon (alpha / 3.535), where Lambda itself is not. a Lambda(a)
// times alpha sin, and 0 from a = 1.6. w.z [0, 1], alpha [ALPHA_MIN, 1] -> [0, alpha / 3.535];
// narrower is taken as ALPHA_MIN. The fit dips to -1e-5 from a = 1.55, hence the max with 0.
float cosLambdaBeckmann(vec3 w, float alpha) {
    float width = max(alpha, ALPHA_MIN) * length(w.xy);
    if (w.z >= 1.6 * width) {
        return 0.0;
    }
    float a = w.z / width;
    return width * max(1.0 + a * (0.396 * a - 1.259), 0.0) / (3.535 + 2.181 * a);
}

// Lambda(w) -> [0, alpha / (3.535 GRAZING_COS)]: held at that cosine's value down to the horizon.
float lambdaBeckmann(vec3 w, float alpha) {
    return cosLambdaBeckmann(w, alpha) / max(w.z, GRAZING_COS);
}
