/*---
title    = "Reinhard"
equation = 'L_d = \frac{L}{1 + L},\quad \mathrm{rgb} \cdot \frac{L_d}{L}'
source   = "Reinhard et al. 2002, eq. 3"
domain   = { radiance = [0.0, 1e37] }
about    = """
Compresses luminance so that no brightness reaches white; colours keep their hue and everything \
bright turns grey."""
---*/
#include "lib/luminance.glsl"
#include "lib/tone.glsl"

// L_d / L is 1 / (1 + L): no 0/0 in black.
vec3 tonemap(vec3 radiance) {
    float Y = luminance(radiance);
    return hasTone(Y) ? radiance / (1.0 + Y) : radiance;
}
