/*---
title    = "Ordered dither, 8 x 8"
equation = '\lfloor 255\, c + (M_{xy} + \tfrac{1}{2}) / 64 \rfloor / 255'
source   = "Bayer 1973, An optimum method for two-level rendition of continuous-tone pictures"
domain   = { code = [0.0, 1.0] }
about    = """
The levels on both sides mixed in a fixed pattern: up to a level off in a pixel, but no more than 1/128 \
of one in the mean of 8 x 8, so that a slow gradient shows no bands. The pattern can be seen."""
---*/
// The rank, 0 to 63, of a pixel in Bayer's matrix: the bits of x ^ y and of y in turns, the lowest
// first, so that the ranks next to each other lie as far apart as they can.
int bayer(ivec2 pixel) {
    int a = pixel.x ^ pixel.y;
    int b = pixel.y;
    int coarse = (a & 1) << 5 | (b & 1) << 4;
    int middle = (a & 2) << 2 | (b & 2) << 1;
    int fine = (a & 4) >> 1 | (b & 4) >> 2;
    return coarse | middle | fine;
}

// [0, 1] -> whole levels over 255. The half centres the 64 thresholds, so that a code that is a
// level stays it in every pixel, whatever the last digits of 255 c.
vec3 quantise(vec3 code, ivec2 pixel) {
    float threshold = (float(bayer(pixel)) + 0.5) / 64.0;
    return floor(255.0 * code + threshold) / 255.0;
}
