// ln(1 + x), exact where 1 + x rounds to 1.
// 2 artanh(z), z = x / (2 + x), by its series to z^7. Abramowitz & Stegun 1964, eq. 4.1.27.
// x [-0.25, 0.25] -> relative error 2e-7: |z| <= 1/7 there, so the first term left out is 2e-8.
float log1p(float x) {
    float z = x / (2.0 + x);
    float q = z * z;
    return 2.0 * z * (1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0))));
}
