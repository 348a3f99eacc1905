/*---
title    = "By two arcsines"
equation = 'u = \frac{1}{2} + \frac{\arcsin n_x}{\pi},\quad v = \frac{1}{2} - \frac{\arcsin n_y}{\pi}'
source   = "a lab script on ray tracing, eqs. 1.49 and 1.50"
about    = """
As if seen along z: front and back show the same half of the image, squeezed towards the outline."""
---*/
#include "lib/constants.glsl"

// asin x = atan(x, sqrt(1 - x^2)), as exact on every driver as its atan. n unit -> [0, 1].
float arcsine(float x) {
    return atan(x, sqrt(max((1.0 - x) * (1.0 + x), 0.0)));
}

vec2 mapping(vec3 normal) {
    vec3 n = normalize(normal);
    return vec2(0.5 + arcsine(n.x) * INV_PI, 0.5 - arcsine(n.y) * INV_PI);
}
