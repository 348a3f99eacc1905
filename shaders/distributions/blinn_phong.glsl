/*---
title    = "Blinn-Phong"
equation = 'D(h) = \frac{p + 2}{2\pi} \cos^p\theta_h,\quad p = \frac{2}{\alpha^2} - 2'
source   = "Blinn 1977; Walter et al. 2007, eq. 30"
domain   = { alpha = [1e-4, 1.0] }
unit     = "1/sr"
about    = """
A power of the cosine, normalised; close to Beckmann for narrow lobes. It has no masking of its \
own: with Beckmann's, rough surfaces send back more light than they get."""

[breaks]
energy = """
with Beckmann's Smith masking the albedo at n.v = 0.02 is 1.09 for alpha 0.5, 1.62 for alpha 1 \
(separable: 1.30)"""
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"
#include "lib/specular_power.glsl"

// (p + 2) / (2 pi) = 1 / (pi alpha^2), and p = 2 (1 - alpha)(1 + alpha) / alpha^2 does not cancel
// near alpha 1. alpha below ALPHA_MIN is taken as that, so p <= 2e8 -> [0, 3.2e7].
float distribution(vec3 h, float alpha) {
    float a = max(alpha, ALPHA_MIN);
    float a2 = a * a;
    float p = 2.0 * (1.0 - a) * (1.0 + a) / a2;
    return h.z <= 0.0 ? 0.0 : specularPower(h.z, dot(h.xy, h.xy), p) / (PI * a2);
}
