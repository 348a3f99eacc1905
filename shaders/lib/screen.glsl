// Vertex stage of every pass that draws the screen: one triangle that covers it, from the vertex's
// number alone, so that no buffer is bound.
#if VERTEX
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(corner * 4.0 - 1.0, 0.0, 1.0);
}
#endif
