/*---
title = "Normal, coordinates and tangent of an object of a list"
about = "By the functions of its shape, or between the vertices of its mesh."
---*/
#include "stages/nearest.glsl"
#include "stages/varyings.glsl"

#if TAKES_UV0
vec2 uvOn(float shape, vec3 own) {
    vec2 uv = vec2(0.0);
#if ANY_BALL || ANY_ROUND
    uv = shape == BALL || shape == ROUND ? roundUv(own) : uv;
#endif
#if ANY_PLANE
    uv = shape == PLANE ? planeUv(own) : uv;
#endif
#if ANY_CUBE
    uv = shape == CUBE ? cubeUv(own) : uv;
#endif
#if ANY_CONE
    uv = shape == CONE ? coneUv(own) : uv;
#endif
    return uv;
}
#endif

#if TAKES_TANGENT
vec3 tangentOn(float shape, vec3 own) {
    vec3 tangent = vec3(1.0, 0.0, 0.0);
#if ANY_BALL || ANY_ROUND
    tangent = shape == BALL || shape == ROUND ? roundTangent(own) : tangent;
#endif
#if ANY_CUBE
    tangent = shape == CUBE ? cubeTangent(own) : tangent;
#endif
#if ANY_CONE
    tangent = shape == CONE ? coneTangent(own) : tangent;
#endif
    return tangent;
}
#endif

#if ANY_MESH
// What vertices have in one of their texels, between them.
vec4 between(ivec3 vertices, vec2 weights, int texel) {
    return meshAttribute(u_meshes, vertices, weights, texel);
}

void metMesh(inout Hit hit, vec3 right, vec3 up) {
    ivec3 vertices = hit.face.vertices;
    vec2 weights = hit.met.weights;
    vec3 n = (hit.place * between(vertices, weights, MESH_NORMAL).xyz).xyz;
    hit.shading = dot(n, n) > 0.0 ? normalize(n) : hit.normal;
#if TAKES_TANGENT
    vec4 tangent = between(vertices, weights, MESH_TANGENT);
    vec3 outward = inverse(transpose(mat3(hit.place))) * tangent.xyz;
    v_tangent = vec4(dot(outward, outward) > 0.0 ? normalize(outward) : outward, tangent.w);
#endif
#if TAKES_COLOR
    v_color = between(vertices, weights, MESH_COLOR);
#endif
#if TAKES_UV0 || TAKES_UV1
    vec4 uvs = between(vertices, weights, MESH_UVS);
#endif
#if TAKES_UV0
    v_uv0 = uvs.xy;
#endif
#if TAKES_UV1
    v_uv1 = uvs.zw;
#endif
#if TAKES_STEPS
    mat2x3 edges = hit.face.edges;
    vec3 inRight = vec4(right, 0.0) * hit.place;
    vec3 inUp = vec4(up, 0.0) * hit.place;
    vec4 first = between(vertices, vec2(0.0), MESH_UVS);
    vec4 toRight = between(vertices, alongEdges(inRight, edges[0], edges[1]), MESH_UVS) - first;
    vec4 toUp = between(vertices, alongEdges(inUp, edges[0], edges[1]), MESH_UVS) - first;
#if TAKES_UV0
    v_uv0_steps = vec4(toRight.xy, toUp.xy);
#endif
#if TAKES_UV1
    v_uv1_steps = vec4(toRight.zw, toUp.zw);
#endif
#endif
}
#endif

// right, up: from the point that the ray met to those of its neighbours.
void metOwn(inout Hit hit, vec3 right, vec3 up) {
#if ANY_MESH
    if (hit.what.x == MESH) {
        metMesh(hit, right, up);
        return;
    }
#endif
#if TAKES_OWN && ANY_TRIANGLE
    if (hit.what.x == TRIANGLE) {
        vec3 e1 = listed(hit.object, PLACE + 1).xyz;
        vec3 e2 = listed(hit.object, PLACE + 2).xyz;
#if TAKES_TANGENT
        v_tangent = vec4(normalize(e1), 1.0);
#endif
#if TAKES_UV0
        vec2 along = alongEdges(hit.position - listed(hit.object, PLACE).xyz, e1, e2);
        v_uv0 = vec2(along.x, 1.0 - along.y);
#endif
#if TAKES_UV0 && TAKES_STEPS
        v_uv0_steps = vec4(alongEdges(right, e1, e2), alongEdges(up, e1, e2));
        v_uv0_steps *= vec4(1.0, -1.0, 1.0, -1.0);
#endif
        return;
    }
#endif
#if TAKES_OWN
    vec3 own = vec4(hit.position, 1.0) * hit.place;
#if TAKES_TANGENT
    v_tangent = vec4(normalize(inverse(transpose(mat3(hit.place))) * tangentOn(hit.what.x, own)), 1.0);
#endif
#if TAKES_UV0
    v_uv0 = uvOn(hit.what.x, own);
#endif
#if TAKES_UV0 && TAKES_STEPS
    v_uv0_steps = vec4(uvOn(hit.what.x, own + vec4(right, 0.0) * hit.place) - v_uv0,
                       uvOn(hit.what.x, own + vec4(up, 0.0) * hit.place) - v_uv0);
    // Around a seam, to the nearer side.
    v_uv0_steps -= round(v_uv0_steps);
#endif
#endif
}
