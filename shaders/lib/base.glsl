/*---
title    = "Facets over a matt base"
source   = "Cook & Torrance 1982: the sum of a diffuse and a specular part, in shares up to 1"
material = ["base_color", "metalness"]
---*/
#include "lib/constants.glsl"
#include "lib/material.glsl"

// Least share of the facets in a blend by metalness alone, so that a dielectric still shows its
// Fresnel reflection.
const float FACET_SHARE_MIN = 0.005;

// What the facets let through is scattered by the base; a metal has none.
// (1 - F) (1 - metalness) rho / pi + facets. F, metalness, rho [0, 1] -> 1/sr.
vec3 overBase(Material m, vec3 F, vec3 facets) {
    return (1.0 - F) * ((1.0 - m.metalness) * INV_PI * m.base_color) + facets;
}

// The base and the facets in the shares 1 - metalness and metalness.
vec3 blendWithBase(Material m, vec3 facets) {
    return mix(m.base_color * INV_PI, facets, max(m.metalness, FACET_SHARE_MIN));
}
