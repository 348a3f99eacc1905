#include "lib/invalid.glsl"

// Display-linear light that a display can show: each channel clamped to [0, 1]. A NaN in any
// channel makes the pixel magenta, which every transfer keeps: clamp(NaN) is undefined, and an
// 8-bit target would turn it into black.
vec3 displayRange(vec3 linear) {
    return any(isnan(linear)) ? NAN_COLOR : clamp(linear, 0.0, 1.0);
}
