/*---
title    = "Ray and triangle without gaps"
equation = '''
u = (p_c \times p_a)_z,\quad v = (p_a \times p_b)_z,\quad w = (p_b \times p_c)_z,\quad
t = \frac{w\,t_a + u\,t_b + v\,t_c}{u + v + w}'''
source   = "Woop, Benthin & Wald 2013, Watertight Ray/Triangle Intersection"
about    = """
The corners are projected along the ray, which then is a point that each edge has on a side. Two \
triangles that share an edge compute the same number for it but for the sign, so no ray slips \
between them, however small and far they are."""
---*/

// What corners are projected with: across is a right angle to the direction, and so is up; along
// gives the distance.
struct Projection {
    vec3 across;
    vec3 up;
    vec3 along;
};

// That of a ray; direction of any length but 0.
Projection projection(vec3 direction) {
    vec3 across = abs(direction.x) > abs(direction.z) ? vec3(-direction.y, direction.x, 0.0)
                                                      : vec3(0.0, -direction.z, direction.y);
    return Projection(across, cross(direction, across), direction / dot(direction, direction));
}

// A corner, from the ray's origin, as its place across the ray and its distance along it.
vec3 projected(Projection p, vec3 corner) {
    return vec3(dot(p.across, corner), dot(p.up, corner), dot(p.along, corner));
}

// Which side of the origin the edge from a to b passes on, and by how much: the same for the edge
// from b to a, but for its sign.
float edgeSide(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// The distance to a triangle of projected corners, or -1, and the weights of b and c there. Met
// from either side; its edges belong to it; one seen edge-on is never met.
vec3 cornersHit(vec3 a, vec3 b, vec3 c) {
    vec3 weights = vec3(edgeSide(b.xy, c.xy), edgeSide(c.xy, a.xy), edgeSide(a.xy, b.xy));
    float total = weights.x + weights.y + weights.z;
    bool inside = all(greaterThanEqual(weights, vec3(0.0)))
               || all(lessThanEqual(weights, vec3(0.0)));
    if (!inside || total == 0.0) {
        return vec3(-1.0, 0.0, 0.0);
    }
    weights /= total;
    float distance = dot(weights, vec3(a.z, b.z, c.z));
    return vec3(distance > 0.0 ? distance : -1.0, weights.yz);
}
