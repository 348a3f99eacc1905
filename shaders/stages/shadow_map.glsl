/*---
title  = "Reading a light's map"
source = "Williams 1978, Casting Curved Shadows on Curved Surfaces"
about  = """
A map holds the squared distance from its light to the nearest surface, over the square of far. A \
point beyond far, or beside the map, is lit."""
reads  = ["shadow_map"]
---*/
#include "lib/cube.glsl"
#include "lib/receiver.glsl"
#include "stages/light_uniforms.glsl"
#include <bias>

#for CASTERS
uniform float u_light@{index}_far;
#if !REACHLESS || PENUMBRA
uniform float u_light@{index}_texel;
#endif
#if !@{cube}
uniform mat4 u_light@{index}_map;
#endif
#endfor

// A point as a light's map has it: (u, v, face); its distance from the light, the map's far and the
// size of a texel there, in metres.
struct MapPoint {
    vec3 at;
    float distance;
    float far;
    float texel;
};

// A receiver lies within half a texel's diagonal of the middle of the texel that it falls in.
const float HALF_DIAGONAL = 0.70710678;
// Least cosine that a mesh's gap is divided by: beyond it the light grazes, and adds next to nothing.
const float GAP_COS_MIN = 0.1;
// A point in the plane of a spot light is in no map: held away from the division by zero.
const float MIN_DEPTH = 1e-20;

MapPoint mapPoint(int light, vec3 position) {
    MapPoint p;
#for CASTERS
    if (light == @{index}) {
        p.far = u_light@{index}_far;
#if @{cube}
        vec3 offset = position - u_light@{index}_position;
        p.at = cubeFace(offset);
        p.distance = length(offset);
#if !REACHLESS || PENUMBRA
        p.texel = u_light@{index}_texel * max(max(abs(offset.x), abs(offset.y)), abs(offset.z));
#endif
#elif @{directional}
        vec4 clip = u_light@{index}_map * vec4(position, 1.0);
        p.at = vec3(0.5 + 0.5 * clip.xy, 0.0);
        p.distance = (0.5 + 0.5 * clip.z) * p.far;
#if !REACHLESS || PENUMBRA
        p.texel = u_light@{index}_texel;
#endif
#else
        vec4 clip = u_light@{index}_map * vec4(position, 1.0);
        p.at = vec3(0.5 + 0.5 * clip.xy / max(clip.w, MIN_DEPTH), 0.0);
        p.distance = length(position - u_light@{index}_position);
#if !REACHLESS || PENUMBRA
        p.texel = u_light@{index}_texel * clip.w;
#endif
#endif
    }
#endfor
    return p;
}

// What the map holds at a texel counted from the lower left of the point's face.
float stored(int light, vec3 at, ivec2 texel) {
    bool inside = all(greaterThanEqual(texel, ivec2(0)))
        && all(lessThan(texel, ivec2(SHADOW_RESOLUTION)));
#for CASTERS
    if (light == @{index}) {
#if @{cube}
        if (!inside) {
            at = cubeFace(cubeDirection(vec3((vec2(texel) + 0.5) / float(SHADOW_RESOLUTION), at.z)));
            texel = ivec2(at.xy * float(SHADOW_RESOLUTION));
            texel = clamp(texel, ivec2(0), ivec2(SHADOW_RESOLUTION - 1));
        }
        int face = int(at.z);
        ivec2 tile = SHADOW_RESOLUTION * ivec2(face % 3, face / 3);
        return texelFetch(u_shadow_map@{index}, tile + texel, 0).r;
#else
        return inside ? texelFetch(u_shadow_map@{index}, texel, 0).r : 1.0;
#endif
    }
#endfor
    return 1.0;
}

// A receiver in a light's map, moved off its surface where the bias does so.
MapPoint receivedAt(int light, Receiver r) {
    MapPoint p = mapPoint(light, r.position);
#if SHIFT
    p = mapPoint(light, r.position + shift(HALF_DIAGONAL * p.texel, r.NoL) * r.normal);
#endif
    // The map may hold a finer mesh of the same surface, which bulges out of this one.
    p.distance -= r.gap / max(r.NoL, GAP_COS_MIN);
    return p;
}

// The receiver's squared share of far, biased for a comparison so many texels to the side.
float comparedAt(MapPoint p, Receiver r, float texels) {
#if REACHLESS
    float reach = 0.0;
#elif SHIFT
    float reach = texels * p.texel;
#else
    float reach = (texels + HALF_DIAGONAL) * p.texel;
#endif
    return compared(p.distance, p.far, reach, r.NoL);
}
