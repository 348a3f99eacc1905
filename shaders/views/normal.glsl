/*---
title  = "Normals"
equation = '\frac{1}{2} + \frac{1}{2} n'
about  = """
The shading normal in the world, x y z as red green blue, -1 to 1 as 0 to 1."""
signed = true
---*/
#if DRAWS_OBJECTS
vec3 inspectNormal(vec3 n) {
    return n;
}
#else
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(0.5 + 0.5 * radiance);
}
#endif
