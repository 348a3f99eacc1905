/*---
title       = "Smith for GGX, textbook form"
textbook_of = "smith_ggx"
equation    = '''
G = \frac{1}{1 + \Lambda(l) + \Lambda(v)},\quad \Lambda = \frac{-1 + \sqrt{1 + 1/a^2}}{2},\quad
a = \frac{\cos\theta}{\alpha \sqrt{1 - \cos^2\theta}}'''
source      = "Heitz 2014, eqs. 72 and 99"
domain      = { alpha = [1e-4, 1.0], NoL = [1e-7, 1.0], NoV = [1e-7, 1.0] }
about       = """
For comparison only: Smith's masking as it is printed, divided by 4 (n.l)(n.v). The horizon is \
0/0, and a cosine that rounds to more than 1 is the root of a negative number."""
---*/

// Nothing is guarded.
float lambdaTextbook(float cosine, float alpha) {
    float a = cosine / (alpha * sqrt(1.0 - cosine * cosine));
    return (-1.0 + sqrt(1.0 + 1.0 / (a * a))) / 2.0;
}

float masking(vec3 l, vec3 v, vec3 h, float alpha) {
    return 1.0 / (1.0 + lambdaTextbook(l.z, alpha) + lambdaTextbook(v.z, alpha));
}

float visibility(vec3 l, vec3 v, vec3 h, float alpha) {
    return masking(l, v, h, alpha) / (4.0 * l.z * v.z);
}
