/*---
title  = "Shadow factor"
equation = 'V'
about  = """
The share of the lights that reaches the surface, white to black: the mean over those that it faces."""
---*/
#if DRAWS_OBJECTS
vec3 seen(float visibility) {
    return vec3(visibility);
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(radiance);
}
#endif
