/*---
title = "A light's map as a picture"
about = "As large as fits into the picture, in its middle; grey beside it."
draw  = "screen"
when  = "view == 'light_depth'"
reads = ["shadow_map"]

[writes.radiance]
format = "rgba32f"
scale  = "samples"

[parameters.depth_light]
kind    = "int"
default = 0
range   = [0, 63]
step    = 1
label   = "Light whose depth is shown"
---*/
#include "lib/screen.glsl"
#if FRAGMENT

uniform vec2 u_resolution;

out vec4 o_radiance;

// What is beside the map, and the map of a light that casts no shadow.
const vec3 BESIDE = vec3(0.18);

void main() {
    vec3 shown = BESIDE;
#for CASTERS
#if @{index} == DEPTH_LIGHT
    vec2 size = vec2(textureSize(u_shadow_map@{index}, 0));
    float scale = max(size.x / u_resolution.x, size.y / u_resolution.y);
    vec2 at = (gl_FragCoord.xy - 0.5 * u_resolution) * scale + 0.5 * size;
    if (all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, size))) {
        shown = texelFetch(u_shadow_map@{index}, ivec2(at), 0).rrr;
    }
#endif
#endfor
    o_radiance = vec4(shown, 1.0);
}

#endif
