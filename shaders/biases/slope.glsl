/*---
title    = "Slope-scaled"
equation = '\left(\frac{d - b}{d_\mathrm{far}}\right)^2,\quad b = \mathrm{reach} \tan\theta_l + \varepsilon d'
source   = "Akenine-Moller et al. 2018, Real-Time Rendering, 4th ed., section 7.4.1"
about    = """
The distance by which a plane at this angle to the light can differ within the reach: as much as is \
needed, and no more. Towards grazing angles it is bounded."""
---*/
#include "lib/slope.glsl"

float compared(float distance, float far, float reach, float NoL) {
    float share = max(distance - slopeBias(distance, reach, NoL), 0.0) / far;
    return share * share;
}
