/*---
title = "The nearest object of a ray"
---*/
#include "stages/rays.glsl"

// Where a ray meets an object: the normal unit, outwards, of a triangle that of its corners' order.
// Of a mesh it is that of the triangle's plane, and light falls on another, which its vertices have.
struct Hit {
    int object;
    float distance;
    vec3 position;
    vec3 normal;
    vec3 shading;
#if LISTED
    Met met;
    // Of the object, its texel WHAT and where it is; of its mesh, the triangle.
    vec4 what;
#if ANY_PLACED || ANY_MESH || TAKES_OWN
    mat3x4 place;
#endif
#if ANY_MESH
    MeshFace face;
#endif
#endif
};

// Farther than anything.
const float FARTHEST = 3e38;

#if LISTED
vec3 normalOf(Hit hit) {
#if ANY_BALL
    if (hit.what.x == BALL) {
        return normalize(hit.position - listed(hit.object, AROUND).xyz);
    }
#endif
#if ANY_TRIANGLE
    if (hit.what.x == TRIANGLE) {
        return normalize(cross(listed(hit.object, PLACE + 1).xyz, listed(hit.object, PLACE + 2).xyz));
    }
#endif
#if ANY_PLACED || ANY_MESH
    vec3 own = vec4(hit.position, 1.0) * hit.place;
    vec3 n = vec3(0.0, 1.0, 0.0);
#if ANY_CUBE
    n = hit.what.x == CUBE ? cubeNormal(own) : n;
#endif
#if ANY_CONE
    n = hit.what.x == CONE ? coneNormal(own) : n;
#endif
#if ANY_ROUND
    n = hit.what.x == ROUND ? roundNormal(own) : n;
#endif
#if ANY_MESH
    n = hit.what.x == MESH ? cross(hit.face.edges[0], hit.face.edges[1]) : n;
#endif
    return normalize((hit.place * n).xyz);
#else
    return vec3(0.0);
#endif
}

// An object, if it is nearer than what was met. from: the object that the ray leaves. Its own rays
// meet no shape again that is convex.
void meet(int i, Ray ray, int from, inout Hit hit) {
    vec4 what = listed(i, WHAT);
    if (i != from || what.x == MESH) {
#if TRANSMITS
        Met met = distanceTo(i, what, ray, 1.0, within(i) == from, hit.distance);
#else
        Met met = distanceTo(i, what, ray, 1.0, hit.distance);
#endif
        // Of two at one distance the first in the list, whichever the tree has first.
        bool first = met.distance == hit.distance && i < hit.object;
        if (met.distance > 0.0 && (met.distance < hit.distance || first)) {
            hit.object = i;
            hit.distance = met.distance;
            hit.met = met;
        }
    }
}

Hit nearest(Ray ray, int from) {
    Hit hit;
    hit.object = NOTHING;
    hit.distance = FARTHEST;
    hit.normal = vec3(0.0);
#if OBJECT_COUNT == 1
    meet(0, ray, from, hit);
#else
    for (int at = TREE; at < TREE_END;) {
        int i = nextListed(ray, hit.distance, at);
        if (i != NOTHING) {
            meet(i, ray, from, hit);
        }
    }
#endif
    hit.position = ray.origin + hit.distance * ray.direction;
    if (hit.object != NOTHING) {
        hit.what = listed(hit.object, WHAT);
#if ANY_PLACED || ANY_MESH || TAKES_OWN
        hit.place = placeOf(hit.object);
#endif
#if ANY_MESH
        if (hit.what.x == MESH) {
            hit.face = meshFace(u_meshes, meshBase(int(hit.what.z)), hit.met.triangle);
        }
#endif
        hit.normal = normalOf(hit);
        hit.shading = hit.normal;
    }
    return hit;
}
#else
Hit nearest(Ray ray, int from) {
    Hit hit;
    hit.object = NOTHING;
    hit.distance = FARTHEST;
    hit.normal = vec3(0.0);
#for OBJECTS
    float distance@{index} = @{index} == from ? -1.0 : distanceTo@{index}(ray, 1.0);
#if @{transmits}
    if (within(@{index}) == from) {
        distance@{index} = exitOf@{index}(ray);
    }
#endif
    if (distance@{index} > 0.0 && distance@{index} < hit.distance) {
        hit.object = @{index};
        hit.distance = distance@{index};
    }
#endfor
    hit.position = ray.origin + hit.distance * ray.direction;
#for OBJECTS
    if (hit.object == @{index}) {
#if @{ball}
        hit.normal = normalize(hit.position - u_object@{index}_ball.xyz);
        hit.position = u_object@{index}_ball.xyz + u_object@{index}_ball.w * hit.normal;
#elif @{triangle}
        hit.normal = normalize(cross(u_object@{index}_e1, u_object@{index}_e2));
#else
        vec3 own = (u_object@{index}_inverse * vec4(hit.position, 1.0)).xyz;
        hit.normal = normalize(@{shape}Normal(own) * mat3(u_object@{index}_inverse));
#endif
    }
#endfor
    hit.shading = hit.normal;
    return hit;
}
#endif
