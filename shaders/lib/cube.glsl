/*---
title  = "The six faces of a cube map"
source = "faces +x -x +y -y +z -z; up is +y, on the y faces -z and +z"
---*/

// Where a direction meets the cube: (u, v, face), u and v in [0, 1] from the face's lower left.
// d need not be unit, and must not be zero.
vec3 cubeFace(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) {
        return vec3(0.5 + 0.5 * vec2(d.x > 0.0 ? d.z : -d.z, d.y) / a.x, d.x > 0.0 ? 0.0 : 1.0);
    }
    if (a.y >= a.z) {
        return vec3(0.5 + 0.5 * vec2(-d.x, d.y > 0.0 ? -d.z : d.z) / a.y, d.y > 0.0 ? 2.0 : 3.0);
    }
    return vec3(0.5 + 0.5 * vec2(d.z > 0.0 ? -d.x : d.x, d.y) / a.z, d.z > 0.0 ? 4.0 : 5.0);
}

// The direction of a point of a face's plane, of length 1 along the face's axis: the inverse of
// cubeFace, and beyond it where u or v leave [0, 1].
vec3 cubeDirection(vec3 at) {
    vec2 p = 2.0 * at.xy - 1.0;
    if (at.z < 1.5) {
        return at.z < 0.5 ? vec3(1.0, p.y, p.x) : vec3(-1.0, p.y, -p.x);
    }
    if (at.z < 3.5) {
        return at.z < 2.5 ? vec3(-p.x, 1.0, -p.y) : vec3(-p.x, -1.0, p.y);
    }
    return at.z < 4.5 ? vec3(-p.x, p.y, 1.0) : vec3(p.x, p.y, -1.0);
}
