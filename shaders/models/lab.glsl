/*---
title    = "Blinn-Phong of the lab"
equation = '''
f \cos\theta_l = k_d\, [n \cdot l] + k_s\, [n \cdot h]^s,\quad [x] = x\ \mathrm{if}\ x > 0.001,\ \mathrm{else}\ 0'''
source   = "a lab script on ray tracing, eqs. 1.42 to 1.48"
domain   = { shininess = [0.0, 1e6] }
unit     = "1/sr"
about    = """
Blinn-Phong with two thresholds where others have 0, from whichever side it is seen: a triangle that \
is lit from behind has its ambient light only."""
material = ["kd", "ks", "shininess"]

[breaks]
reciprocity = "the highlight's f(l, v) / f(v, l) is (n.v) / (n.l), from the division by n.l alone"
energy      = "the highlight is not normalised, and f grows without bound as n.l goes to 0"
continuity  = "at the thresholds a whole highlight comes or goes"
---*/
#include "lib/constants.glsl"
#include "lib/frame.glsl"
#include "lib/material.glsl"
#include "lib/specular_power.glsl"

// Least cosine that counts.
const float LAB_COS_MIN = 1e-3;

vec3 brdfCos(Material m, vec3 l, vec3 v) {
    vec3 h = halfVector(l, v);
    float lobe = h.z > LAB_COS_MIN ? specularPower(h.z, dot(h.xy, h.xy), m.shininess) : 0.0;
    return l.z > LAB_COS_MIN ? m.kd * l.z + m.ks * lobe : vec3(0.0);
}

// Held at the value for l.z = GRAZING_COS, which is 0 there already.
vec3 brdf(Material m, vec3 l, vec3 v) {
    return brdfCos(m, l, v) / max(l.z, GRAZING_COS);
}

bool unflipped() {
    return true;
}

// An image multiplies all that the surface sends out, highlights too.
vec3 modulated(vec3 radiance, vec3 tint) {
    return radiance * tint;
}
