/*---
title       = "GGX, textbook form"
textbook_of = "ggx"
equation    = 'D(h) = \frac{\alpha^2}{\pi\, (\cos^2\theta_h\, (\alpha^2 - 1) + 1)^2}'
source      = "Walter et al. 2007, eq. 33, as most engines write it"
domain      = { alpha = [0.02, 1.0], theta_h = [0.0, 89.0] }
unit        = "1/sr"
about       = """
For comparison only: GGX as it is printed. Near the peak the sum cancels: 12 % off at alpha 0.002, \
60 % at 0.001, infinite at 0.0001."""
---*/
#include "lib/constants.glsl"

// Nothing is guarded. h.z alone cannot tell angles below 3e-4 apart: 1 - h.z^2 is a difference of
// numbers that round to 6e-8. Some drivers make h.z^2 (alpha^2 - 1) + 1 of this, and that a mix(),
// which saves the peak.
float distribution(vec3 h, float alpha) {
    float a2 = alpha * alpha;
    float d = (h.z * a2 - h.z) * h.z + 1.0;
    return a2 / (PI * d * d);
}
