/*---
title    = "Conductor, exact"
equation = '''
F = \frac{1}{2} \left|\frac{\cos\theta_i - t}{\cos\theta_i + t}\right|^2 \left(1 +
\left|\frac{t \cos\theta_i - \sin^2\theta_i}{t \cos\theta_i + \sin^2\theta_i}\right|^2\right),
\quad t = \sqrt{(\eta + i k)^2 - \sin^2\theta_i}'''
source   = "Fresnel 1823; Born & Wolf 1999, sec. 14.2"
domain   = { VoH = [0.0, 1.0], eta = [0.01, 100.0], k = [0.0, 100.0] }
about    = """
What a metal reflects, by its complex refractive index for red, green and blue. Where a material \
has none, the one that belongs to its reflectance and metalness. Two square roots and three \
divisions dearer than Schlick's curve, which iron leaves by 0.18."""
material = ["eta", "k"]
---*/
#include "lib/constants.glsl"
#include "lib/material.glsl"

// With t = a + i b, |t|^2 = r and t^2 = d + i p, the first ratio is that of (eta - 1)^2 + k^2 and
// (eta + 1)^2 + k^2 to |cos + t|^4: like the second, sums of nothing negative. d is taken about
// eta = 1, where F is small, and the smaller of a and b follows from the larger: what is left is
// 1e-6 off. Only a clear medium thinner than air is worse: at the angle from which it reflects all
// light, F is as steep as the cosine is coarse. On the horizon F is held at the value for
// GRAZING_COS. VoH [0, 1], eta [0.01, 100], k [0, 100] -> [0, 1].
vec3 fresnel(Material m, float VoH) {
    float c = clamp(VoH, GRAZING_COS, 1.0);
    float sin2 = (1.0 - c) * (1.0 + c);
    vec3 below = m.eta - 1.0;
    vec3 above = m.eta + 1.0;
    vec3 k2 = m.k * m.k;
    vec3 d = below * above - k2 + c * c;
    vec3 p = 2.0 * m.eta * m.k;
    vec3 r = sqrt(d * d + p * p);
    vec3 larger = sqrt(0.5 * (r + abs(d)));
    vec3 a = mix(larger, 0.5 * p / larger, lessThan(d, vec3(0.0)));
    vec3 b2 = r - a * a;
    vec3 across = c * c + r + 2.0 * c * a;
    vec3 Rs = (below * below + k2) * (above * above + k2) / (across * across);
    vec3 minus = c * a - sin2;
    vec3 plus = c * a + sin2;
    vec3 bc2 = c * c * b2;
    return 0.5 * Rs * (1.0 + (minus * minus + bc2) / (plus * plus + bc2));
}
