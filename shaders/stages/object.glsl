/*---
title = "An object's vertices"
about = """
World positions about the viewpoint, so that a scene far from the origin loses nothing. What the \
fragment stage does not take in is not computed."""
---*/
#if VERTEX

// Squared length of a vector that has no direction: what it is divided by in place of 0.
const float NO_LENGTH = 1e-30;

uniform mat4 u_model;
uniform mat3 u_normal_matrix;
uniform mat4 u_view_projection;
in vec3 a_position;
in vec3 a_normal;
in vec4 a_tangent;
in vec2 a_uv0;
in vec2 a_uv1;
in vec4 a_color;
out vec3 v_position;
out vec3 v_normal;
out vec4 v_tangent;
out vec2 v_uv0;
out vec2 v_uv1;
out vec4 v_color;

void main() {
    vec4 position = u_model * vec4(a_position, 1.0);
    gl_Position = u_view_projection * position;
    v_position = position.xyz;
    // Unit at the vertices, whatever the object's scale, as MikkTSpace's bakers have them.
    vec3 n = u_normal_matrix * a_normal;
    vec3 t = mat3(u_model) * a_tangent.xyz;
    v_normal = n * inversesqrt(max(dot(n, n), NO_LENGTH));
    v_tangent = vec4(t * inversesqrt(max(dot(t, t), NO_LENGTH)), a_tangent.w);
    v_uv0 = a_uv0;
    v_uv1 = a_uv1;
    v_color = a_color;
}

#endif
