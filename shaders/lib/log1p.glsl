// ln(1 + x), exact where 1 + x rounds to 1.
// 2 artanh(z), z = x / (2 + x), by its series to z^13. Abramowitz & Stegun 1964, eq. 4.1.27.
// x [-0.5, 1] -> relative error 3e-7: |z| <= 1/3 there, so the first term left out is 1.4e-8.
float log1p(float x) {
    float z = x / (2.0 + x);
    float q = z * z;
    float tail = 1.0 / 7.0 + q * (1.0 / 9.0 + q * (1.0 / 11.0 + q * (1.0 / 13.0)));
    return 2.0 * z * (1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * tail)));
}
