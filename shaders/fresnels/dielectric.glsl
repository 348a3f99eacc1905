/*---
title    = "Dielectric, exact"
equation = '''
F = \frac{1}{2} \left(
\left(\frac{\cos\theta_i - \eta \cos\theta_t}{\cos\theta_i + \eta \cos\theta_t}\right)^2 +
\left(\frac{\eta \cos\theta_i - \cos\theta_t}{\eta \cos\theta_i + \cos\theta_t}\right)^2\right),
\quad \eta = \frac{1 + \sqrt{F_0}}{1 - \sqrt{F_0}}'''
source   = "Fresnel 1823; Walter et al. 2007, eq. 22"
domain   = { VoH = [0.0, 1.0] }
about    = """
What a clear medium reflects, with the refractive index that belongs to its reflectance at normal \
incidence. Not for metals: gold comes out half as bright as it is towards grazing angles."""
material = ["f0"]
---*/
#include "lib/constants.glsl"
#include "lib/material.glsl"

// With s = sqrt(f0), r = 1 / eta and q = 1 - r^2 = 4 s / (1 + s)^2, both differences are multiplied
// by their sums: what is left keeps its digits as f0 goes to 0, and is finite for f0 = 1. On the
// horizon it is held at the value for GRAZING_COS, within 1e-6 of 1 from f0 = 0.01.
// f0, VoH [0, 1] -> [0, 1].
vec3 fresnel(Material m, float VoH) {
    float c = clamp(VoH, GRAZING_COS, 1.0);
    vec3 s = sqrt(m.f0);
    vec3 r = (1.0 - s) / (1.0 + s);
    vec3 q = 4.0 * s / ((1.0 + s) * (1.0 + s));
    vec3 cosT = sqrt(q + r * r * c * c);
    vec3 across = r * c + cosT;
    vec3 along = c + r * cosT;
    vec3 Rs = q / (across * across);
    vec3 Rp = q * (c * c * (1.0 + r * r) - r * r) / (along * along);
    return 0.5 * (Rs * Rs + Rp * Rp);
}
