/*---
title    = "Normal offset"
equation = 'x + \mathrm{reach} \sin\theta_l\; n'
source   = "Holbert 2011, Saying Goodbye to Shadow Acne (GDC)"
about    = """
The point is looked up from a little above its surface, at most half a texel's diagonal at any \
angle: no acne at grazing light, where a slope bias grows without bound. Beyond the nearest texel, \
in a soft filter, the slope bias does the rest."""
---*/
#include "lib/slope.glsl"

float compared(float distance, float far, float reach, float NoL) {
    float share = max(distance - slopeBias(distance, reach, NoL), 0.0) / far;
    return share * share;
}

// A plane's points within the reach then lie behind it: its distance from them is
// reach sin / cos against a shift of as much, in the direction of the light.
float shift(float reach, float NoL) {
    return reach * sqrt(max((1.0 - NoL) * (1.0 + NoL), 0.0));
}
