/*---
title    = "Phong"
equation = 'f = k_d + k_s \frac{\max(0,\ r \cdot v)^s}{n \cdot l},\quad r = 2 (n \cdot l)\, n - l'
source   = "Phong 1975, p. 315"
domain   = { shininess = [0.0, 1e6] }
unit     = "1/sr"
about    = """
A matt colour and a highlight around the mirrored light. Cheap, and shaped by eye: the highlight \
keeps its brightness as it narrows, and at grazing angles it sends back more light than came."""
material = ["kd", "ks", "shininess"]

[breaks]
reciprocity = "the highlight's f(l, v) / f(v, l) is (n.v) / (n.l), from the division by n.l alone"
energy      = "the highlight is not normalised, and f grows without bound as n.l goes to 0"
---*/
#include "lib/constants.glsl"
#include "lib/material.glsl"
#include "lib/specular_power.glsl"

// brdf * l.z: here the division by n.l has cancelled, so the horizon is no 0/0.
// The squared sine between the unit vectors r and v comes from their chord e = r - v, whose digits
// survive where r.v rounds to 1: sin^2 = |e|^2 (1 - |e|^2 / 4). Shininess 0 gives 1 wherever lit.
vec3 brdfCos(Material m, vec3 l, vec3 v) {
    vec3 r = vec3(-l.xy, l.z);
    vec3 e = r - v;
    float chord2 = dot(e, e);
    float lobe = specularPower(dot(r, v), chord2 * (1.0 - 0.25 * chord2), m.shininess);
    return l.z > 0.0 && v.z >= 0.0 ? m.kd * l.z + m.ks * lobe : vec3(0.0);
}

// Infinite on the horizon where the lobe reaches it: held at the value for l.z = GRAZING_COS.
vec3 brdf(Material m, vec3 l, vec3 v) {
    return brdfCos(m, l, v) / max(l.z, GRAZING_COS);
}
