/*---
title   = "Emitted radiance at a fragment"
source  = "glTF 2.0, 3.9.2; KHR_materials_unlit"
about   = "What the surface sends out by itself; of an unlit material, its base colour."
surface = ["emission"]
---*/
#include "stages/texels.glsl"

#if UNLIT
uniform vec3 u_base_color;
#else
uniform vec3 u_emissive;
#endif

vec3 readEmission(Texels t) {
#if UNLIT
    vec3 emitted = u_base_color;
#for BASE_COLOR_MAPS
    emitted *= t.@{texel}.rgb;
#endfor
#if VERTEX_COLORS
    emitted *= v_color.rgb;
#endif
#else
    vec3 emitted = u_emissive;
#for EMISSIVE_MAPS
    emitted *= t.@{texel}.rgb;
#endfor
#endif
    return emitted;
}
