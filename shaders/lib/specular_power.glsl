#include "lib/log1p.glsl"

// max(0, c)^n of a cosine c whose squared sine sin2 is known from the vectors, not from 1 - c^2.
// exp(n ln c), ln c = ln(1 - sin2) / 2. n [0, 1e6], and 2e8 for a distribution -> [0, 1].
// Near the peak c rounds to 1 and pow(c, 1e6) is 6 % off; sin2 keeps every digit. Farther out than
// sin2 = 0.25 a wide lobe has digits enough in c, and a narrow one has ended. n = 0 gives 1
// everywhere, c <= 0 included: pow(0, 0) is undefined in GLSL.
float specularPower(float c, float sin2, float n) {
    float logCos = sin2 < 0.25 ? 0.5 * log1p(-sin2) : log(c);
    float lobe = exp(n * logCos);
    return c > 0.0 ? lobe : float(n == 0.0);
}
