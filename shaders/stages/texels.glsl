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

#for TEXTURES
uniform highp sampler2D u_texture@{index};
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
    vec2 uv@{index} = v_uv@{uv};
#if @{transformed}
    uv@{index} = (u_texture@{index}_transform * vec3(uv@{index}, 1.0)).xy;
#endif
#if @{mirror_u}
    uv@{index}.x = mirrored(uv@{index}.x);
#endif
#if @{mirror_v}
    uv@{index}.y = mirrored(uv@{index}.y);
#endif
    t.texel@{index} = texture(u_texture@{index}, uv@{index});
#endfor
    return t;
}
