/*---
title  = "Ambient light"
about  = """
What the ambient choice alone adds: the light that comes from elsewhere."""
---*/
#if DRAWS_OBJECTS
#include "lib/material.glsl"
#include <ambient>

vec3 inspect(Material m) {
    return ambient(m);
}
#else
#include <tonemap>
#include <transfer>

vec3 view(vec3 radiance) {
    return transfer(tonemap(radiance));
}
#endif
