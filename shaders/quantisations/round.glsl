/*---
title    = "Nearest level"
equation = '\lfloor 255\, c + \tfrac{1}{2} \rfloor / 255'
source   = "OpenGL ES 3.0, conversion from floating-point to normalized fixed-point"
domain   = { code = [0.0, 1.0] }
about    = """
At most half a level off, and none on average. The 8-bit target does it by itself, so it costs \
nothing; halfway between two levels the driver decides."""
---*/
// The code as it is: whoever writes it into 8 bits rounds it.
vec3 quantise(vec3 code, ivec2 pixel) {
    return code;
}
