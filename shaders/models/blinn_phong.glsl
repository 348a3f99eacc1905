/*---
title    = "Blinn-Phong"
equation = 'f = k_d + k_s \frac{\max(0,\ n \cdot h)^s}{n \cdot l}'
source   = "Blinn 1977, p. 193"
domain   = { shininess = [0.0, 1e6] }
unit     = "1/sr"
about    = """
Phong with the half vector: the highlight stretches at grazing angles as real ones do. It looks \
like Phong's at four times the shininess, costs the same and is as little normalised."""
material = ["kd", "ks", "shininess"]

[breaks]
reciprocity = "the highlight's f(l, v) / f(v, l) is (n.v) / (n.l), from the division by n.l alone"
energy      = "the highlight is not normalised, and f grows without bound as n.l goes to 0"
---*/
#include "lib/constants.glsl"
#include "lib/frame.glsl"
#include "lib/material.glsl"
#include "lib/specular_power.glsl"

// brdf * l.z: here the division by n.l has cancelled, so the horizon is no 0/0.
// Shininess 0 gives 1 wherever lit.
vec3 brdfCos(Material m, vec3 l, vec3 v) {
    vec3 h = halfVector(l, v);
    float lobe = specularPower(h.z, dot(h.xy, h.xy), m.shininess);
    return l.z > 0.0 && v.z >= 0.0 ? m.kd * l.z + m.ks * lobe : vec3(0.0);
}

// Infinite on the horizon: held at the value for l.z = GRAZING_COS.
vec3 brdf(Material m, vec3 l, vec3 v) {
    return brdfCos(m, l, v) / max(l.z, GRAZING_COS);
}
