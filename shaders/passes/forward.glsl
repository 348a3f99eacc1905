/*---
title = "Forward shading"
about = "Every object once, every light in turn, into linear radiance."
draw  = "objects"
blend = "over"

[writes.radiance]
format = "rgba32f"
scale  = "samples"
depth  = true
clear  = "background"

[parameters.sphere_error]
kind    = "float"
default = 0.1
range   = [0.01, 4.0]
step    = 0.01
unit    = "px"
label   = "Sphere silhouette error"

[parameters.subdivision]
kind    = "int"
default = -1
range   = [-1, 7]
step    = 1
label   = "Sphere subdivision (-1 follows the error)"
---*/
#include "stages/object.glsl"
#if FRAGMENT

#include "stages/surface.glsl"

out vec4 o_radiance;

void main() {
    o_radiance = surfaceLight();
}

#endif
