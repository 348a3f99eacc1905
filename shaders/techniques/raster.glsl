/*---
title    = "Rasterisation"
equation = 'p_\mathrm{clip} = P\, V\, M\, p'
source   = "Akenine-Moller et al. 2018, Real-Time Rendering, 4th ed., chapter 2"
about    = """
Each object's triangles are projected onto the picture and shaded where they are nearest. Fast; what \
a mirror shows, and exactly where a shadow falls, it does not know."""
---*/
