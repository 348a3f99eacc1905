/*---
title = "Colours of a count"
---*/

// Black, blue, green, yellow, red at 0, 1/4, 1/2, 3/4, 1 and straight lines between. share [0, inf).
vec3 heat(float share) {
    float s = 4.0 * clamp(share, 0.0, 1.0);
    float red = clamp(s - 2.0, 0.0, 1.0);
    float green = clamp(s - 1.0, 0.0, 1.0) - clamp(s - 3.0, 0.0, 1.0);
    float blue = clamp(s, 0.0, 1.0) - clamp(s - 1.0, 0.0, 1.0);
    return vec3(red, green, blue);
}
