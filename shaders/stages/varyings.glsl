// What an object's vertices hand on, or what a ray found where it met one. A shader keeps those that
// it names.
#if TRACED
vec3 v_position;
vec3 v_normal;
vec4 v_tangent;
vec2 v_uv0;
vec2 v_uv1;
vec4 v_color;
// Towards where the ray came from, unit; whether it met the front.
vec3 v_to_eye;
bool v_front;
// How far the coordinates go to the next pixel, to the right and up.
vec4 v_uv0_steps;
vec4 v_uv1_steps;
#else
in vec3 v_position;
in vec3 v_normal;
in vec4 v_tangent;
in vec2 v_uv0;
in vec2 v_uv1;
in vec4 v_color;
#endif
