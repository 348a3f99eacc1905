/*---
title    = "None"
equation = '0'
source   = "the picture as it is"
about    = "No outlines. Free."
---*/
float outline(ivec2 pixel) {
    return 0.0;
}

bool unlined() {
    return true;
}
