/*---
title    = "Truncation"
equation = '\lfloor 255\, c \rfloor / 255'
source   = "a lab script on ray tracing, eq. 2.1"
domain   = { code = [0.0, 1.0] }
about    = """
What a cast to a whole number does: up to a level too dark, half a level on average, and white is left \
for what is exactly 1."""
---*/
// [0, 1] -> whole levels over 255, never above the code.
vec3 quantise(vec3 code, ivec2 pixel) {
    return floor(255.0 * code) / 255.0;
}
