/*---
title    = "Ray and triangle"
equation = '''
t = \frac{(f \times e_1) \cdot e_2}{(d \times e_2) \cdot e_1},\quad f = o - v_0'''
source   = "Moller & Trumbore 1997, Fast, Minimum Storage Ray/Triangle Intersection"
---*/

// How far beyond its edges a triangle is still met, as a share of them: what float32 loses, so that
// no ray slips between two triangles that share an edge.
const float EDGE = 1e-6;

// Distance along a ray to a triangle in front of its origin, from either side, or -1. The edges
// belong to it. v0 a corner, e1 and e2 the edges from it; a triangle without an area is never met.
float triangleHit(vec3 origin, vec3 direction, vec3 v0, vec3 e1, vec3 e2) {
    vec3 across = cross(direction, e2);
    float determinant = dot(across, e1);
    if (determinant == 0.0) {
        return -1.0;
    }
    float inverse = 1.0 / determinant;
    vec3 f = origin - v0;
    float u = dot(f, across) * inverse;
    vec3 q = cross(f, e1);
    float v = dot(direction, q) * inverse;
    float t = dot(e2, q) * inverse;
    bool inside = min(u, v) >= -EDGE && u + v <= 1.0 + EDGE;
    return inside && t > 0.0 ? t : -1.0;
}

// The shares of the edges e1 and e2 in a vector, across which the triangle's normal is of no matter.
vec2 alongEdges(vec3 offset, vec3 e1, vec3 e2) {
    vec3 n = cross(e1, e2);
    return vec2(dot(cross(offset, e2), n), dot(cross(e1, offset), n)) / dot(n, n);
}
