/*---
title  = "Diffuse light"
equation = '(f - f_{\mathrm{base} = 0})\, E \cos\theta_l'
about  = """
The direct light that the base scatters: the whole answer less that of the same surface with a black base."""
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"
#include <model>
#include "lib/split.glsl"

vec3 reflected(Material m, vec3 l, vec3 v) {
    return max(brdf(m, l, v) - brdf(withoutBase(m), l, v), 0.0) * l.z;
}
#else
#include <tonemap>
#include <transfer>

vec3 view(vec3 radiance) {
    return transfer(tonemap(radiance));
}
#endif
