// Whether a tone curve by luminance applies: finite luminance above 0. Otherwise the curve leaves
// the colour as it is, so that NaN, infinite and negative light stay what they are and are seen; at
// luminance 0 the curves' factor is 1 as well, so nothing jumps.
bool hasTone(float Y) {
    return Y > 0.0 && !isinf(Y);
}
