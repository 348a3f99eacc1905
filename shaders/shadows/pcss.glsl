/*---
title    = "Percentage-closer soft shadows"
equation = 'w = \frac{d - d_b}{d_b}\, s'
source   = "Fernando 2005, Percentage-Closer Soft Shadows"
unit     = "1"
about    = """
The filter as wide as the penumbra of a light of that size: first the mean distance of what blocks \
the light is found, then its shadow is filtered over the width that follows. Sharp where things \
touch, soft far behind them."""

[parameters.light_size]
kind    = "float"
default = 0.3
range   = [0.0, 3.0]
step    = 0.01
unit    = "m"
label   = "Width of point and spot lights"

[parameters.light_angle]
kind    = "float"
default = 3.0
range   = [0.0, 20.0]
step    = 0.1
unit    = "deg"
label   = "Width of directional lights"

[parameters.pcss_taps]
kind    = "int"
default = 24
range   = [8, 64]
step    = 4
label   = "Samples of each search"
---*/
#include "lib/disk.glsl"
#include "stages/shadow_map.glsl"

// Half a degree in radians.
const float HALF_DEGREE = 0.0087266463;

// Radius of the light over the distance at which it counts: of a directional one, of its disk.
float lightRadius(int light) {
#for CASTERS
    if (light == @{index}) {
#if @{directional}
        return tan(HALF_DEGREE * u_light_angle);
#else
        return 0.5 * u_light_size;
#endif
    }
#endfor
    return 0.0;
}

// Distance from the light of a texel so far aside, in metres.
float blockerAt(int light, MapPoint p, vec2 aside) {
    vec2 texel = p.at.xy * float(SHADOW_RESOLUTION) + aside;
    return sqrt(stored(light, p.at, ivec2(floor(texel)))) * p.far;
}

// Whether the light reaches past a texel so far aside.
bool open(int light, MapPoint p, Receiver r, vec2 aside) {
    vec2 texel = p.at.xy * float(SHADOW_RESOLUTION) + aside;
    return comparedAt(p, r, length(aside)) <= stored(light, p.at, ivec2(floor(texel)));
}

// Mean distance from the light of what blocks it within a disk of texels; 0 where nothing does.
float meanBlocker(int light, MapPoint p, Receiver r, float radius) {
    float sum = 0.0;
    float count = 0.0;
    for (int i = 0; i < PCSS_TAPS; ++i) {
        vec2 aside = radius * diskPoint(i, PCSS_TAPS);
        if (!open(light, p, r, aside)) {
            sum += blockerAt(light, p, aside);
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

// Radius of the penumbra in texels behind a blocker at a distance from the light.
float penumbra(int light, MapPoint p, float blocker) {
    float radius = lightRadius(light) * (p.distance - blocker);
#for CASTERS
#if !@{directional}
    radius = light == @{index} ? radius / blocker : radius;
#endif
#endfor
    return radius / p.texel;
}

float shadow(int light, Receiver r) {
    MapPoint p = receivedAt(light, r);
    // What blocks a light at a third of the way or farther lies within twice its radius.
    float widest = penumbra(light, p, p.distance / 3.0);
    float blocker = meanBlocker(light, p, r, max(widest, 1.0));
    if (blocker == 0.0 || p.distance > p.far) {
        return 1.0;
    }
    float radius = clamp(penumbra(light, p, blocker), HALF_DIAGONAL, max(widest, 1.0));
    float reached = 0.0;
    for (int i = 0; i < PCSS_TAPS; ++i) {
        reached += open(light, p, r, radius * diskPoint(i, PCSS_TAPS)) ? 1.0 : 0.0;
    }
    return reached / float(PCSS_TAPS);
}
