/*---
title    = "None"
equation = 'L_d = L'
source   = "the identity"
about    = "Radiance as it is; what is above 1 is cut off by the display."
---*/
vec3 tonemap(vec3 radiance) {
    return radiance;
}
