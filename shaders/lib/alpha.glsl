// Narrowest microfacet lobe. At 1e-4 D peaks at 3e7 /sr, finite in float32 with room for bright
// lights, and the lobe is still 1000 times wider than the rounding of a float32 half vector. A
// mirror (alpha 0) has no D at all.
const float ALPHA_MIN = 1e-4;

// Microfacet width of the roughness slider: alpha = roughness^2, which looks even along the slider.
// Burley 2012, section 5.4. roughness [0, 1] -> [ALPHA_MIN, 1].
float alphaFromRoughness(float roughness) {
    return max(roughness * roughness, ALPHA_MIN);
}
