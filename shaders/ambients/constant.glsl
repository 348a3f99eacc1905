/*---
title    = "Constant"
equation = 'L_a = \rho\, L_s'
source   = "Phong 1975, the ambient term; a matt surface in a surround of constant radiance"
unit     = "cd/m^2"
about    = """
The same light from everywhere, as if the scene stood in an evenly lit tent. It costs one \
multiplication, has no shape and knows no corners."""
material = ["base_color"]

[parameters.ambient_color]
kind    = "color"
default = [1.0, 1.0, 1.0]
label   = "Ambient colour"

[parameters.ambient_level]
kind    = "float"
default = 0.05
range   = [0.0, 10.0]
step    = 0.01
unit    = "cd/m^2"
label   = "Ambient level"
---*/
#include "lib/material.glsl"

// The integral of rho / pi times the surround's radiance times cos over the hemisphere: no pi is
// left.
vec3 ambient(Material m) {
    return m.base_color * u_ambient_color * u_ambient_level;
}
