/*---
title    = "Cook-Torrance"
equation = '''
f = (1 - F)(1 - \mathrm{metalness}) \frac{\rho}{\pi}
  + \frac{D\, F\, G}{4\, (n \cdot l)(n \cdot v)}'''
source   = "Cook & Torrance 1982; with the 4 of Walter et al. 2007, eq. 20"
domain   = { roughness = [0.0, 1.0] }
unit     = "1/sr"
about    = """
Facets that mirror by themselves, spread by D, hidden by G, tinted by F, over a matt base for what \
they let through. Its cost and its highlight are those of the D, G and F that are chosen."""
material = ["roughness"]

[breaks]
energy = """
what the facets mirror at grazing angles is not taken from the base: white plastic sends back 1.3 \
times what comes at n.v = 0.1 and alpha 0.1"""

[parameters.thesis_blend]
kind    = "bool"
default = false
label   = "Blend base and facets by metalness"
---*/
#include "lib/alpha.glsl"
#include "lib/constants.glsl"
#include "lib/frame.glsl"
#include "lib/material.glsl"
#include <distribution>
#include <masking>
#include <fresnel>
#if THESIS_BLEND || !MIRRORS
#include "lib/base.glsl"
#endif

// G / (4 l.z v.z). A masking without visibility is divided by cosines no lower than GRAZING_COS.
float facetsSeen(vec3 l, vec3 v, vec3 h, float alpha) {
#if VISIBILITY
    return visibility(l, v, h, alpha);
#else
    return masking(l, v, h, alpha) / (4.0 * max(l.z, GRAZING_COS) * max(v.z, GRAZING_COS));
#endif
}

// 0 for l on or below the horizon; at v.z = 0 the limit, which a masking with visibility has.
vec3 brdf(Material m, vec3 l, vec3 v) {
    vec3 h = halfVector(l, v);
    float alpha = alphaFromRoughness(m.roughness);
    vec3 F = fresnel(m, dot(v, h));
    vec3 facets = F * (distribution(h, alpha) * facetsSeen(l, v, h, alpha));
#if THESIS_BLEND
    vec3 f = blendWithBase(m, facets);
#elif MIRRORS
    vec3 f = facets;
#else
    vec3 f = overBase(m, F, facets);
#endif
    return l.z > 0.0 && v.z >= 0.0 ? f : vec3(0.0);
}

vec3 brdfCos(Material m, vec3 l, vec3 v) {
    return brdf(m, l, v) * l.z;
}
