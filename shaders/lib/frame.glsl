/*---
title  = "Directions and the shading frame"
source = "Duff et al. 2017, Building an Orthonormal Basis, Revisited"
---*/

// Below this squared length l + v is rounding only: l and v point against each other.
const float OPPOSITE = 1e-30;

// Squared length below which an interpolated normal has no direction: 1e-10 of its vertices'
// length, far under float32 rounding.
const float NO_NORMAL = 1e-20;

// Orthonormal right-handed basis with third column n. w * basis(n) takes w from the world into the
// shading frame, basis(n) * w takes it back.
// Duff et al. 2017. n unit -> columns orthonormal to 4e-7, at every n, both poles included.
// The comparison is not sign(): GLSL's sign(0) is 0, which would divide by zero on the equator.
mat3 basis(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(
        vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x),
        vec3(b, s + n.y * n.y * a, -n.y),
        n
    );
}

// The unit vector half way between l and v in the shading frame.
// (l + v) / |l + v|; where l = -v, which has no half vector, the normal (0, 0, 1).
vec3 halfVector(vec3 l, vec3 v) {
    vec3 s = l + v;
    float d = dot(s, s);
    return d > OPPOSITE ? s * inversesqrt(d) : vec3(0.0, 0.0, 1.0);
}

// n made unit; a normal too short to have a direction becomes fallback, which must be unit.
vec3 unitNormal(vec3 n, vec3 fallback) {
    float d = dot(n, n);
    return d > NO_NORMAL ? n * inversesqrt(d) : fallback;
}

// A normal that faces the viewer: interpolated and mapped normals may lean away from v on a
// triangle that is seen, and such a normal is mirrored in the plane across v. n - 2 min(n.v, 0) v;
// n and v unit -> unit, n.v >= 0, continuous where n.v = 0, and v for n = -v.
vec3 facingNormal(vec3 n, vec3 v) {
    return n - 2.0 * min(dot(n, v), 0.0) * v;
}
