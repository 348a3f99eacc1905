/*---
title       = "Ray and sphere, textbook form"
textbook_of = "sphere"
equation    = 't = \frac{-b - \sqrt{b^2 - 4 a c}}{2 a}'
source      = "any textbook of computer graphics"
domain      = { distance = [0.0, 30.0] }
---*/

// For comparison only. Both terms of b^2 - 4 a c grow with the square of the distance, and their
// difference is of the size of the radius squared: at 1000 radii one ray in 30 is judged wrong.
float sphereHit(vec3 origin, vec3 direction, vec3 centre, float radius) {
    vec3 f = origin - centre;
    float a = dot(direction, direction);
    float b = 2.0 * dot(f, direction);
    float c = dot(f, f) - radius * radius;
    float discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) {
        return -1.0;
    }
    float near = (-b - sqrt(discriminant)) / (2.0 * a);
    float far = (-b + sqrt(discriminant)) / (2.0 * a);
    return near > 0.0 ? near : far > 0.0 ? far : -1.0;
}
