/*---
title = "The list of objects"
about = "A texture of a record for each object."
---*/
uniform highp sampler2D u_objects;

// The log2 of the texture's width.
const int LIST_BITS = 10;

// Texels of an object, as in object_list.py: a sphere around it; its shape, its kind of surface, its
// mesh or radius, and 1 plus the share of light that it stops, negative where both sides are seen;
// where it is.
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

vec4 listed(int object, int texel) {
    int at = object * RECORD + texel;
    return texelFetch(u_objects, ivec2(at & ((1 << LIST_BITS) - 1), at >> LIST_BITS), 0);
}

#if ANY_PLACED || ANY_MESH || TAKES_OWN
// Rows of the matrix to the object's own coordinates, as columns.
mat3x4 placeOf(int object) {
    return mat3x4(listed(object, PLACE), listed(object, PLACE + 1), listed(object, PLACE + 2));
}
#endif
