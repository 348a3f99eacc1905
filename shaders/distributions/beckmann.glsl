/*---
title    = "Beckmann"
equation = 'D(h) = \frac{e^{-\tan^2\theta_h / \alpha^2}}{\pi\, \alpha^2 \cos^4\theta_h}'
source   = "Beckmann & Spizzichino 1963; Walter et al. 2007, eq. 25"
domain   = { alpha = [1e-4, 1.0] }
unit     = "1/sr"
about    = """
Facets of a surface with normally distributed slopes: a soft-edged highlight with hardly any tail. \
One exp()."""
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"

// Below this cos^4 (0.57 degrees above the horizon) the exponential is under float32's smallest
// value for every alpha up to 1, and the quotient would be 0/0.
const float BECKMANN_COS4_MIN = 1e-8;

// tan^2 from h.xy, exact at the peak. alpha below ALPHA_MIN is taken as that -> [0, 3.2e7].
float distribution(vec3 h, float alpha) {
    float a2 = max(alpha, ALPHA_MIN) * max(alpha, ALPHA_MIN);
    float c2 = h.z * h.z;
    if (h.z <= 0.0 || c2 * c2 < BECKMANN_COS4_MIN) {
        return 0.0;
    }
    return exp(-dot(h.xy, h.xy) / (a2 * c2)) / (PI * a2 * c2 * c2);
}
