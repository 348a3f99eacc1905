/*---
title    = "Complex index of a reflectance"
equation = '''
\eta = g\, \frac{1 - r}{1 + r} + (1 - g) \frac{1 + \sqrt{r}}{1 - \sqrt{r}},\quad
k^2 = \frac{r (\eta + 1)^2 - (\eta - 1)^2}{1 - r}'''
source   = "Gulbrandsen 2014, Artist friendly metallic Fresnel, eqs. 11 and 13"
domain   = { f0 = [0.0, 1.0], metalness = [0.0, 1.0] }
---*/

// Greatest reflectance at normal incidence that is given an index: a perfect mirror has none. No
// metal reflects as much.
const float F0_MAX = 0.999;

// Index of the clear medium of reflectance r = f0: (1 + sqrt(r)) / (1 - sqrt(r)), without the
// difference that loses digits near 1. f0 [0, F0_MAX] -> [1, 3998].
vec3 clearEta(vec3 f0) {
    vec3 s = 1.0 + sqrt(f0);
    return s * s / (1.0 - f0);
}

// The paper's edge tint g is the metalness: 0 is the clear medium, 1 the metal that is brightest
// towards the horizon. Not by mix(), whose difference drowns a metal's index. f0, metalness [0, 1] -> [5e-4, 3998].
vec3 etaOf(vec3 f0, float metalness) {
    vec3 r = min(f0, F0_MAX);
    return clearEta(r) * (1.0 - metalness) + (1.0 - r) / (1.0 + r) * metalness;
}

// k of the same, as 2 sqrt(r) / (1 + r) sqrt(g (1 + (1 - g) n^2)), n that of the clear medium: the
// differences in the paper's form vanish for g = 0. f0, metalness [0, 1] -> [0, 1999].
vec3 kOf(vec3 f0, float metalness) {
    vec3 r = min(f0, F0_MAX);
    vec3 n = clearEta(r);
    return 2.0 * sqrt(r) / (1.0 + r) * sqrt(metalness * (1.0 + (1.0 - metalness) * n * n));
}
