/*---
title       = "Reinhard, extended, textbook form"
textbook_of = "reinhard_extended"
equation    = 'L_d = \frac{L\, (1 + L / L_w^2)}{1 + L},\quad \mathrm{rgb} \cdot \frac{L_d}{L}'
source      = "Reinhard et al. 2002, eq. 4"
domain      = { radiance = [1e-30, 1e15], L_white = [1e-2, 1e6] }
about       = """
For comparison only: the curve as it is printed. Black is 0/0, a white of 0 divides by it, and \
light above 1e19 overflows."""

[parameters.L_white]
kind    = "float"
default = 4.0
range   = [0.0, 1e6]
step    = 0.1
unit    = "cd/m^2"
label   = "White from luminance"
scale   = "log"
---*/
#include "lib/luminance.glsl"

// Nothing is guarded.
vec3 tonemap(vec3 radiance) {
    float L = luminance(radiance);
    float Ld = L * (1.0 + L / (u_L_white * u_L_white)) / (1.0 + L);
    return radiance * (Ld / L);
}
