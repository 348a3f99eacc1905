/*---
title    = "Polynomial"
equation = 'A = \frac{1}{c_0 + c_1 d + c_2 d^2}'
source   = "OpenGL 2.1 specification 2006, section 2.14.1"
domain   = { distance = [0.0, 1e18], c0 = [0.0, 10.0], c1 = [0.0, 10.0], c2 = [0.0, 10.0] }
unit     = "1"
about    = """
A falloff to taste: constant, linear and quadratic parts. Never above 1 while c0 is at least 1; \
with c0 = 0 it grows up to 10000 towards the light."""

[parameters.c0]
kind    = "float"
per     = "light"
default = 1.0
range   = [0.0, 10.0]
step    = 0.01
label   = "Constant c0"

[parameters.c1]
kind    = "float"
per     = "light"
default = 0.0
range   = [0.0, 10.0]
step    = 0.01
unit    = "1/m"
label   = "Linear c1"

[parameters.c2]
kind    = "float"
per     = "light"
default = 1.0
range   = [0.0, 10.0]
step    = 0.01
unit    = "1/m^2"
label   = "Quadratic c2"
---*/
#include "lib/light.glsl"

// With c0 = 0 the polynomial is 0 at the light. At this value c2 = 1 stops growing 1 cm away, where
// the inverse square with its default radius does.
const float POLYNOMIAL_MIN = 1e-4;

float attenuation(float distance, Light light) {
    float p = light.c0 + distance * (light.c1 + distance * light.c2);
    return 1.0 / max(p, POLYNOMIAL_MIN);
}
