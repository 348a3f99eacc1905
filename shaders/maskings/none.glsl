/*---
title    = "None"
equation = 'G = 1'
source   = "the microfacet integral without its masking term"
domain   = { alpha = [1e-4, 1.0] }
about    = """
No facet hides another. Free, and too bright: at grazing angles the surface sends back far more \
than it gets."""

[breaks]
energy = "with G = 1 the division by n.v is unbounded towards the horizon"
---*/
float masking(vec3 l, vec3 v, vec3 h, float alpha) {
    return 1.0;
}
