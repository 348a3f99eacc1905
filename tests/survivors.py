"""Broken shaders that no test can tell from whole ones, and why: see test_mutations.py."""
# ruff: noqa: E501  (a place is a line of code as it then reads)

SQUARED = "only its square is used"
TIE = "differs where both sides are equal, and there both branches give the same"
TOLERANCE = "a bound far below the rounding of what it bounds: twice that is as good"
UNREAD = "nobody reads this target's alpha"
COVERED = "the triangle still covers the whole screen"
NO_DEPTH = "a screen pass has no depth buffer, and any depth from near to far is drawn"
DIES_OUT = "beyond 5 Lambda is below 1e-12, whether computed or not"
NAN_DROPPED = "0 times infinity there, and this driver's max() takes the 0 for it, as GLSL allows"
NAN_IS_DARK = "NaN there, and a comparison with it is false: the same branch is taken"
SYMMETRIC = "the function is symmetric in these two"
BY_NOTHING = "this driver divides a whole number by 0 to 0"
TURNED = "any two directions at right angles to the ray do, either way round and of any length"
DIVIDED = "all weights are divided by their sum, and may all be below 0"
NO_HIT = "no hit is -1 and a hit above 0: nothing lies between"
BY_SIGN = "it is 1 or -1: dividing by it is multiplying by it"
NEVER_LEVEL = (
    "a level ray comes to the plane infinitely far away, or is NaN there: on no side of a bound"
)
OUTSIDE = "a point on the surface is outside it by a rounding at most"
UNIT_LATER = "made unit afterwards"
BOTH_WAYS = "probes lie alike to both sides"
IN_VAIN = "what is looked at in vain changes nothing"
SIZED = "its size is 1 at least"
ZERO_ANYWAY = "a 0 over something positive is 0"

