/*---
title    = "Of every light"
equation = 'L_a = \sum_k m_\mathrm{amb}\, E_k'
source   = "a lab script on ray tracing, eq. 1.43"
about    = "Each light adds its share everywhere, also where it does not reach: m_amb is the material's."
material = ["ambient"]
---*/
#include "lib/material.glsl"

uniform vec3 u_lights_total;

vec3 ambient(Material m) {
    return m.ambient * u_lights_total;
}
