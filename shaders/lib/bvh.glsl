/*---
title  = "Rays and the triangles of a mesh"
source = """
Torres et al. 2009, Ray Casting using a Roped BVH with CUDA; Ize 2013, Robust BVH Ray Traversal"""
about  = """
Through the table of texels that lightbench.bvh makes of a mesh, which begins at the texel `base`. \
Its nodes come in the order in which a ray meets them, so no list is kept of those still to look \
at. Origin and direction are in the mesh's own coordinates; distances are in lengths of the \
direction, which need not be unit."""
---*/
#include "lib/mesh_table.glsl"
#include "lib/watertight.glsl"

// What a ray meets: the triangle by its place in the table, or NO_TRIANGLE at the distance that was
// the limit; and the weights there of its second and third corner.
struct MeshHit {
    float distance;
    int triangle;
    vec2 weights;
};

// The triangle of a ray that meets none, and of one that leaves none.
const int NO_TRIANGLE = -1;

// As in bvh.py: what a lower side is counted from, and the bits of how many triangles a leaf has.
const float BIAS = 32768.0;
const int COUNT_BITS = 3;
const int COUNT_MASK = 7;

// What of a coordinate float32 may have lost by the time that a box is met or not: 16 roundings.
const float ROUNDING = 9.5e-7;

// The least component of a direction, as a share of the largest: below, a ray stays within the
// rounding of a box's side all through it.
const float LEAST_SHARE = 1e-12;

// A ray for the boxes of the order from texel `at` to before `end`: its distance to a side is
// linear in the node's number. A far side is read with the bits below it, a part of a cell more.
struct BoxRay {
    vec3 near;
    vec3 nearStep;
    vec3 far;
    vec3 farStep;
    int at;
    int end;
};

BoxRay boxRay(highp isampler2D table, int base, vec3 origin, vec3 direction) {
    ivec4 centre = meshTexel(table, base);
    ivec4 scale = meshTexel(table, base + 1);
    bvec3 negative = lessThan(direction, vec3(0.0));
    vec3 cells = mix(vec3(1.0), vec3(-1.0), negative) * intBitsToFloat(scale.xyz);
    vec3 o = (origin - intBitsToFloat(centre.xyz)) * cells;
    vec3 d = direction * cells;
    d = max(d, LEAST_SHARE * max(max(d.x, d.y), d.z));
    vec3 step = 1.0 / d;
    vec3 slack = ROUNDING * abs(o);
    int order = int(negative.x) + 2 * int(negative.y) + 4 * int(negative.z);
    int at = base + HEADER + order * centre.w;
    return BoxRay(-(o + BIAS + slack) * step, step, (slack - o) * step, step / 65536.0,
                  at, at + centre.w);
}

// The next leaf that a ray meets before a distance: its triangles, (first << COUNT_BITS) + number,
// or -1 at the order's end. Moves the ray on.
int nextLeaf(highp isampler2D table, inout BoxRay ray, float reach) {
    int leaf = -1;
    while (leaf < 0 && ray.at < ray.end) {
        ivec4 node = meshTexel(table, ray.at);
        vec3 near = vec3(node.xyz & 0xffff) * ray.nearStep + ray.near;
        vec3 far = vec3(node.xyz) * ray.farStep + ray.far;
        float enter = max(max(near.x, near.y), max(near.z, 0.0));
        float leave = min(min(far.x, far.y), min(far.z, reach));
        bool met = enter <= leave;
        ray.at += met || node.w < 0 ? 1 : node.w;
        leaf = met ? -1 - node.w : -1;
    }
    return leaf;
}

// As cornersHit, of the triangle whose corners begin at a texel.
vec3 triangleAtHit(highp isampler2D table, int at, vec3 origin, Projection p) {
    return cornersHit(projected(p, meshCorner(table, at) - origin),
                      projected(p, meshCorner(table, at + 1) - origin),
                      projected(p, meshCorner(table, at + 2) - origin));
}

// Whether a ray meets the front of the triangle, where side is 1, or its back, -1; where 0, either.
bool metFrom(highp isampler2D table, int at, vec3 direction, float side) {
    mat2x3 edges = edgesAt(table, at);
    return side == 0.0 || dot(cross(edges[0], edges[1]), direction) * side < 0.0;
}

// The nearest hit before a distance, other than of the triangle `from`; side as in metFrom.
MeshHit meshHit(highp isampler2D table, int base, vec3 origin, vec3 direction, int from,
                float side, float reach) {
    MeshHit hit = MeshHit(reach, NO_TRIANGLE, vec2(0.0));
    BoxRay ray = boxRay(table, base, origin, direction);
    Projection p = projection(direction);
    int triangles = meshTriangles(table, base);
    while (ray.at < ray.end) {
        int leaf = nextLeaf(table, ray, hit.distance);
        int triangle = leaf >> COUNT_BITS;
        int last = triangle + (leaf & COUNT_MASK);
        for (; triangle < last && leaf >= 0; ++triangle) {
            int at = triangles + CORNERS * triangle;
            vec3 met = triangleAtHit(table, at, origin, p);
            if (met.x > 0.0 && met.x < hit.distance && triangle != from &&
                metFrom(table, at, direction, side)) {
                hit = MeshHit(met.x, triangle, met.yz);
            }
        }
    }
    return hit;
}
