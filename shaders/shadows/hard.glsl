/*---
title    = "Hard"
equation = 'V = \left[\, d^2 / d_\mathrm{far}^2 \le m(u, v) + \mathrm{bias}\, \right]'
source   = "Williams 1978, Casting Curved Shadows on Curved Surfaces"
unit     = "1"
about    = "One comparison with the nearest texel of the light's map: an edge of steps, one a texel."
---*/
#include "stages/shadow_map.glsl"

float shadow(int light, Receiver r) {
    MapPoint p = receivedAt(light, r);
    ivec2 texel = ivec2(floor(p.at.xy * float(SHADOW_RESOLUTION)));
    bool blocked = comparedAt(p, r, 0.0) > stored(light, p.at, texel);
    return blocked && p.distance <= p.far ? 0.0 : 1.0;
}
