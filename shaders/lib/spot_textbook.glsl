/*---
title       = "Spot light cone, textbook form"
textbook_of = "spot"
equation    = '''
S = \left(\frac{\cos\theta_s - \cos\theta_u}{\cos\theta_p - \cos\theta_u}\right)_{[0,1]}^2'''
source      = "Akenine-Moller et al. 2018, Real-Time Rendering, 4th ed., eq. 5.17"
domain      = { width = [1e-7, 2.0] }
---*/

// For comparison only: where the cones meet it is 0/0 on their border and 1/0 beside it.
float spot(float cosAngle, float cosInner, float cosOuter) {
    float t = clamp((cosAngle - cosOuter) / (cosInner - cosOuter), 0.0, 1.0);
    return t * t;
}
