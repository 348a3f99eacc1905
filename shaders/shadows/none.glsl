/*---
title    = "None"
equation = 'V = 1'
source   = "direct light without an occlusion test"
unit     = "1"
about    = "Every light reaches every point that faces it, through whatever stands between. Free."
---*/
float shadow(vec3 position) {
    return 1.0;
}
