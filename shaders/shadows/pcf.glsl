/*---
title    = "Percentage-closer filtering"
equation = 'V = \frac{1}{(2r+1)^2} \iint_{|x|,|y| \le r + 1/2} [\, d^2 \le m\, ]\, dx\, dy'
source   = "Reeves, Salesin & Cook 1987, Rendering Antialiased Shadows with Depth Maps"
unit     = "1"
about    = """
The share of a square of texels that the light reaches: comparisons are averaged, not depths. The \
square moves smoothly, its border texels counting by how far they are covered. As wide everywhere."""

[parameters.pcf_radius]
kind    = "int"
default = 1
range   = [0, 4]
step    = 1
unit    = "texels"
label   = "Filter radius"
---*/
#include "stages/shadow_map.glsl"

// The share of texel i that the square covers; the first and the last by a part only.
float covered(int i, float part) {
    return i == -PCF_RADIUS ? 1.0 - part : i > PCF_RADIUS ? part : 1.0;
}

float shadow(int light, Receiver r) {
    MapPoint p = receivedAt(light, r);
    vec2 corner = p.at.xy * float(SHADOW_RESOLUTION) - 0.5;
    ivec2 first = ivec2(floor(corner));
    vec2 part = corner - vec2(first);
    float depth = comparedAt(p, r, 1.4142136 * (float(PCF_RADIUS) + 0.5));
    float blocked = 0.0;
    for (int y = -PCF_RADIUS; y <= PCF_RADIUS + 1; ++y) {
        for (int x = -PCF_RADIUS; x <= PCF_RADIUS + 1; ++x) {
            float behind = depth > stored(light, p.at, first + ivec2(x, y)) ? 1.0 : 0.0;
            blocked += behind * covered(x, part.x) * covered(y, part.y);
        }
    }
    const float side = 2.0 * float(PCF_RADIUS) + 1.0;
    return p.distance > p.far ? 1.0 : max(1.0 - blocked / (side * side), 0.0);
}
