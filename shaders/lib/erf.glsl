/*---
title    = "Complementary error function"
equation = '\mathrm{erfc}(x) = \frac{2}{\sqrt{\pi}} \int_x^\infty e^{-t^2} dt'
source   = "this project: minimax polynomial in 1 / (1 + 0.4 x), the variable of Hastings 1955"
domain   = { x = [-4.0, 9.0] }
---*/

// erfc(x) = e^(-x^2) t P(t), t = 1 / (1 + 0.4 x), for x >= 0; 2 - erfc(-x) below.
// P of degree 8 is within 1.3e-7 of the truth at every x; what else is lost is the rounding of x^2
// in the exponent, x^2 2^-24. erf(x) is 1 - erfc(x), good to 2e-7. Any x -> [0, 2].
float erfc(float x) {
    float a = abs(x);
    float t = 1.0 / (1.0 + 0.4 * a);
    float low = 0.22567586 + t * (0.22566952 + t * (0.20784398 + t * 0.16853305));
    float high = 0.14146387 + t * (t * (0.16916116 + t * (t * 0.05027338 - 0.18294713)) - 0.00567356);
    float t2 = t * t;
    float y = exp(-a * a) * t * (low + t2 * t2 * high);
    return x < 0.0 ? 2.0 - y : y;
}
