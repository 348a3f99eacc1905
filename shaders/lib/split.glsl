/*---
title = "A surface without its base"
---*/
#include "lib/material.glsl"

// The material with a black base: what it answers then is mirrored.
Material withoutBase(Material m) {
#for MATERIAL_FIELDS
#if @{base}
    m.@{name} = vec3(0.0);
#endif
#endfor
    return m;
}
