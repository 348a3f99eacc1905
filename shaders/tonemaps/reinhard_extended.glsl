/*---
title    = "Reinhard, extended"
equation = 'L_d = \frac{L\, (1 + L / L_w^2)}{1 + L},\quad \mathrm{rgb} \cdot \frac{L_d}{L}'
source   = "Reinhard et al. 2002, eq. 4"
domain   = { radiance = [0.0, 1e37], L_white = [0.0, 1e6] }
about    = """
Reinhard's curve that reaches white at a luminance of your choice and lets brighter things burn \
out. At L_white = 1 it changes nothing."""

[parameters.L_white]
kind    = "float"
default = 4.0
range   = [0.0, 1e6]
step    = 0.1
unit    = "cd/m^2"
label   = "White from luminance"
scale   = "log"
---*/
#include "lib/constants.glsl"
#include "lib/luminance.glsl"
#include "lib/tone.glsl"

// Lowest L_white^2: from 1e-6 cd/m^2 down everything but black is white, and 0 would divide by 0.
const float WHITE2_MIN = 1e-12;

// L_d / L is 1 / (1 + L) + (L / (1 + L)) / L_w^2: no 0/0 in black, and no step overflows for a
// large L. Only the product with rgb may; it is held at float32's largest value, far above white.
vec3 tonemap(vec3 radiance) {
    float Y = luminance(radiance);
    if (!hasTone(Y)) {
        return radiance;
    }
    float white2 = max(u_L_white * u_L_white, WHITE2_MIN);
    float scale = 1.0 / (1.0 + Y) + Y / (1.0 + Y) / white2;
    return clamp(radiance * scale, -FLOAT_MAX, FLOAT_MAX);
}
