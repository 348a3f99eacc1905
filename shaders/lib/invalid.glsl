// Loud colours for values that no picture may hold.
const vec3 NAN_COLOR = vec3(1.0, 0.0, 1.0);
const vec3 INF_COLOR = vec3(1.0, 1.0, 0.0);
const vec3 NEGATIVE_COLOR = vec3(0.0, 1.0, 1.0);

// Magenta where any channel is NaN, else yellow where any is infinite, else cyan where any is
// negative; otherwise the colour given. In this order: every comparison with NaN is false.
vec3 flagInvalid(vec3 radiance, vec3 otherwise) {
    if (any(isnan(radiance))) {
        return NAN_COLOR;
    }
    if (any(isinf(radiance))) {
        return INF_COLOR;
    }
    return any(lessThan(radiance, vec3(0.0))) ? NEGATIVE_COLOR : otherwise;
}

// Whether any channel is NaN, infinite or negative.
bool invalid(vec3 radiance) {
    return any(isnan(radiance)) || any(isinf(radiance)) || any(lessThan(radiance, vec3(0.0)));
}
