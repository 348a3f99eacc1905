"""Broken shaders that no test can tell from whole ones, and why: see test_mutations.py."""

# File: {the place as it then reads: why nothing changes}.
EXPECTED_SURVIVORS: dict[str, dict[str, str]] = {
    "attenuations/inverse_square.glsl": {
        "attenuation: float d = "
        "-1.0 * (max(distance, max(light.light_radius, LIGHT_RADIUS_MIN)));": (
            "d is only ever squared"
        ),
    },
    "distributions/beckmann.glsl": {
        "distribution: if (h.z <= 0.0 || c2 * c2 <= BECKMANN_COS4_MIN) {": (
            "differs where the fourth power is exactly the bound, and D is 0 on both sides of it"
        ),
    },
    "distributions/ggx_textbook.glsl": {
        "distribution: float d = -1.0 * ((h.z * a2 - h.z) * h.z + 1.0);": "d is only ever squared",
    },
    "fresnels/dielectric.glsl": {
        "fresnel: float c = clamp(VoH, GRAZING_COS, 2.0);": (
            "a cosine exceeds 1 by its rounding only, where the reflectance is flat"
        ),
    },
    "lib/frame.glsl": {
        "halfVector: return d >= OPPOSITE ? s * inversesqrt(d) : vec3(0.0, 0.0, 1.0);": (
            "differs where |l + v|^2 is exactly 1e-30, which is rounding and nothing else"
        ),
    },
    "lib/screen.glsl": {
        "main: gl_Position = vec4(corner * 4.0 - 1.0, -1.0, 1.0);": (
            "the nearest depth is as visible as the middle one, and screen passes test no depth"
        ),
    },
    "passes/display.glsl": {
        "main: o_display = vec4(view(texelFetch(u_linear, ivec2(gl_FragCoord.xy), 0).rgb), 2.0);": (
            "an 8-bit target holds no alpha above 1"
        ),
    },
}
