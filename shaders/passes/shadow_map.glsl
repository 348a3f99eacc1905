/*---
title = "Shadow map"
about = """
What a light sees: the squared distance to the nearest surface over the square of far. Drawn again \
only when its light or an object has changed."""
draw  = "objects"
each  = "light"
keep  = true

[writes.shadow_map]
format = "r32f"
side   = "shadow_resolution"
depth  = true
clear  = [1.0, 1.0, 1.0, 1.0]

[parameters.shadow_resolution]
kind    = "int"
default = 1024
range   = [256, 4096]
step    = 256
unit    = "texels"
label   = "Shadow map resolution"
---*/
#include "stages/object.glsl"
#if FRAGMENT

#include "stages/opacity.glsl"

uniform float u_map_far;
uniform vec3 u_map_axis;

out vec4 o_shadow_map;

void main() {
    readOpacity(readTexels());
#for OWN_LIGHTS
#if @{directional}
    float share = dot(v_position, u_map_axis) / u_map_far;
#else
    float share = length(v_position) / u_map_far;
#endif
#endfor
    o_shadow_map = vec4(share * share, 0.0, 0.0, 1.0);
}

#endif
