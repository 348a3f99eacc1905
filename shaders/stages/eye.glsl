// The direction to the viewer, unit, in the world: a parallel view has one for all points.
#include "stages/varyings.glsl"
#if ORTHOGRAPHIC
uniform vec3 u_to_eye;
#endif

vec3 towardsEye() {
#if ORTHOGRAPHIC
    return u_to_eye;
#else
    return -normalize(v_position);
#endif
}
