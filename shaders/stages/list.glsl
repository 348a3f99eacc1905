/*---
title = "The list of objects"
about = "A texture of a record for each object; then a tree of spheres about them."
---*/
uniform highp sampler2D u_objects;

// The log2 of the texture's width.
const int LIST_BITS = 10;

// Texels of an object, as in traced.py: a sphere around it; its shape, twice its kind of surface and
// 1 more where that has two sides, its mesh or radius, and 1 plus the share of light that it stops,
// negative where both sides stop it; where it is.
const int AROUND = 0;
const int WHAT = 1;
const int PLACE = 2;
// Its shape.
const float BALL = 0.0;
const float TRIANGLE = 1.0;
const float PLANE = 2.0;
const float CUBE = 3.0;
const float CONE = 4.0;
const float ROUND = 5.0;
const float MESH = 6.0;

vec4 listTexel(int at) {
    return texelFetch(u_objects, ivec2(at & ((1 << LIST_BITS) - 1), at >> LIST_BITS), 0);
}

vec4 listed(int object, int texel) {
    return listTexel(object * RECORD + texel);
}

#if ANY_PLACED || ANY_MESH || TAKES_OWN
// Rows of the matrix to the object's own coordinates, as columns.
mat3x4 placeOf(int object) {
    return mat3x4(listed(object, PLACE), listed(object, PLACE + 1), listed(object, PLACE + 2));
}
#endif
