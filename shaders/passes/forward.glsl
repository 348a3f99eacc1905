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

#include "stages/opacity.glsl"
#if INSPECT_NORMAL
#include "stages/eye.glsl"
#include "stages/normal.glsl"
#include <view>
#elif INSPECT
#include "stages/material.glsl"
#include <view>
#elif UNLIT
#if !(REFLECTED || TERM || SEEN)
#include "stages/emission.glsl"
#endif
#else
#include "stages/material.glsl"
#if LIGHT_COUNT
#include "stages/eye.glsl"
#include "stages/normal.glsl"
#endif
#if REFLECTED || TERM || SEEN
#include <view>
#else
#include <ambient>
#include "stages/occlusion.glsl"
#if EMITS
#include "stages/emission.glsl"
#endif
#endif
#if LIGHT_COUNT
#include "stages/lights.glsl"
#endif
#endif

out vec4 o_radiance;

vec3 radianceAt(Texels t) {
#if INSPECT_NORMAL
    return inspectNormal(readNormal(t, towardsEye()));
#elif INSPECT
    return inspect(readMaterial(t));
#elif UNLIT && (REFLECTED || TERM || SEEN)
    // It answers no light.
    return vec3(0.0);
#elif UNLIT
    return readEmission(t);
#else
    Material m = readMaterial(t);
    vec3 radiance = vec3(0.0);
#if !(REFLECTED || TERM || SEEN)
    radiance = ambient(m) * readOcclusion(t);
#if EMITS
    radiance += readEmission(t);
#endif
#endif
#if LIGHT_COUNT
    vec3 toEye = towardsEye();
    radiance += fromLights(m, readNormal(t, toEye), toEye);
#endif
    return radiance;
#endif
}

void main() {
    Texels t = readTexels();
    float opacity = readOpacity(t);
    o_radiance = vec4(radianceAt(t), opacity);
}

#endif
