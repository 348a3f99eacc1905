/*---
title = "A hit, shaded"
about = """
What differs between surfaces are functions, one for each kind; what differs between objects of one \
kind are variables, set before the call."""
---*/
#include "stages/met.glsl"

#if !LISTED
#for OBJECTS
#for SURFACE@{kind}_VALUES
uniform @{type} u_object@{index}_@{name};
#endfor
#endfor
#endif
#for OBJECT_VALUES
uniform @{type} u_@{name};
#endfor

// Radiance towards the ray's origin, and opacity.
vec4 shaded(Hit hit) {
#if LISTED
    int kind = int(hit.what.y) / 2;
#for OBJECT_VALUES
#if @{matrix}
    u_@{name} = mat3(listed(hit.object, @{texel}).xyz, listed(hit.object, @{texel} + 1).xyz,
                     listed(hit.object, @{texel} + 2).xyz);
#else
    u_@{name} = listed(hit.object, @{texel}).@{parts};
#endif
#endfor
#else
    int kind = 0;
#for OBJECTS
    if (hit.object == @{index}) {
        kind = @{kind};
#for SURFACE@{kind}_VALUES
        u_@{name} = u_object@{index}_@{name};
#endfor
    }
#endfor
#endif
#if SURFACE_COUNT == 1
    return surfaceLight_0();
#else
#for SURFACES
    if (kind == @{index}) {
        return surfaceLight_@{index}();
    }
#endfor
    return vec4(0.0);
#endif
}
