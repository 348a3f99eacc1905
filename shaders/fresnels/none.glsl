/*---
title    = "None"
equation = 'F = 1'
source   = "the white furnace's mirror"
domain   = { VoH = [0.0, 1.0] }
about    = """
Every facet reflects everything: what is missing then is what masking or a wrong model lost."""
---*/
#include "lib/material.glsl"

vec3 fresnel(Material m, float VoH) {
    return vec3(1.0);
}

bool mirrors() {
    return true;
}
