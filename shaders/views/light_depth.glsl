/*---
title  = "A light's depth"
equation = 'd^2 / d_\mathrm{far}^2'
about  = """
What a light's map holds: the squared distance over the square of far, black near, white far. A point light has six faces: +x -x +y, then above -y +z -z."""
---*/
#include "lib/display.glsl"

vec3 view(vec3 radiance) {
    return displayRange(radiance);
}
