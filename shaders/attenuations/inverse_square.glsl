/*---
title    = "Inverse square"
equation = 'A = \frac{1}{\max(d, r)^2}'
source   = "Lambert 1760, Photometria; floor as in Lagarde & de Rousiers 2014, section 4.5"
domain   = { distance = [0.0, 1e18], light_radius = [1e-4, 10.0] }
unit     = "1/m^2"
about    = """
Physical light: a quarter at twice the distance. A light has a size, and within its radius it \
grows no brighter."""

[parameters.light_radius]
kind    = "float"
per     = "light"
default = 0.01
range   = [1e-4, 10.0]
step    = 1e-4
unit    = "m"
label   = "Light radius"
scale   = "log"
---*/
#include "lib/light.glsl"

// A light of radius 0 is a point, infinite at distance 0: it gets the tenth of a millimetre at
// which 1 / d^2 is 1e8, so that 1e30 cd are still finite.
const float LIGHT_RADIUS_MIN = 1e-4;

float attenuation(float distance, Light light) {
    float d = max(distance, max(light.light_radius, LIGHT_RADIUS_MIN));
    return 1.0 / (d * d);
}
