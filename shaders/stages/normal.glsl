/*---
title   = "Normal at a fragment"
source  = "MikkTSpace; glTF 2.0, 3.9.3"
about   = "The interpolated normal, bent by a normal map, facing the viewer."
surface = ["normal"]
---*/
#include "lib/frame.glsl"
#include "lib/tangent.glsl"
#include "stages/texels.glsl"

uniform float u_normal_scale;

vec3 readNormal(Texels t, vec3 toEye) {
    vec3 n = v_normal;
#for NORMAL_MAPS
    n = mappedNormal(v_normal, v_tangent, t.@{texel}.rgb, u_normal_scale);
#endfor
    n = unitNormal(n, toEye);
#if UNFLIPPED
    return n;
#else
#if ANY_DOUBLE && TRACED
    n = v_front ? n : -n;
#elif DOUBLE_SIDED && !TRACED
    n = gl_FrontFacing ? n : -n;
#endif
    return facingNormal(n, toEye);
#endif
}
