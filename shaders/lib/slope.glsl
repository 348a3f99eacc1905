/*---
title  = "Bias by slope"
source = "Akenine-Moller et al. 2018, Real-Time Rendering, 4th ed., section 7.4.1"
---*/

// Least cosine that the slope is taken at: 84 degrees, a slope of 10.
const float SLOPE_COS_MIN = 0.1;

// Share of the distance for what float32 and the map's depth test leave uncertain.
const float DISTANCE_SHARE = 1e-4;

// Metres by which the distance from the light to a plane changes within reach metres across it, and
// the uncertainty of the distance itself. reach tan(theta) + 1e-4 distance. NoL [0, 1]. The squared
// sine is a product, which keeps its digits where 1 - c^2 has lost them.
float slopeBias(float distance, float reach, float NoL) {
    float c = clamp(NoL, SLOPE_COS_MIN, 1.0);
    return reach * sqrt((1.0 - c) * (1.0 + c)) / c + DISTANCE_SHARE * distance;
}
