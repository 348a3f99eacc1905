/*---
title = "Normals and distances"
about = "The geometry's normal in the world and the distance from the eye, for outlines."
draw  = "objects"

[writes.normal_distance]
format = "rgba32f"
depth  = true
---*/
#include "stages/object.glsl"
#if FRAGMENT

#include "lib/frame.glsl"
#include "stages/eye.glsl"
#include "stages/opacity.glsl"

out vec4 o_normal_distance;

void main() {
    readOpacity(readTexels());
    vec3 toEye = towardsEye();
    vec3 n = facingNormal(unitNormal(v_normal, toEye), toEye);
    o_normal_distance = vec4(n, length(v_position));
}

#endif
