/*---
title = "What a surface sends to the eye"
about = """
Of one kind of surface, at the point that the varyings describe: a pass draws it, or a ray meets it."""
---*/
#include "stages/opacity.glsl"
#if INSPECT_NORMAL
#include "stages/eye.glsl"
#include "stages/normal.glsl"
#include <view>
#elif INSPECT
#include "stages/material.glsl"
#include <view>
#elif UNLIT
#if !(REFLECTED || TERM || SEEN)
#include "stages/emission.glsl"
#endif
#else
#include "stages/material.glsl"
#if LIGHT_COUNT
#include "stages/eye.glsl"
#include "stages/normal.glsl"
#endif
#if REFLECTED || TERM || SEEN
#include <view>
#else
#include <ambient>
#include "stages/occlusion.glsl"
#if EMITS
#include "stages/emission.glsl"
#endif
#endif
#if LIGHT_COUNT
#include "stages/lights.glsl"
#endif
#endif

uniform float u_gap;
uniform float u_object;

vec3 radianceAt(Texels t) {
#if INSPECT_NORMAL
    return inspectNormal(readNormal(t, towardsEye()));
#elif INSPECT
    return inspect(readMaterial(t));
#elif UNLIT && (REFLECTED || TERM || SEEN)
    // It answers no light.
    return vec3(0.0);
#elif UNLIT
    return readEmission(t);
#else
    Material m = readMaterial(t);
    vec3 radiance = vec3(0.0);
#if !(REFLECTED || TERM || SEEN)
    radiance = ambient(m) * readOcclusion(t);
#if EMITS
    radiance += readEmission(t);
#endif
#endif
#if LIGHT_COUNT
    vec3 toEye = towardsEye();
    Receiver r;
    r.position = v_position;
    r.normal = readNormal(t, toEye);
#if CASTER_COUNT && !UNSHADOWED
#if EXACT
    r.object = int(u_object);
#else
    r.gap = u_gap;
#endif
#endif
    radiance += fromLights(m, r, toEye);
#endif
#if MODULATED && BASE_COLOR_MAP_COUNT && !(REFLECTED || TERM || SEEN)
    vec3 tint = vec3(1.0);
#for BASE_COLOR_MAPS
    tint *= t.@{texel}.rgb;
#endfor
    radiance = modulated(radiance, tint);
#endif
    return radiance;
#endif
}

// Radiance, and opacity.
vec4 surfaceLight() {
    Texels t = readTexels();
    float opacity = readOpacity(t);
    return vec4(radianceAt(t), opacity);
}
