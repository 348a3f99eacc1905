/*---
title    = "Constant"
equation = '\frac{d^2}{d_\mathrm{far}^2} - \mathrm{bias}'
source   = "the classic offset, 0.001 of squared normalised distance"
about    = """
One number for every surface. On squares it is no constant distance: near the light it is far too \
much, so shadows float; far from it too little, so surfaces that the light grazes are striped."""

[parameters.bias_constant]
kind    = "float"
default = 0.001
range   = [0.0, 0.02]
step    = 0.0001
label   = "Bias of squared distance"
---*/
float compared(float distance, float far, float reach, float NoL) {
    float share = distance / far;
    return share * share - u_bias_constant;
}

bool reachless() {
    return true;
}
