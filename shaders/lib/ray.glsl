/*---
title    = "Rays"
equation = '''
d = \frac{x\, r + y\, u + f}{|x\, r + y\, u + f|}'''
source   = "Whitted 1980, An Improved Illumination Model for Shaded Display"
---*/

// A half line: direction unit.
struct Ray {
    vec3 origin;
    vec3 direction;
};

// Through a point of the picture, x and y from -1 to 1, of which right and up reach to the border at
// the distance of forward; not unit.
vec3 throughPicture(vec2 at, vec3 right, vec3 up, vec3 forward) {
    return at.x * right + at.y * up + forward;
}

// The direction of light that a mirror with the normal n sends into direction; n unit.
vec3 mirrored(vec3 direction, vec3 n) {
    return direction - 2.0 * dot(direction, n) * n;
}