# File: {the place as it then reads: why nothing changes}.
EXPECTED_SURVIVORS: dict[str, dict[str, str]] = {
    "attenuations/inverse_square.glsl": {
        "attenuation: float d = -1.0 * (max(distance, max(light.light_radius, LIGHT_RADIUS_MIN)));": SQUARED,
    },
    "distributions/beckmann.glsl": {
        "const float BECKMANN_COS4_MIN = 2e-08;": "D is 0 on both sides of the bound",
        "distribution: if (h.z < 0.0 || c2 * c2 < BECKMANN_COS4_MIN) {": "0 is below the other bound",
        "distribution: if (h.z <= 0.0 || c2 < BECKMANN_COS4_MIN) {": "D is 0 on both sides of the bound",
        "distribution: if (h.z <= 0.0 || c2 * c2 <= BECKMANN_COS4_MIN) {": "D is 0 on both sides of the bound",
    },
    "distributions/blinn_phong.glsl": {
        "distribution: float a = -1.0 * (max(alpha, ALPHA_MIN));": "it enters as a^2 and (1 - a)(1 + a)",
    },
    "distributions/ggx.glsl": {
        "distribution: float d = -1.0 * (dot(h.xy, h.xy) + a2 * h.z * h.z);": SQUARED,
    },
    "distributions/ggx_textbook.glsl": {
        "distribution: float d = -1.0 * ((h.z * a2 - h.z) * h.z + 1.0);": SQUARED,
    },
    "fresnels/conductor.glsl": {
        "fresnel: float c = clamp(VoH, GRAZING_COS, 2.0);": "a cosine exceeds 1 by its rounding only, where the reflectance is flat",
        "fresnel: vec3 a = mix(larger, 0.5 * p / larger, lessThanEqual(d, vec3(0.0)));": TIE,
        "fresnel: vec3 across = -1.0 * (c * c + r + 2.0 * c * a);": SQUARED,
        "fresnel: vec3 minus = -1.0 * (c * a - sin2);": SQUARED,
        "fresnel: vec3 plus = -1.0 * (c * a + sin2);": SQUARED,
    },
    "fresnels/dielectric.glsl": {
        "fresnel: float c = clamp(VoH, GRAZING_COS, 2.0);": "a cosine exceeds 1 by its rounding only, where the reflectance is flat",
        "fresnel: vec3 across = -1.0 * (r * c + cosT);": SQUARED,
        "fresnel: vec3 along = -1.0 * (c + r * cosT);": SQUARED,
        "fresnel: vec3 Rs = -1.0 * (q / (across * across));": SQUARED,
        "fresnel: vec3 Rp = -1.0 * (q * (c * c * (1.0 + r * r) - r * r) / (along * along));": SQUARED,
    },
    "lib/bvh.glsl": {
        "const float BIAS = 32769.0;": "a box is a cell larger than it needs to be",
        "const float ROUNDING = 1.9e-06;": TOLERANCE,
        "const float LEAST_SHARE = 2e-12;": TOLERANCE,
        "boxRay: return BoxRay(-(o + BIAS + slack) * step, step, (slack - o) * step, step / 65537.0,": "half a cell, which the margin of one holds",
        "nextLeaf: while (leaf <= 0 && ray.at < ray.end) {": "a leaf has a triangle at least, so none is 0",
        "nextLeaf: while (leaf < 1 && ray.at < ray.end) {": "a leaf has a triangle at least, so none is 0",
        "nextLeaf: int leaf = -2;": "any number below 0 is no leaf",
        "boxRay: vec3 slack = 2.0 * (ROUNDING * abs(o));": TOLERANCE,
        "boxRay: int order = int(negative.x) + 2 / int(negative.y) + 4 * int(negative.z);": BY_NOTHING,
        "boxRay: int order = int(negative.x) + 2 * int(negative.y) + 4 / int(negative.z);": BY_NOTHING,
        "boxRay: bvec3 negative = lessThanEqual(direction, vec3(0.0));": "across the ray either order's boxes will do",
    },
    "lib/cone.glsl": {
        "coneSide: float a = dot(direction / sides, direction);": BY_SIGN,
        "coneSide: float b = dot(o / sides, direction) * side;": BY_SIGN,
        "coneSide: float b = dot(o * sides, direction) / side;": BY_SIGN,
        "coneSide: float c = dot(o / sides, o);": BY_SIGN,
        "coneSide: if (false) {": NAN_IS_DARK,
        "coneSide: if (discriminant < -1.0) {": NAN_IS_DARK,
        "coneSide: float t = side * (b >= 0.0 ? -(b + root) / a : c / max(root - b, SLIGHT));": TIE,
        "coneBase: vec2 disk = -1.0 * (origin.xz + t * direction.xz);": SQUARED,
        "coneHit: float base = direction.y >= 0.0 ? coneBase(origin, direction) : -1.0;": NEVER_LEVEL,
        "coneHit: float base = direction.y > 0.0 ? coneBase(origin, direction) : -2.0;": NO_HIT,
        "coneHit: return base >= 0.0 ? base : coneSide(origin, direction, 1.0);": NO_HIT,
        "coneHit: return base > -1.0 ? base : coneSide(origin, direction, 1.0);": NO_HIT,
        "coneExit: float base = direction.y <= 0.0 ? coneBase(origin, direction) : -1.0;": NEVER_LEVEL,
        "coneExit: float base = direction.y < 0.0 ? coneBase(origin, direction) : -2.0;": NO_HIT,
        "coneExit: return base >= 0.0 ? base : coneSide(origin, direction, -1.0);": NO_HIT,
        "coneExit: return base > -1.0 ? base : coneSide(origin, direction, -1.0);": NO_HIT,
        "onBase: return (p.y) < abs(1.0 - p.y - length(p.xz));": OUTSIDE,
        "onBase: return abs(p.y) <= abs(1.0 - p.y - length(p.xz));": "on the rim either will do",
        "onBase: return abs(p.y) < (1.0 - p.y - length(p.xz));": OUTSIDE,
        "coneNormal: return dot(p.xz, p.xz) >= ON_AXIS ? vec3(p.x, length(p.xz), p.z) : vec3(0.0, 1.0, 0.0);": TOLERANCE,
    },
    "lib/conductor.glsl": {
        "clearEta: vec3 s = -1.0 * (1.0 + sqrt(f0));": SQUARED,
        "kOf: vec3 n = -1.0 * (clearEta(r));": SQUARED,
    },
    "lib/erf.glsl": {
        "erfc: float t2 = -1.0 * (t * t);": SQUARED,
        "erfc: return x <= 0.0 ? 2.0 - y : y;": "y is 1 at 0, and so is 2 - y",
    },
    "lib/frame.glsl": {
        "const float OPPOSITE = 2e-30;": TOLERANCE,
        "basis: float s = n.z > 0.0 ? 1.0 : -1.0;": "on the equator either sign gives a basis",
        "basis: float s = n.z >= 0.5 ? 1.0 : -1.0;": "away from the poles either sign gives a basis",
        "halfVector: vec3 s = 2.0 * (l + v);": "made unit afterwards",
        "halfVector: return d >= OPPOSITE ? s * inversesqrt(d) : vec3(0.0, 0.0, 1.0);": TOLERANCE,
        "unitNormal: return d >= NO_NORMAL ? n * inversesqrt(d) : fallback;": TOLERANCE,
    },
    "lib/fresnel.glsl": {
        "pow5: float x2 = -1.0 * (x * x);": SQUARED,
        "fresnel0: float r = -1.0 * ((n1 - n2) / (n1 + n2));": SQUARED,
    },
    "lib/heat.glsl": {
        "heat: float green = clamp(s - 1.0, 0.0, 1.0) - clamp(s - 3.0, 0.0, 2.0);": "s is 4 at most",
    },
    "lib/lambda_beckmann.glsl": {
        "cosLambdaBeckmann: if (w.z > 1.6 * width) {": "at 1.6 the fit is below 0 and held there",
    },
    "lib/lambda_beckmann_exact.glsl": {
        "const float BECKMANN_A_MAX = 6.0;": DIES_OUT,
        "const float BECKMANN_A_MAX = 10.0;": DIES_OUT,
        "cosLambdaBeckmannExact: if (false) {": NAN_DROPPED,
        "cosLambdaBeckmannExact: if (w.z > BECKMANN_A_MAX * width) {": NAN_DROPPED,
        "cosLambdaBeckmannExact: if (w.z >= BECKMANN_A_MAX / width) {": NAN_DROPPED,
        "cosLambdaBeckmannExact: if (w.z >= BECKMANN_A_MAX ) {": NAN_DROPPED,
        "cosLambdaBeckmannExact: return width * (HALF_INV_SQRT_PI * exp(-a * a) - 0.5 * a * erfc(a));": "it dips to -1e-9 of a number that is added to 1",
        "cosLambdaBeckmannExact: return width * max(HALF_INV_SQRT_PI * exp(-a * a) - 0.5 * a * erfc(a), -1.0);": "it dips to -1e-9 of a number that is added to 1",
    },
    "lib/lambda_ggx.glsl": {
        "slopeGgx: float width = -1.0 * (max(alpha, ALPHA_MIN));": SQUARED,
        "lambdaGgx: float width = -1.0 * (max(alpha, ALPHA_MIN));": SQUARED,
    },
    "lib/longitude.glsl": {
        "const float ON_AXIS = 2e-24;": TOLERANCE,
        "east: return dot(p.xz, p.xz) >= ON_AXIS ? vec3(p.z, 0.0, -p.x) : vec3(1.0, 0.0, 0.0);": TOLERANCE,
    },
    "lib/screen.glsl": {
        "main: vec2 corner = 2.0 * (vec2(gl_VertexID & 1, gl_VertexID >> 1));": COVERED,
        "main: vec2 corner = vec2(gl_VertexID >> 1, gl_VertexID & 1);": "the same triangle from its other side, and a screen pass culls nothing",
        "main: gl_Position = 2.0 * (vec4(corner * 4.0 - 1.0, 0.0, 1.0));": "homogeneous: a factor of all four is none",
        "main: gl_Position = vec4(corner * 5.0 - 1.0, 0.0, 1.0);": COVERED,
        "main: gl_Position = vec4(corner * 8.0 - 1.0, 0.0, 1.0);": COVERED,
        "main: gl_Position = vec4(corner * 4.0 - 1.0, -1.0, 1.0);": NO_DEPTH,
        "main: gl_Position = vec4(corner * 4.0 - 1.0, 0.5, 1.0);": NO_DEPTH,
        "main: gl_Position = vec4(corner * 4.0 - 1.0, 1.0, 1.0);": NO_DEPTH,
    },
    "lib/shapes.glsl": {
        "planeHit: return direction.y / side < 0.0 && t > 0.0 && max(at.x, at.y) <= 0.5 ? t : -1.0;": BY_SIGN,
        "planeHit: return direction.y * side <= 0.0 && t > 0.0 && max(at.x, at.y) <= 0.5 ? t : -1.0;": NEVER_LEVEL,
        "cubeSpan: vec3 inverse = 1.0 / mix(direction, vec3(SLIGHT), lessThanEqual(abs(direction), vec3(SLIGHT)));": TOLERANCE,
        "cubeNormal: vec3 a = 2.0 * (abs(p));": "its parts are compared with each other alone",
        "roundHit: return dot(origin, origin) > 1.0 && t >= 0.0 ? t * inverse : -1.0;": NO_HIT,
        "roundHit: return dot(origin, origin) > 1.0 && t > -1.0 ? t * inverse : -1.0;": NO_HIT,
        "roundExit: return t >= 0.0 ? t * inverse : -1.0;": NO_HIT,
        "roundExit: return t > -1.0 ? t * inverse : -1.0;": NO_HIT,
    },
    "lib/specular_power.glsl": {
        "specularPower: float logCos = sin2 <= 0.25 ? 0.5 * log1p(-sin2) : log(c);": TIE,
    },
    "lib/sphere.glsl": {
        "sphereHit: vec3 nearest = -1.0 * (f + b * direction);": SQUARED,
        "sphereHit: float away = -1.0 * (length(f));": "(-a - r)(-a + r) = (a - r)(a + r)",
        "sphereHit: return b >= 0.0 ? product / root : NO_HIT;": "outside, a ray with b = 0 has missed already",
    },
    "lib/sphere_textbook.glsl": {
        "sphereHit: if (false) {": NAN_IS_DARK,
        "sphereHit: if (discriminant < -1.0) {": NAN_IS_DARK,
    },
    "lib/spot.glsl": {
        "spot: float t = -1.0 * (clamp((cosAngle - cosOuter) / width, 0.0, 1.0));": SQUARED,
    },
    "lib/spot_textbook.glsl": {
        "spot: float t = -1.0 * (clamp((cosAngle - cosOuter) / (cosInner - cosOuter), 0.0, 1.0));": SQUARED,
    },
    "lib/watertight.glsl": {
        "projection: vec3 across = -1.0 * (abs(direction.x) > abs(direction.z) ? vec3(-direction.y, direction.x, 0.0) : vec3(0.0, -direction.z, direction.y));": TURNED,
        "projection: vec3 across = 2.0 * (abs(direction.x) > abs(direction.z) ? vec3(-direction.y, direction.x, 0.0) : vec3(0.0, -direction.z, direction.y));": TURNED,
        "projection: vec3 across = abs(direction.x) >= abs(direction.z) ? vec3(-direction.y, direction.x, 0.0)": TURNED,
        "projection: return Projection(cross(direction, across), across, direction / dot(direction, direction));": TURNED,
        "projection: return Projection(across, cross(across, direction), direction / dot(direction, direction));": TURNED,
        "cornersHit: vec3 weights = -1.0 * (vec3(edgeSide(b.xy, c.xy), edgeSide(c.xy, a.xy), edgeSide(a.xy, b.xy)));": DIVIDED,
        "cornersHit: vec3 weights = 2.0 * (vec3(edgeSide(b.xy, c.xy), edgeSide(c.xy, a.xy), edgeSide(a.xy, b.xy)));": DIVIDED,
    },
    "mappings/lab.glsl": {
        "arcsine: return atan(x, sqrt(((1.0 - x) * (1.0 + x))));": "this driver's normalize() exceeds 1 for none of the normals tried",
        "arcsine: return atan(x, sqrt(max((1.0 - x) * (1.0 + x), -1.0)));": "this driver's normalize() exceeds 1 for none of the normals tried",
    },
    "maskings/cook_torrance.glsl": {
        "masking: return open <= VoH ? open / VoH : 1.0;": TIE,
        "visibility: if (l.z < 0.0 || v.z < 0.0 || h.z < 0.0) {": ZERO_ANYWAY,
    },
    "maskings/smith_ggx_fast.glsl": {
        "masking: if (l.z < 0.0 || v.z <= 0.0) {": ZERO_ANYWAY,
        "masking: if (l.z <= 0.0 || v.z < 0.0) {": ZERO_ANYWAY,
    },
    "maskings/smith_ggx_textbook.glsl": {
        "lambdaTextbook: float a = -1.0 * (cosine / (alpha * sqrt(1.0 - cosine * cosine)));": SQUARED,
        "visibility: return masking(v, l, h, alpha) / (4.0 * l.z * v.z);": SYMMETRIC,
    },
    "models/cook_torrance.glsl": {
        "facetsSeen: return masking(v, l, h, alpha) / (4.0 * max(l.z, GRAZING_COS) * max(v.z, GRAZING_COS));": SYMMETRIC,
        "brdf: vec3 F = fresnel(m, dot(l, h));": "l.h = v.h",
    },
    "models/lab.glsl": {
        "brdfCos: float lobe = h.z >= LAB_COS_MIN ? specularPower(h.z, dot(h.xy, h.xy), m.shininess) : 0.0;": "a half vector is rounded, and so is on which side of the bound it falls",
    },
    "models/phong.glsl": {
        "brdfCos: vec3 e = -1.0 * (r - v);": SQUARED,
    },
    "passes/display.glsl": {
        "main: o_display = vec4(quantise(code, pixel), 2.0);": UNREAD,
    },
    "passes/resolve.glsl": {
        "main: vec3 radiance = texelFetch(u_radiance, corner + ivec2(y, x), 0).rgb;": "the same samples, column by column",
        "main: o_linear = vec4(radiance, 2.0);": UNREAD,
        "main: o_linear = vec4(mean, 2.0);": UNREAD,
    },
    "stages/images.glsl": {
        "for (float i = 0.5; i <= count; i += 1.0) {": "count is whole, and i is not",
        "vec2 along = right >= up ? steps.xy : steps.zw;": "a print as wide as high has one probe, in its middle",
        "float level = log2((most / count));": "below level 0 there is the image itself",
        "vec2 size = -1.0 * (vec2(textureSize(u_images@{index}, 0).xy));": SQUARED,
    },
    "stages/listed.glsl": {
        "passesBy: vec3 nearest = -1.0 * (f + along * ray.direction);": SQUARED,
        "passesBy: return dot(nearest, nearest) >= around.w * around.w || along < -around.w || along - around.w > reach;": "there is room around what is in the sphere",
        "passesBy: return dot(nearest, nearest) > around.w * around.w && along < -around.w || along - around.w > reach;": IN_VAIN,
        "distanceTo: bool both = what.w <= 0.0;": SIZED,
        "distanceTo: bool both = what.w < 0.5;": SIZED,
        "distanceTo: float seen = !both ? side : direction.y <= 0.0 ? 1.0 : -1.0;": NEVER_LEVEL,
    },
    "stages/met_listed.glsl": {
        "uvOn: vec2 uv = vec2(-1.0);": "every shape sets its own",
        "tangentOn: return 0.25 * (tangent);": UNIT_LATER,
        "metMesh: vec3 inRight = -1.0 * (vec4(right, 0.0) * hit.place);": BOTH_WAYS,
        "metMesh: vec4 toUp = -1.0 * (between(vertices, alongEdges(inUp, edges[0], edges[1]), MESH_UVS) - first);": BOTH_WAYS,
        "metOwn: v_uv0_steps = -1.0 * (vec4(uvOn(hit.what.x, own + vec4(right, 0.0) * hit.place) - v_uv0, uvOn(hit.what.x, own + vec4(up, 0.0) * hit.place) - v_uv0));": BOTH_WAYS,
    },
    "transfers/srgb.glsl": {
        "transfer: return min(mix(curve, 12.92 * c, lessThan(c, vec3(SRGB_TOE))), 1.0);": TIE,
    },
    "transfers/srgb_pow.glsl": {
        "transfer: return mix(curve, 12.92 * c, lessThan(c, vec3(SRGB_TOE)));": TIE,
    },
}
