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
#endif
};

// Farther than anything.
const float FARTHEST = 3e38;

#if LISTED
vec3 normalOf(int object, vec3 position, Met met) {
    vec4 what = listed(object, WHAT);
#if ANY_BALL
    if (what.x == BALL) {
        return normalize(position - listed(object, AROUND).xyz);
    }
#endif
#if ANY_TRIANGLE
    if (what.x == TRIANGLE) {
        return normalize(cross(listed(object, PLACE + 1).xyz, listed(object, PLACE + 2).xyz));
    }
#endif
#if ANY_PLACED || ANY_MESH
    mat3x4 place = placeOf(object);
    vec3 own = vec4(position, 1.0) * place;
    vec3 n = vec3(0.0, 1.0, 0.0);
#if ANY_CUBE
    n = what.x == CUBE ? cubeNormal(own) : n;
#endif
#if ANY_CONE
    n = what.x == CONE ? coneNormal(own) : n;
#endif
#if ANY_ROUND
    n = what.x == ROUND ? roundNormal(own) : n;
#endif
#if ANY_MESH
    if (what.x == MESH) {
        mat2x3 edges = meshEdges(u_meshes, meshBase(int(what.z)), met.triangle);
        n = cross(edges[0], edges[1]);
    }
#endif
    return normalize((place * n).xyz);
#else
    return vec3(0.0);
#endif
}

// from: the object that the ray leaves. Its own rays meet no shape again that is convex.
Hit nearest(Ray ray, int from) {
    Hit hit;
    hit.object = NOTHING;
    hit.distance = FARTHEST;
    hit.normal = vec3(0.0);
    for (int i = 0; i < OBJECT_COUNT; ++i) {
        if (!passesBy(ray, listed(i, AROUND), hit.distance)) {
            vec4 what = listed(i, WHAT);
            if (i != from || what.x == MESH) {
#if TRANSMITS
                Met met = distanceTo(i, what, ray, 1.0, within(i) == from, hit.distance);
#else
                Met met = distanceTo(i, what, ray, 1.0, hit.distance);
#endif
                if (met.distance > 0.0 && met.distance < hit.distance) {
                    hit.object = i;
                    hit.distance = met.distance;
                    hit.met = met;
                }
            }
        }
    }
    hit.position = ray.origin + hit.distance * ray.direction;
    if (hit.object != NOTHING) {
        hit.normal = normalOf(hit.object, hit.position, hit.met);
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
