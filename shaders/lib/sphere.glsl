/*---
title    = "Ray and sphere"
equation = '''
t = \frac{|f|^2 - r^2}{b + \sqrt{\Delta}},\quad b = -f \cdot d,\quad
\Delta = r^2 - |f + b\, d|^2,\quad f = o - c'''
source   = "Haines et al. 2019, Precision Improvements for Ray/Sphere Intersection"
---*/

// What sphereHit returns for a ray that meets no sphere.
const float NO_HIT = -1.0;

// Distance along a ray to the first point of a sphere in front of its origin, or NO_HIT.
// The discriminant from the centre's distance to the ray, which keeps its digits for a far sphere
// where b^2 - |f|^2 + r^2 has lost them (Hearn & Baker); the nearer root as a quotient, which does
// not subtract b and its like. direction unit, radius >= 0.
float sphereHit(vec3 origin, vec3 direction, vec3 centre, float radius) {
    vec3 f = origin - centre;
    float b = -dot(f, direction);
    vec3 nearest = f + b * direction;
    float discriminant = radius * radius - dot(nearest, nearest);
    if (discriminant < 0.0) {
        return NO_HIT;
    }
    float away = length(f);
    float product = (away - radius) * (away + radius);
    float root = b < 0.0 ? b - sqrt(discriminant) : b + sqrt(discriminant);
    if (product > 0.0) {
        return b > 0.0 ? product / root : NO_HIT;
    }
    return b < 0.0 ? product / root : root;
}

// Distance along a ray that starts in a sphere, or as good as on it, to where it leaves, or NO_HIT.
float sphereExit(vec3 origin, vec3 direction, vec3 centre, float radius) {
    vec3 f = origin - centre;
    float b = -dot(f, direction);
    vec3 nearest = f + b * direction;
    float discriminant = radius * radius - dot(nearest, nearest);
    float t = b + sqrt(max(discriminant, 0.0));
    return discriminant >= 0.0 && t > 0.0 ? t : NO_HIT;
}
