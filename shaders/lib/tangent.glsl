/*---
title  = "Normal maps"
source = "MikkTSpace; glTF 2.0, 3.9.3"
---*/

// Steps of a code of an 8-bit map that a filter can tell apart.
const float STEPS = 256.0;

// A texel of a normal map: its vector, x and y scaled. 128/255 counts as 0, so that a flat map
// leaves a normal as it is: exactly so, for the code is rounded to a step of 1/256 first, which
// takes away what a driver's 128/255 is off by. rgb [0, 1] -> tangent space, not unit.
vec3 unpackNormal(vec3 rgb, float scale) {
    vec3 s = (round(rgb * (255.0 * STEPS)) / STEPS - 128.0) / 127.0;
    return vec3(scale * s.xy, s.z);
}

// The normal of a map, in the space of the frame: x along the tangent, y along the bitangent, which
// is w cross(n, t), z along the normal. Interpolated n and t are used as they are, neither unit nor
// orthogonal, as MikkTSpace's bakers do. -> not unit.
vec3 mappedNormal(vec3 n, vec4 tangent, vec3 rgb, float scale) {
    vec3 s = unpackNormal(rgb, scale);
    vec3 b = tangent.w * cross(n, tangent.xyz);
    return s.x * tangent.xyz + s.y * b + s.z * n;
}
