/*---
title    = "Schlick"
equation = 'F = F_0 + (1 - F_0)(1 - v \cdot h)^5'
source   = "Schlick 1994, An Inexpensive BRDF Model"
domain   = { VoH = [0.0, 1.0] }
about    = """
From the reflectance at normal incidence up to 1 at grazing. Three multiplications; for glass 23 % \
low at 55 degrees, for iron up to 0.18 off."""
material = ["f0"]
---*/
#include "lib/fresnel.glsl"
#include "lib/material.glsl"

// A rounded VoH may exceed 1 by 1e-7, and an odd power of that would be negative light: hence the
// max.
vec3 fresnel(Material m, float VoH) {
    return mix(m.f0, vec3(1.0), pow5(max(1.0 - VoH, 0.0)));
}
