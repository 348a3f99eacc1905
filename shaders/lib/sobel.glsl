/*---
title    = "Sobel operator"
equation = 'G_x = \begin{pmatrix} -1 & 0 & 1 \\ -2 & 0 & 2 \\ -1 & 0 & 1 \end{pmatrix},\quad G_y = -G_x^T'
source   = "Gonzalez & Wintz, Digital Image Processing; Sobel & Feldman 1968"
---*/

// |gx| + |gy| of a 3x3 neighbourhood, rows from the top, each from the left.
vec4 sobel(vec4 nw, vec4 n, vec4 ne, vec4 w, vec4 e, vec4 sw, vec4 s, vec4 se) {
    vec4 gx = ne + 2.0 * e + se - nw - 2.0 * w - sw;
    vec4 gy = nw + 2.0 * n + ne - sw - 2.0 * s - se;
    return abs(gx) + abs(gy);
}
