/*---
title  = "Rays and the shapes of scenes"
source = "Haines 1989, Essential Ray Tracing Algorithms"
about  = """
Each in its own axes, met from outside only: distances in lengths of the direction, which need not \
be unit, or -1. Coordinates and tangents of a point on it are those of its mesh."""
---*/
#include "lib/cone.glsl"
#include "lib/constants.glsl"
#include "lib/longitude.glsl"
#include "lib/sphere.glsl"

// Coordinates on a flat face through the origin with the normal n, whose u grows along t.
vec2 faceUv(vec3 p, vec3 n, vec3 t) {
    return vec2(dot(p, t) + 0.5, 0.5 - dot(p, cross(n, t)));
}

// The square |x|, |z| <= 1/2 at y = 0, seen from above, where side is 1, or from below, -1.
float planeHit(vec3 origin, vec3 direction, float side) {
    float t = -origin.y / direction.y;
    vec2 at = abs(origin.xz + t * direction.xz);
    return direction.y * side < 0.0 && t > 0.0 && max(at.x, at.y) <= 0.5 ? t : -1.0;
}

vec3 planeNormal(vec3 p) {
    return vec3(0.0, 1.0, 0.0);
}

vec3 planeTangent(vec3 p) {
    return vec3(1.0, 0.0, 0.0);
}

vec2 planeUv(vec3 p) {
    return faceUv(p, planeNormal(p), planeTangent(p));
}

// Where a ray enters and leaves the cube |x|, |y|, |z| <= 1/2, by its slabs; farther where it misses.
vec2 cubeSpan(vec3 origin, vec3 direction) {
    vec3 inverse = 1.0 / mix(direction, vec3(SLIGHT), lessThan(abs(direction), vec3(SLIGHT)));
    vec3 a = (-0.5 - origin) * inverse;
    vec3 b = (0.5 - origin) * inverse;
    vec3 enter = min(a, b);
    vec3 leave = max(a, b);
    return vec2(max(max(enter.x, enter.y), enter.z), min(min(leave.x, leave.y), leave.z));
}

float cubeHit(vec3 origin, vec3 direction) {
    vec2 span = cubeSpan(origin, direction);
    return span.x > 0.0 && span.x <= span.y ? span.x : -1.0;
}

// Where a ray leaves the cube, from within or beyond it, or -1.
float cubeExit(vec3 origin, vec3 direction) {
    vec2 span = cubeSpan(origin, direction);
    return span.y > 0.0 && span.x <= span.y ? span.y : -1.0;
}

// Of a point on the cube's surface: the axis along which it is farthest out, on an edge the first.
vec3 cubeNormal(vec3 p) {
    vec3 a = abs(p);
    if (a.x >= max(a.y, a.z)) {
        return vec3(sign(p.x), 0.0, 0.0);
    }
    return a.y >= a.z ? vec3(0.0, sign(p.y), 0.0) : vec3(0.0, 0.0, sign(p.z));
}

// To the right, seen from outside with y upwards; above and below along x.
vec3 cubeTangent(vec3 p) {
    vec3 n = cubeNormal(p);
    return n.y == 0.0 ? vec3(n.z, 0.0, -n.x) : vec3(1.0, 0.0, 0.0);
}

vec2 cubeUv(vec3 p) {
    return faceUv(p, cubeNormal(p), cubeTangent(p));
}

// The unit sphere, for scales that differ along its axes.
float roundHit(vec3 origin, vec3 direction) {
    float inverse = inversesqrt(dot(direction, direction));
    float t = sphereHit(origin, direction * inverse, vec3(0.0), 1.0);
    return dot(origin, origin) > 1.0 && t > 0.0 ? t * inverse : -1.0;
}

// Where a ray leaves it, or -1.
float roundExit(vec3 origin, vec3 direction) {
    float inverse = inversesqrt(dot(direction, direction));
    float t = sphereExit(origin, direction * inverse, vec3(0.0), 1.0);
    return t > 0.0 ? t * inverse : -1.0;
}

vec3 roundNormal(vec3 p) {
    return p;
}

vec3 roundTangent(vec3 p) {
    return east(p);
}

// Longitude and latitude; by atan, which keeps its digits near the poles.
vec2 roundUv(vec3 p) {
    float latitude = atan(p.y, length(p.xz));
    return vec2(0.5 + longitude(p), 0.5 - INV_PI * latitude);
}
