/*---
title    = "Longitude"
equation = '\frac{\mathrm{atan}(x, z)}{2 \pi}'
source   = "the plate carree projection"
about    = "Turns about y, from z towards x: -1/2 to 1/2, and 0 on the axis, where atan has no value."
---*/
#include "lib/constants.glsl"

// Squared distance from the axis within which no direction leads away from it.
const float ON_AXIS = 1e-24;

// p of any length.
float longitude(vec3 p) {
    return p.x == 0.0 && p.z == 0.0 ? 0.0 : 0.5 * INV_PI * atan(p.x, p.z);
}

// The direction in which it grows, as long as the distance from the axis; on the axis along x.
vec3 east(vec3 p) {
    return dot(p.xz, p.xz) > ON_AXIS ? vec3(p.z, 0.0, -p.x) : vec3(1.0, 0.0, 0.0);
}
