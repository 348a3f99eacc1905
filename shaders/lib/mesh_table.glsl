/*---
title = "The table of a mesh"
about = """
Triangles and what their vertices have, in the texels that lightbench.bvh makes of a mesh, which \
begin at the texel `base` of a texture."""
---*/

// As in bvh.py: texels before the nodes, those of a triangle, and the log2 of the texture's width.
const int HEADER = 3;
const int CORNERS = 3;
const int WIDTH_BITS = 11;

// Texels of a vertex.
const int MESH_NORMAL = 0;
const int MESH_UVS = 1;
const int MESH_TANGENT = 2;
const int MESH_COLOR = 3;

ivec4 meshTexel(highp isampler2D table, int at) {
    return texelFetch(table, ivec2(at & ((1 << WIDTH_BITS) - 1), at >> WIDTH_BITS), 0);
}

// Where the triangles begin.
int meshTriangles(highp isampler2D table, int base) {
    return base + meshTexel(table, base + 1).w;
}

vec3 meshCorner(highp isampler2D table, int at) {
    return intBitsToFloat(meshTexel(table, at).xyz);
}

// Two edges of the triangle whose corners begin at a texel.
mat2x3 edgesAt(highp isampler2D table, int at) {
    vec3 a = meshCorner(table, at);
    return mat2x3(meshCorner(table, at + 1) - a, meshCorner(table, at + 2) - a);
}

// A triangle: two of its edges, which turn counter-clockwise where its front is seen, and the texels
// where its vertices begin.
struct MeshFace {
    mat2x3 edges;
    ivec3 vertices;
};

MeshFace meshFace(highp isampler2D table, int base, int triangle) {
    int at = meshTriangles(table, base) + CORNERS * triangle;
    ivec4 a = meshTexel(table, at);
    ivec4 b = meshTexel(table, at + 1);
    ivec4 c = meshTexel(table, at + 2);
    vec3 corner = intBitsToFloat(a.xyz);
    ivec4 vertices = meshTexel(table, base + 2);
    return MeshFace(mat2x3(intBitsToFloat(b.xyz) - corner, intBitsToFloat(c.xyz) - corner),
                    base + vertices.x + vertices.y * ivec3(a.w, b.w, c.w));
}

// What the vertices of a hit have in their texel MESH_NORMAL, MESH_UVS, MESH_TANGENT or MESH_COLOR,
// between them by its weights: no normal is unit any more.
vec4 meshAttribute(highp isampler2D table, ivec3 vertices, vec2 weights, int texel) {
    vec4 a = intBitsToFloat(meshTexel(table, vertices.x + texel));
    vec4 b = intBitsToFloat(meshTexel(table, vertices.y + texel));
    vec4 c = intBitsToFloat(meshTexel(table, vertices.z + texel));
    return a + weights.x * (b - a) + weights.y * (c - a);
}
