/*---
title  = "Specular light"
equation = 'f_{\mathrm{base} = 0}\, E \cos\theta_l'
about  = """
The direct light that the surface mirrors: the answer of the same surface with a black base."""
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"
#include <model>
#include "lib/split.glsl"

// The whole less what the diffuse view shows.
vec3 reflected(Material m, vec3 l, vec3 v) {
    vec3 whole = brdf(m, l, v);
    vec3 base = max(whole - brdf(withoutBase(m), l, v), 0.0);
#if BRDF_COS
    return max(brdfCos(m, l, v) - base * l.z, 0.0);
#else
    return max(whole - base, 0.0) * l.z;
#endif
}
#else
#include <tonemap>
#include <transfer>

vec3 view(vec3 radiance) {
    return transfer(tonemap(radiance));
}
#endif
