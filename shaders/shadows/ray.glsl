/*---
title    = "Exact, by rays"
equation = 'V = [\, \text{nothing between the point and the light}\, ]'
source   = "Appel 1968, Some Techniques for Shading Machine Renderings of Solids"
unit     = "1"
about    = """
A ray to each light, and no further: sharp at any distance, without a map or a bias. What lets light \
through lets it through straight; the holes of a mask count as solid."""
---*/
#include "lib/receiver.glsl"
#include "stages/rays.glsl"

#if !LISTED
#for OBJECTS
#if @{transmits}
uniform float u_object@{index}_transmittance;
#endif
#endfor
#endif

#if LISTED
// The share of light that an object lets through.
float passed(int i, Ray ray, Receiver r) {
    vec4 what = listed(i, WHAT);
    float stopped = abs(what.w) - 1.0;
    if (stopped > 0.0 && (i != r.object || what.x == MESH)) {
#if TRANSMITS
        float distance = distanceTo(i, what, ray, -1.0, false, r.distance).distance;
#else
        float distance = distanceTo(i, what, ray, -1.0, r.distance).distance;
#endif
        if (distance > 0.0 && distance < r.distance) {
            return 1.0 - stopped;
        }
    }
    return 1.0;
}
#endif

float shadow(int light, Receiver r) {
    Ray ray = leaving(r.position, r.normal, r.toLight);
    float share = 1.0;
#if LISTED && OBJECT_COUNT == 1
    if (r.NoL > 0.0) {
        share = passed(0, ray, r);
    }
#elif LISTED
    share = r.NoL > 0.0 ? 1.0 : 0.0;
    for (int at = TREE; at < TREE_END && share > 0.0;) {
        int i = nextListed(ray, r.distance, at);
        if (i != NOTHING) {
            share *= passed(i, ray, r);
        }
    }
#else
#for OBJECTS
#if @{solid}
    {
        float distance = r.object == @{index} ? -1.0 : distanceTo@{index}(ray, -1.0);
        if (distance > 0.0 && distance < r.distance) {
#if @{transmits}
            share *= u_object@{index}_transmittance;
#else
            return 0.0;
#endif
        }
    }
#endif
#endfor
#endif
    return share;
}

bool exact() {
    return true;
}
