/*---
title = "Supersampling resolve"
about = """
The mean of samples x samples linear values per pixel. An invalid sample is handed on whole, so \
that averaging cannot hide it; the mean of finite ones is finite."""
draw  = "screen"
reads = ["radiance"]
when  = "samples > 1"

[writes.linear]
format = "rgba32f"

[parameters.samples]
kind    = "int"
default = 1
range   = [1, 8]
step    = 1
label   = "Samples per pixel and axis"
---*/
#include "lib/screen.glsl"
#if FRAGMENT

#include "lib/invalid.glsl"

out vec4 o_linear;

// Each value is weighted before it is added: the sum of values near float32's largest overflows,
// their mean does not.
const float WEIGHT = 1.0 / float(SAMPLES * SAMPLES);

void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * SAMPLES;
    vec3 mean = vec3(0.0);
    for (int y = 0; y < SAMPLES; ++y) {
        for (int x = 0; x < SAMPLES; ++x) {
            vec3 radiance = texelFetch(u_radiance, corner + ivec2(x, y), 0).rgb;
#if SIGNED
            bool lost = any(isnan(radiance)) || any(isinf(radiance));
#else
            bool lost = invalid(radiance);
#endif
            if (lost) {
                o_linear = vec4(radiance, 1.0);
                return;
            }
            mean += WEIGHT * radiance;
        }
    }
    o_linear = vec4(mean, 1.0);
}

#endif
