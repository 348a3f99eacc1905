// x^5 by squaring: a pow() costs as much as 130 multiplications on a software rasteriser.
float pow5(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

// Reflectance at normal incidence of the border between two clear media.
// ((n1 - n2) / (n1 + n2))^2. Fresnel; n1, n2 > 0 -> [0, 1).
float fresnel0(float n1, float n2) {
    float r = (n1 - n2) / (n1 + n2);
    return r * r;
}
