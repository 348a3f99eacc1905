/*---
title    = "Toon"
equation = '''
L = \rho \left(\mathrm{dark} + (\mathrm{lit} - \mathrm{dark})
\frac{\lceil \bar{t} - 1/2 \rceil}{N - 1}\right),\quad
t_i = \min(\lfloor N \cos\theta_i \rfloor,\ N - 1)'''
source   = "Lake et al. 2000; Akenine-Moller et al. 2018, Real-Time Rendering, p. 652"
domain   = { tones = [2.0, 8.0] }
unit     = "1/sr"
about    = """
A drawing in few colours. Each light has a tone by its angle alone, however bright it is, and the \
lights vote: of two tones the brighter one shows where more lights have it than not."""
material = ["base_color"]

[breaks]
reciprocity = "the tone follows from n.l alone"
energy      = "the tones are colours, not shares of the light that comes"
continuity  = "between two tones lies an edge, on which the rounding of n.l decides"

[parameters.tones]
kind    = "int"
default = 2
range   = [2, 8]
step    = 1
label   = "Tones"

[parameters.toon_dark]
kind    = "color"
default = [0.2, 0.25, 0.4]
label   = "Darkest tone"

[parameters.toon_lit]
kind    = "color"
default = [1.0, 1.0, 1.0]
label   = "Lightest tone"
---*/
#include "lib/constants.glsl"
#include "lib/material.glsl"

// The tone of one light, from 0: of two tones, 1 from 60 degrees off the normal inwards. cosine
// [0, 1], times the share of the light that arrives -> 0, 1, ... TONES - 1.
float toneLevel(float cosine) {
    return clamp(floor(cosine * float(TONES)), 0.0, float(TONES - 1));
}

// The colour of the mean of the lights' tones, rounded, halves down: a tie is dark. meanLevel
// [0, TONES - 1] -> cd/m^2 per white of 1.
vec3 toned(Material m, float meanLevel) {
    float level = ceil(meanLevel - 0.5) / float(TONES - 1);
    return m.base_color * mix(u_toon_dark, u_toon_lit, level);
}

// One light's tone, for an illuminance of pi across it: that lights a white matt surface to 1.
vec3 brdfCos(Material m, vec3 l, vec3 v) {
    vec3 tone = toned(m, toneLevel(l.z)) * INV_PI;
    return l.z > 0.0 && v.z >= 0.0 ? tone : vec3(0.0);
}

// Infinite on the horizon: held at the value for l.z = GRAZING_COS.
vec3 brdf(Material m, vec3 l, vec3 v) {
    return brdfCos(m, l, v) / max(l.z, GRAZING_COS);
}
