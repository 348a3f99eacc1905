/*---
title    = "Longitude and latitude"
equation = 'u = \frac{1}{2} + \frac{\mathrm{atan}(n_x, n_z)}{2 \pi},\quad v = \frac{\arccos n_y}{\pi}'
source   = "the plate carree projection"
about    = "The whole image around the sphere once, from pole to pole."
---*/
#include "lib/constants.glsl"
#include "lib/longitude.glsl"

// acos by atan, which keeps its digits near the poles. n of any length -> [0, 1].
vec2 mapping(vec3 n) {
    float latitude = atan(length(n.xz), n.y);
    return vec2(0.5 + longitude(n), INV_PI * latitude);
}
