// ln(1 + x), exact where 1 + x rounds to 1.
// 2 artanh(z), z = x / (2 + x), by its series to z^13. Abramowitz & Stegun 1964, eq. 4.1.27.
// x > -1 -> relative error 3e-7. On [-0.5, 1], |z| <= 1/3, so the first term left out is 1.4e-8;
// elsewhere 1 + x keeps enough digits of x for log().
float log1p(float x) {
    if (x < -0.5 || x > 1.0) {
        return log(1.0 + x);
    }
    float z = x / (2.0 + x);
    float q = z * z;
    float tail = 1.0 / 7.0 + q * (1.0 / 9.0 + q * (1.0 / 11.0 + q * (1.0 / 13.0)));
    return 2.0 * z * (1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * tail)));
}
