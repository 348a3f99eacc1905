/*---
title = "Coordinates and tangent of a shape"
about = "Objects one by one, each by the functions of its shape."
---*/
#include "stages/nearest.glsl"
#include "stages/varyings.glsl"

// right, up: from the point that the ray met to those of its neighbours.
void metOwn(Hit hit, vec3 right, vec3 up) {
#for OBJECTS
    if (hit.object == @{index}) {
#if @{triangle}
        vec3 e1 = u_object@{index}_e1;
        vec3 e2 = u_object@{index}_e2;
        vec2 own = alongEdges(hit.position - u_object@{index}_v0, e1, e2);
#if TAKES_TANGENT
        v_tangent = vec4(normalize(e1), 1.0);
#endif
#if TAKES_UV0
        v_uv0 = vec2(own.x, 1.0 - own.y);
#endif
#if TAKES_UV0 && TAKES_STEPS
        v_uv0_steps = vec4(alongEdges(right, e1, e2), alongEdges(up, e1, e2));
        v_uv0_steps *= vec4(1.0, -1.0, 1.0, -1.0);
#endif
#else
        mat3 inward = mat3(u_object@{index}_inverse);
        vec3 own = (u_object@{index}_inverse * vec4(hit.position, 1.0)).xyz;
#if TAKES_TANGENT
        v_tangent = vec4(normalize(inverse(inward) * @{shape}Tangent(own)), 1.0);
#endif
#if TAKES_UV0
        v_uv0 = @{shape}Uv(own);
#endif
#if TAKES_UV0 && TAKES_STEPS
        v_uv0_steps = vec4(@{shape}Uv(own + inward * right) - v_uv0, @{shape}Uv(own + inward * up) - v_uv0);
        // Around a seam, to the nearer side.
        v_uv0_steps -= round(v_uv0_steps);
#endif
#endif
    }
#endfor
}
