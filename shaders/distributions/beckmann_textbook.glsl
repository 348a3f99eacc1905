/*---
title       = "Beckmann, textbook form"
textbook_of = "beckmann"
equation    = '''
D(h) = \frac{1}{\pi\, \alpha^2 \cos^4\theta_h}
       \exp\left(\frac{\cos^2\theta_h - 1}{\alpha^2 \cos^2\theta_h}\right)'''
source      = "Beckmann & Spizzichino 1963; Cook & Torrance 1982"
domain      = { alpha = [0.02, 1.0], theta_h = [0.0, 89.0] }
unit        = "1/sr"
about       = """
For comparison only: Beckmann as it is printed. The exponent's cos^2 - 1 keeps no digit in a \
narrow lobe, and the horizon is 0/0."""
---*/
#include "lib/constants.glsl"

// Nothing is guarded: alpha = 0 and cos = 0 are NaN.
float distribution(vec3 h, float alpha) {
    float a2 = alpha * alpha;
    float c2 = h.z * h.z;
    return exp((c2 - 1.0) / (a2 * c2)) / (PI * a2 * c2 * c2);
}
