/*---
title  = "Material at a fragment"
source = "glTF 2.0, 3.9.2: what a map holds is multiplied with its factor"
about  = """
The fields that the chosen files read. One that no map varies is a uniform; one that follows from a \
map is derived here as the renderers derive the others."""
---*/
#include "lib/constants.glsl"
#include "lib/material.glsl"
#include "stages/texels.glsl"
#if VARIES_ETA || VARIES_K
#include "lib/conductor.glsl"
#endif

#for UNIFORM_FIELDS
uniform @{type} u_@{name};
#endfor
uniform vec3 u_dielectric_f0;

#if VARYING
// Exponents of the lobe that belongs to a roughness, as for a material without maps.
const float ALPHA_SHININESS_MIN = 1e-3;
const float SHININESS_MAX = 1e6;
#endif

Material readMaterial(Texels t) {
    Material m;
#for CONSTANT_FIELDS
    m.@{name} = u_@{name};
#endfor
#if VARYING
    vec3 tint = vec3(1.0);
#for BASE_COLOR_MAPS
    tint *= t.@{texel}.rgb;
#endfor
#if VERTEX_COLORS
    tint *= v_color.rgb;
#endif
    vec3 baseColor = u_base_color * tint;
    float metalFactor = u_metalness;
#for METALNESS_MAPS
    metalFactor *= t.@{texel}.@{channel};
#endfor
    float roughFactor = u_roughness;
#for ROUGHNESS_MAPS
    roughFactor *= t.@{texel}.@{channel};
#endfor
    vec3 facetF0 = mix(u_dielectric_f0, baseColor, metalFactor);
    float width = max(roughFactor * roughFactor, ALPHA_SHININESS_MIN);
    float exponent = min(2.0 / (width * width) - 2.0, SHININESS_MAX);
#if VARIES_BASE_COLOR
    m.base_color = baseColor;
#endif
#if VARIES_METALNESS
    m.metalness = metalFactor;
#endif
#if VARIES_ROUGHNESS
    m.roughness = roughFactor;
#endif
#if VARIES_F0
    m.f0 = facetF0;
#endif
#if VARIES_ETA
    m.eta = etaOf(facetF0, metalFactor);
#endif
#if VARIES_K
    m.k = kOf(facetF0, metalFactor);
#endif
#if VARIES_KD && MODULATED
    m.kd = u_kd;
#elif VARIES_KD && GIVEN_KD
    m.kd = u_kd * tint;
#elif VARIES_KD
    m.kd = INV_PI * (1.0 - metalFactor) * baseColor;
#endif
#if VARIES_SHININESS
    m.shininess = exponent;
#endif
#if VARIES_KS && VARIES_SHININESS
    m.ks = INV_PI / 8.0 * (exponent + 2.0) * facetF0;
#elif VARIES_KS
    m.ks = INV_PI / 8.0 * (u_shininess + 2.0) * facetF0;
#endif
#endif
    return m;
}
