/*---
title   = "Occlusion at a fragment"
source  = "glTF 2.0, 3.9.3: 1 + strength (map - 1)"
about   = "The share of the ambient light that a surface's own hollows let in."
surface = ["occlusion"]
---*/
#include "stages/texels.glsl"

uniform float u_occlusion_strength;

float readOcclusion(Texels t) {
    float open = 1.0;
#for OCCLUSION_MAPS
    open += u_occlusion_strength * (t.@{texel}.@{channel} - 1.0);
#endfor
    return open;
}
