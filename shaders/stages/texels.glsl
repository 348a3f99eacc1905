/*---
title  = "Texels of a surface"
source = "glTF 2.0, KHR_texture_transform"
about  = "Each texture that the material's maps share is read once."

[parameters.anisotropy]
kind    = "int"
default = 4
range   = [1, 16]
step    = 1
label   = "Anisotropic samples at most"
---*/
#include "stages/varyings.glsl"
#if TEXTURE_COUNT
#include <mapping>
#if TRACED
#include "stages/images.glsl"
#endif
#endif

#for TEXTURES
#if TRACED
uniform float u_texture@{index};
#else
uniform highp sampler2D u_texture@{index};
#endif
#if @{transformed}
uniform mat3 u_texture@{index}_transform;
#endif
#endfor

struct Texels {
#for TEXTURES
    vec4 texel@{index};
#endfor
#if TEXTURE_COUNT == 0
    // GLSL has no empty struct.
    float unused;
#endif
};

#if MIRRORED
// A coordinate folded into [0, 1]: there and back over every two.
float mirrored(float x) {
    return 1.0 - abs(mod(x, 2.0) - 1.0);
}
#endif

Texels readTexels() {
    Texels t;
#if TEXTURE_COUNT == 0
    t.unused = 0.0;
#endif
#for TEXTURES
#if MAPPING
    vec2 uv@{index} = mapping(v_normal);
#else
    vec2 uv@{index} = v_uv@{uv};
#endif
#if TRACED && MAPPING
    vec4 steps@{index} = vec4(0.0);
#elif TRACED
    vec4 steps@{index} = v_uv@{uv}_steps;
#endif
#if @{transformed}
    uv@{index} = (u_texture@{index}_transform * vec3(uv@{index}, 1.0)).xy;
#if TRACED && !MAPPING
    steps@{index}.xy = mat2(u_texture@{index}_transform) * steps@{index}.xy;
    steps@{index}.zw = mat2(u_texture@{index}_transform) * steps@{index}.zw;
#endif
#endif
#if @{mirror_u}
    uv@{index}.x = mirrored(uv@{index}.x);
#endif
#if @{mirror_v}
    uv@{index}.y = mirrored(uv@{index}.y);
#endif
#if TRACED
    t.texel@{index} = imageAt(u_texture@{index}, uv@{index}, steps@{index});
#else
    t.texel@{index} = texture(u_texture@{index}, uv@{index});
#endif
#endfor
    return t;
}
