/*---
title    = "Cook-Torrance (V-cavity)"
equation = '''
G = \min\left(1,\ \frac{2 (n \cdot h)(n \cdot v)}{v \cdot h},\
                  \frac{2 (n \cdot h)(n \cdot l)}{v \cdot h}\right)'''
source   = "Torrance & Sparrow 1967; Cook & Torrance 1982"
domain   = { alpha = [1e-4, 1.0] }
about    = """
Facets in pairs, as the walls of long V-shaped grooves. Cheap and the same for every roughness; it \
conserves energy with any D, and its kink shows on smooth curves."""
---*/
#include "lib/constants.glsl"

// 0 on and below the horizon. The test before the division also takes h across v, where v.h is 0.
float masking(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z <= 0.0 || v.z <= 0.0 || h.z <= 0.0) {
        return 0.0;
    }
    float open = 2.0 * h.z * min(l.z, v.z);
    float VoH = dot(v, h);
    return open < VoH ? open / VoH : 1.0;
}

// G / (4 l.z v.z) with both minima in the denominator: on the horizon of one direction it is
// h.z / (2 v.h) over the other's cosine, infinite only where v.h is 0 as well.
float visibility(vec3 l, vec3 v, vec3 h, float alpha) {
    if (l.z < 0.0 || v.z < 0.0 || h.z <= 0.0) {
        return 0.0;
    }
    float d = max(4.0 * l.z * v.z * h.z, 2.0 * dot(v, h) * max(l.z, v.z));
    return h.z / max(d, VISIBILITY_FLOOR);
}
