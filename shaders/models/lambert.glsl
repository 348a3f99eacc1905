/*---
title    = "Lambert"
equation = 'f = \frac{\rho}{\pi}'
source   = "Lambert 1760, Photometria"
unit     = "1/sr"
about    = """
The perfectly matt surface: the same radiance in every direction. The cheapest model there is."""
material = ["base_color"]
---*/
#include "lib/constants.glsl"
#include "lib/material.glsl"

// 0 for light from below and for a viewer below.
vec3 brdf(Material m, vec3 l, vec3 v) {
    return l.z <= 0.0 || v.z < 0.0 ? vec3(0.0) : m.base_color * INV_PI;
}
