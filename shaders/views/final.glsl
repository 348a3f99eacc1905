/*---
title    = "Final"
equation = "T(L \\cdot 2^{\\mathrm{exposure}})"
source   = "one stop is a factor of 2"
about    = "The picture: exposed, tone-mapped, encoded for the display."

[parameters.exposure]
kind    = "float"
default = 0.0
range   = [-10.0, 10.0]
step    = 0.1
unit    = "stops"
label   = "Exposure"
---*/
#include <tonemap>
#include <transfer>

vec3 view(vec3 radiance) {
    return transfer(tonemap(radiance * exp2(u_exposure)));
}
