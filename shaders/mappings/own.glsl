/*---
title    = "The object's own"
equation = '(u, v)'
source   = "glTF 2.0, 3.7.2"
about    = "The coordinates that the mesh has at its vertices, or that its shape gives to a point."
---*/
