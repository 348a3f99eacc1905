/*---
title  = "Objects in the way of a ray"
about  = """
Every object by its own equation, one after the other, its values as uniforms: what moves compiles \
nothing. All shapes are convex, so a ray that leaves one outwards never meets it again: it is told \
to pass over that object, and needs no distance to keep."""
---*/
#if LISTED
#include "stages/listed.glsl"
#else
#include "stages/leaving.glsl"
#if ANY_BALL
#include "lib/sphere.glsl"
#endif
#if ANY_TRIANGLE
#include "lib/triangle.glsl"
#endif
#if ANY_PLACED || TAKES_OWN
#include "lib/shapes.glsl"
#endif

#for OBJECTS
#if @{ball}
uniform vec4 u_object@{index}_ball;
#elif @{triangle}
uniform vec3 u_object@{index}_v0;
uniform vec3 u_object@{index}_e1;
uniform vec3 u_object@{index}_e2;
#endif
#if @{placed} || (@{ball} && TAKES_OWN)
uniform mat4 u_object@{index}_inverse;
#endif
#endfor

#for OBJECTS
// Distance to this object, or -1. Seen from the ray's origin, side is 1: a surface is there from
// its front only. Along a ray to a light it is -1, for the light would see it from the other end.
float distanceTo@{index}(Ray ray, float side) {
#if @{ball}
    return sphereHit(ray.origin, ray.direction, u_object@{index}_ball.xyz, u_object@{index}_ball.w);
#elif @{triangle}
    return triangleHit(ray.origin, ray.direction,
                       u_object@{index}_v0, u_object@{index}_e1, u_object@{index}_e2);
#else
    vec3 origin = (u_object@{index}_inverse * vec4(ray.origin, 1.0)).xyz;
    vec3 direction = mat3(u_object@{index}_inverse) * ray.direction;
#if @{plane} && @{open}
    return planeHit(origin, direction, direction.y < 0.0 ? 1.0 : -1.0);
#elif @{plane}
    return planeHit(origin, direction, side);
#elif @{transmits}
    float entered = @{shape}Hit(origin, direction);
    return entered > 0.0 ? entered : @{shape}Exit(origin, direction);
#else
    return @{shape}Hit(origin, direction);
#endif
#endif
}
#if @{transmits}
// From within, or -1.
float exitOf@{index}(Ray ray) {
#if @{ball}
    return sphereExit(ray.origin, ray.direction, u_object@{index}_ball.xyz, u_object@{index}_ball.w);
#elif @{triangle} || @{plane}
    return -1.0;
#else
    vec3 origin = (u_object@{index}_inverse * vec4(ray.origin, 1.0)).xyz;
    return @{shape}Exit(origin, mat3(u_object@{index}_inverse) * ray.direction);
#endif
}
#endif
#endfor
#endif
