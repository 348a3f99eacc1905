/*---
title = "Objects of a list in the way of a ray"
about = """
Objects by their number, from a texture: for scenes of many, or with models. A tree of spheres \
around them tells where to look closer."""
---*/
#include "stages/leaving.glsl"
#include "stages/list.glsl"
#if ANY_BALL
#include "lib/sphere.glsl"
#endif
#if ANY_TRIANGLE || (ANY_MESH && TAKES_STEPS)
#include "lib/triangle.glsl"
#endif
#if ANY_PLACED || TAKES_OWN
#include "lib/shapes.glsl"
#endif
#if ANY_MESH
#include "lib/bvh.glsl"

uniform highp isampler2D u_meshes;
#endif
// What is where along a ray: the distance, or -1; of a mesh, the triangle and the weights there.
struct Met {
    float distance;
#if ANY_MESH
    int triangle;
    vec2 weights;
#endif
};

#if OBJECT_COUNT > 1
// Whether a ray may meet a sphere before a distance.
bool passesBy(Ray ray, vec4 around, float reach) {
    vec3 f = ray.origin - around.xyz;
    float along = -dot(f, ray.direction);
    vec3 nearest = f + along * ray.direction;
    return dot(nearest, nearest) > around.w * around.w || along < -around.w || along - around.w > reach;
}

// Where the nodes of the tree of spheres begin and end, and the bits of a node's number, as in
// sphere_tree.py.
const int TREE = OBJECT_COUNT * RECORD;
const int TREE_END = TREE + 2 * OBJECT_COUNT - 1;
const int NUMBER = (1 << 17) - 1;

// The next object whose sphere a ray may meet before a distance, or NOTHING. Moves on in the tree.
int nextListed(Ray ray, float reach, inout int at) {
    int object = NOTHING;
    while (object == NOTHING && at < TREE_END) {
        vec4 node = listTexel(at);
        bool passed = passesBy(ray, vec4(node.xyz, abs(node.w)), reach);
        int number = floatBitsToInt(node.w) & NUMBER;
        at += passed && node.w > 0.0 ? number : 1;
        object = !passed && node.w < 0.0 ? number : NOTHING;
    }
    return object;
}
#endif

#if ANY_MESH
// Where a mesh begins in the texture of all.
int meshBase(int number) {
    return meshTexel(u_meshes, number).x;
}
#endif

// side as for the shapes: 1 for what is seen from the ray's origin, -1 from its other end. A ray inside
// meets the object from within alone.
Met distanceTo(int object, vec4 what, Ray ray, float side,
#if TRANSMITS
               bool inside,
#endif
               float reach) {
    Met met;
    met.distance = -1.0;
    bool both = what.w < 0.0;
#if ANY_BALL
    if (what.x == BALL) {
        vec4 around = listed(object, AROUND);
        met.distance = sphereHit(ray.origin, ray.direction, around.xyz, what.z);
#if TRANSMITS
        if (inside) {
            met.distance = sphereExit(ray.origin, ray.direction, around.xyz, what.z);
        }
#endif
    }
#endif
#if ANY_TRIANGLE
    if (what.x == TRIANGLE) {
        met.distance = triangleHit(ray.origin, ray.direction, listed(object, PLACE).xyz,
                                   listed(object, PLACE + 1).xyz, listed(object, PLACE + 2).xyz);
#if TRANSMITS
        met.distance = inside ? -1.0 : met.distance;
#endif
    }
#endif
#if ANY_PLACED || ANY_MESH
    if (what.x > TRIANGLE) {
        mat3x4 place = placeOf(object);
        vec3 origin = vec4(ray.origin, 1.0) * place;
        vec3 direction = vec4(ray.direction, 0.0) * place;
#if ANY_PLANE
        if (what.x == PLANE) {
            float seen = !both ? side : direction.y < 0.0 ? 1.0 : -1.0;
            met.distance = planeHit(origin, direction, seen);
        }
#endif
#if ANY_CUBE
        met.distance = what.x == CUBE ? cubeHit(origin, direction) : met.distance;
#endif
#if ANY_CONE
        met.distance = what.x == CONE ? coneHit(origin, direction) : met.distance;
#endif
#if ANY_ROUND
        met.distance = what.x == ROUND ? roundHit(origin, direction) : met.distance;
#endif
#if TRANSMITS
        // From within where it lets light through: a camera may stand there, too.
        if (inside || (met.distance < 0.0 && abs(what.w) < 2.0)) {
            met.distance = -1.0;
#if ANY_CUBE
            met.distance = what.x == CUBE ? cubeExit(origin, direction) : met.distance;
#endif
#if ANY_CONE
            met.distance = what.x == CONE ? coneExit(origin, direction) : met.distance;
#endif
#if ANY_ROUND
            met.distance = what.x == ROUND ? roundExit(origin, direction) : met.distance;
#endif
        }
#endif
#if ANY_MESH
        if (what.x == MESH) {
            float seen = both ? 0.0 : side;
#if TRANSMITS
            seen = inside ? -1.0 : seen;
#endif
            MeshHit hit = meshHit(u_meshes, meshBase(int(what.z)), origin, direction,
                                  NO_TRIANGLE, seen, reach);
            met.distance = hit.triangle == NO_TRIANGLE ? -1.0 : hit.distance;
            met.triangle = hit.triangle;
            met.weights = hit.weights;
        }
#endif
    }
#endif
    return met;
}
