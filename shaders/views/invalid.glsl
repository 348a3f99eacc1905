/*---
title  = "Invalid values"
source = "IEEE 754-2019"
about  = """
NaN is magenta, infinity yellow, negative light cyan; the rest of the picture is a dim grey."""
equation = '\frac{1}{4} \sqrt{\frac{L}{1 + L}}'
---*/
#include "lib/invalid.glsl"
#include "lib/luminance.glsl"

// Brightest grey of a valid pixel: dark enough that one loud pixel stands out.
const float DIM = 0.25;

// The grey keeps to itself, no tone curve or transfer chosen elsewhere: it must show at any
// brightness.
vec3 view(vec3 radiance) {
    float Y = luminance(radiance);
    return flagInvalid(radiance, vec3(DIM * sqrt(Y / (1.0 + Y))));
}
