#include "lib/ray.glsl"

// How far off its surface a ray starts, as a share of the distance to the eye, about which float32
// positions are: 2^-18, so that a second surface in the same place does not stop it.
const float LEAVING = 3.8e-6;

// A ray from a point of a surface with the normal n, to either side.
Ray leaving(vec3 position, vec3 n, vec3 direction) {
    float share = LEAVING * max(max(abs(position.x), abs(position.y)), abs(position.z));
    return Ray(position + (dot(n, direction) < 0.0 ? -share : share) * n, direction);
}

// The object of a ray that meets none, and of one that leaves none.
const int NOTHING = -1;

// What a ray leaves that goes on within the object, which it then meets from within alone. Its own
// inverse.
int within(int object) {
    return -2 - object;
}
