/*---
title   = "Opacity at a fragment"
source  = "glTF 2.0, 3.9.4"
about   = "1 for an opaque material; one with a mask is not there below its cutoff."
surface = ["opacity"]
---*/
#include "stages/texels.glsl"

uniform float u_opacity;
uniform float u_alpha_cutoff;

float readOpacity(Texels t) {
#if BLEND || MASK
    float opacity = u_opacity;
#for BASE_COLOR_MAPS
    opacity *= t.@{texel}.a;
#endfor
#if VERTEX_COLORS
    opacity *= v_color.a;
#endif
#if BLEND
    return opacity;
#else
#if TRACED
    return opacity < u_alpha_cutoff ? 0.0 : 1.0;
#else
    if (opacity < u_alpha_cutoff) {
        discard;
    }
    return 1.0;
#endif
#endif
#else
    return 1.0;
#endif
}
