/*---
title    = "Rays and a cone"
equation = 'x^2 + z^2 = (1 - y)^2,\quad 0 \le y \le 1'
source   = "Haines 1989, Essential Ray Tracing Algorithms"
about    = "As the other shapes: lib/shapes.glsl."
---*/
#include "lib/constants.glsl"
#include "lib/longitude.glsl"

// The distance along a ray to the cone's side, entered where side is 1, left where it is -1; or -1.
// About the ray's point nearest to the apex, where nothing cancels; both roots without cancellation.
float coneSide(vec3 origin, vec3 direction, float side) {
    vec3 o = origin - vec3(0.0, 1.0, 0.0);
    float start = -dot(o, direction) / dot(direction, direction);
    o += start * direction;
    vec3 sides = vec3(1.0, -1.0, 1.0);
    float a = dot(direction * sides, direction);
    float b = dot(o * sides, direction) * side;
    float c = dot(o * sides, o);
    float discriminant = b * b - a * c;
    if (discriminant < 0.0) {
        return -1.0;
    }
    float root = sqrt(discriminant);
    float t = side * (b > 0.0 ? -(b + root) / a : c / max(root - b, SLIGHT));
    float y = o.y + t * direction.y;
    return start + t > 0.0 && y <= 0.0 && y >= -1.0 ? start + t : -1.0;
}

// The distance along a ray to the cone's base, or -1.
float coneBase(vec3 origin, vec3 direction) {
    float t = -origin.y / direction.y;
    vec2 disk = origin.xz + t * direction.xz;
    return t > 0.0 && dot(disk, disk) <= 1.0 ? t : -1.0;
}

// The cone x^2 + z^2 = (1 - y)^2 from its base of radius 1 at y = 0 to its apex at y = 1.
float coneHit(vec3 origin, vec3 direction) {
    float base = direction.y > 0.0 ? coneBase(origin, direction) : -1.0;
    return base > 0.0 ? base : coneSide(origin, direction, 1.0);
}

// Where a ray leaves the cone, or -1.
float coneExit(vec3 origin, vec3 direction) {
    float base = direction.y < 0.0 ? coneBase(origin, direction) : -1.0;
    return base > 0.0 ? base : coneSide(origin, direction, -1.0);
}

// Whether a point on the cone's surface is nearer to its base than to its side.
bool onBase(vec3 p) {
    return abs(p.y) < abs(1.0 - p.y - length(p.xz));
}

// Of a point on the cone's surface, and upwards at the apex.
vec3 coneNormal(vec3 p) {
    if (onBase(p)) {
        return vec3(0.0, -1.0, 0.0);
    }
    return dot(p.xz, p.xz) > ON_AXIS ? vec3(p.x, length(p.xz), p.z) : vec3(0.0, 1.0, 0.0);
}

vec3 coneTangent(vec3 p) {
    return onBase(p) ? vec3(1.0, 0.0, 0.0) : east(p);
}

// Around the side and down from the apex; across the base as seen from above.
vec2 coneUv(vec3 p) {
    float turn = longitude(p);
    return onBase(p) ? vec2(0.5, 0.5) + vec2(0.5, -0.5) * p.xz : vec2(turn - floor(turn), 1.0 - p.y);
}
