// The direction to the viewer, unit, in the world: a parallel view has one for all points.
#include "stages/varyings.glsl"
#if ORTHOGRAPHIC && !TRACED
uniform vec3 u_to_eye;
#endif

vec3 towardsEye() {
#if TRACED
    return v_to_eye;
#elif ORTHOGRAPHIC
    return u_to_eye;
#else
    return -normalize(v_position);
#endif
}
