/*---
title    = "GGX (Trowbridge-Reitz)"
equation = 'D(h) = \frac{\alpha^2}{\pi\, (\sin^2\theta_h + \alpha^2 \cos^2\theta_h)^2}'
source   = "Trowbridge & Reitz 1975; Walter et al. 2007, eq. 33"
domain   = { alpha = [1e-4, 1.0] }
unit     = "1/sr"
about    = """
Facets like those of an ellipsoid: a sharp peak in a long glow, as on most real surfaces. No exp() \
or pow(): the cheapest of the three."""
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"

// The usual denominator, cos^2 (alpha^2 - 1) + 1, is 12 % off in float32 at alpha = 0.002; with
// sin^2 from h.xy nothing cancels. alpha below ALPHA_MIN is taken as that -> [0, 3.2e7].
float distribution(vec3 h, float alpha) {
    float a2 = max(alpha, ALPHA_MIN) * max(alpha, ALPHA_MIN);
    float d = dot(h.xy, h.xy) + a2 * h.z * h.z;
    return h.z <= 0.0 ? 0.0 : a2 / (PI * d * d);
}
