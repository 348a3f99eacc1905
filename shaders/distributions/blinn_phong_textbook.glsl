/*---
title       = "Blinn-Phong, textbook form"
textbook_of = "blinn_phong"
equation    = 'D(h) = \frac{p + 2}{2\pi} \cos^p\theta_h,\quad p = \frac{2}{\alpha^2} - 2'
source      = "Blinn 1977; Walter et al. 2007, eq. 30"
domain      = { alpha = [0.02, 1.0], theta_h = [0.0, 89.0] }
unit        = "1/sr"
about       = """
For comparison only: Blinn-Phong as it is printed, with pow(). A large power of a rounded cosine \
is noise: the narrow highlight is lost."""
---*/
#include "lib/constants.glsl"

// Nothing is guarded: alpha = 0 is an infinite power, and pow() of a negative cosine undefined.
float distribution(vec3 h, float alpha) {
    float p = 2.0 / (alpha * alpha) - 2.0;
    return (p + 2.0) / (2.0 * PI) * pow(h.z, p);
}
