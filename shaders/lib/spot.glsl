/*---
title    = "Spot light cone"
equation = '''
S = \left(\frac{\cos\theta_s - \cos\theta_u}{\cos\theta_p - \cos\theta_u}\right)_{[0,1]}^2'''
source   = "Akenine-Moller et al. 2018, Real-Time Rendering, 4th ed., eq. 5.17"
---*/

// Share of a spot light's intensity at an angle from its axis: 1 inside the inner cone (penumbra
// angle p), 0 outside the outer one (umbra angle u), smooth between. Cosines in [-1, 1] -> [0, 1].
// Where the cones meet (or cross) the ratio is 0/0: a step at the outer.
float spot(float cosAngle, float cosInner, float cosOuter) {
    float width = cosInner - cosOuter;
    if (width <= 0.0) {
        return cosAngle >= cosOuter ? 1.0 : 0.0;
    }
    float t = clamp((cosAngle - cosOuter) / width, 0.0, 1.0);
    return t * t;
}
