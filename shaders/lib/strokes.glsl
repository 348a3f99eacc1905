/*---
title  = "Lines in a plane"
source = "Foley et al. 1990, Computer Graphics: Principles and Practice, 2nd ed., section 3.17"
about  = "How far a point is from an outline, and how much of a pixel its line covers."
---*/

// Distance of q to the line from -h to h. The end is found along h, which is never zero, and not as
// the difference of two points, which far away may be.
float segmentDistance(vec2 q, vec2 h) {
    return length(q - clamp(dot(q, h) / dot(h, h), -1.0, 1.0) * h);
}

// Distance of q, from the middle, to the outline with the corners +-x+-y.
float squareDistance(vec2 q, vec2 x, vec2 y) {
    float along = min(segmentDistance(q - y, x), segmentDistance(q + y, x));
    return min(along, min(segmentDistance(q - x, y), segmentDistance(q + x, y)));
}

// Distance of q, from the middle, to the circle through x.
float circleDistance(vec2 q, vec2 x) {
    return abs(length(q) - length(x));
}

// Distance of q, from the middle, to the line from -x to x.
float lineDistance(vec2 q, vec2 x) {
    return segmentDistance(q, x);
}

// Share of a pixel that a line of a width covers whose middle is at a distance: pixels all three.
// The edge is a ramp of one pixel across.
float strokeCoverage(float distance, float width) {
    return clamp(0.5 * width - distance + 0.5, 0.0, 1.0);
}
