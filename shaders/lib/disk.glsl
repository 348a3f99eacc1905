/*---
title  = "Points of a disk"
source = "Vogel 1979, A better way to construct the sunflower head"
---*/

// The golden angle in radians.
const float GOLDEN_ANGLE = 2.3999632;

// Point i of n that are spread evenly over the unit disk: at the radius sqrt((i + 1/2) / n), turned
// by the golden angle each.
vec2 diskPoint(int i, int n) {
    float angle = GOLDEN_ANGLE * float(i);
    return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}
