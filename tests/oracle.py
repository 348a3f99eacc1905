"""Float64 references of the shader functions, in the form the papers print.

Each takes what its GLSL twin takes, in float64, with the settings that its file reads as keywords;
`FUNCTIONS` maps (file, function) to its reference. Those of surfaces are in oracle_surface.py.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.oracle_surface import (
    Array,
    DISTRIBUTIONS,
    FRESNELS,
    MASKINGS,
    Material,
    VISIBILITIES,
    alpha_from_roughness,
    blend_with_base,
    blinn_phong_cos,
    column,
    cook_torrance,
    cook_torrance_cos,
    cos_lambda,
    facing_normal,
    half_vector,
    lambda_beckmann,
    lambda_ggx,
    lambert,
    over_base,
    over_cosine,
    phong_cos,
    slope_ggx,
    unit_normal,
)

# Lights


def polynomial(distance: Array, light: Material) -> Array:
    """1 / (c0 + c1 d + c2 d^2), at most 1e4."""
    p = light["c0"] + light["c1"] * distance + light["c2"] * distance**2
    return 1.0 / np.maximum(p, 1e-4)


def inverse_square(distance: Array, light: Material) -> Array:
    """1 / max(d, radius)^2, the radius at least 1e-4 m."""
    return np.maximum(np.maximum(distance, light["light_radius"]), 1e-4) ** -2.0


def spot(cos_angle: Array, cos_inner: Array, cos_outer: Array) -> Array:
    """The squared ramp between the cones; a step where they meet."""
    meet = cos_inner <= cos_outer
    ramp = (cos_angle - cos_outer) / np.where(meet, 1.0, cos_inner - cos_outer)
    step = np.where(cos_angle >= cos_outer, 1.0, 0.0)
    return np.where(meet, step, np.clip(ramp, 0.0, 1.0) ** 2)


def unshadowed(position: Array) -> Array:
    """1."""
    return np.ones(position.shape[:-1])


def constant_ambient(
    m: Material,
    ambient_color: tuple[float, float, float] = (1.0, 1.0, 1.0),
    ambient_level: float = 0.05,
) -> Array:
    """rho / pi times the integral of L cos over the hemisphere."""
    tint = np.array(ambient_color) * ambient_level
    return m["base_color"] * tint


def no_ambient(m: Material) -> Array:
    """0."""
    return np.zeros((1, 3))


# Display


def luminance(color: Array) -> Array:
    """ITU-R BT.709-6, item 3.2."""
    return np.asarray(color @ np.array([0.2126, 0.7152, 0.0722]))


def identity(color: Array) -> Array:
    """The colour itself."""
    return color


def reinhard(radiance: Array) -> Array:
    """L_d = L / (1 + L), rgb L_d / L where L > 0: Reinhard et al. 2002, eq. 3."""
    L = column(luminance(radiance))
    safe = np.where(L > 0.0, L, 1.0)
    return np.where(L > 0.0, radiance * (safe / (1.0 + safe)) / safe, radiance)


def reinhard_extended(radiance: Array, L_white: float = 4.0) -> Array:
    """L_d = L (1 + L / L_w^2) / (1 + L), L_w at least 1e-6, at most float32's largest value."""
    L = column(luminance(radiance))
    safe = np.where(L > 0.0, L, 1.0)
    L_d = safe * (1.0 + safe / max(L_white, 1e-6) ** 2) / (1.0 + safe)
    largest = float(np.finfo(np.float32).max)
    return np.clip(np.where(L > 0.0, radiance * (L_d / safe), radiance), -largest, largest)


def displayed(linear: Array) -> Array:
    """Clamped to what a display can show."""
    return np.clip(linear, 0.0, 1.0)


def gamma_code(linear: Array, gamma: float = 2.2) -> Array:
    """c^(1 / gamma)."""
    return displayed(linear) ** (1.0 / gamma)


def srgb_code(linear: Array) -> Array:
    """IEC 61966-2-1: 12.92 c up to 0.0031308, then 1.055 c^(1 / 2.4) - 0.055."""
    c = displayed(linear)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1.0 / 2.4) - 0.055)


TONEMAPS: dict[str, Callable[..., Array]] = {
    "none": identity,
    "reinhard": reinhard,
    "reinhard_extended": reinhard_extended,
}
TRANSFERS: dict[str, Callable[..., Array]] = {
    "gamma": gamma_code,
    "linear": displayed,
    "srgb": srgb_code,
}


def final_view(
    radiance: Array, tonemap: str = "none", transfer: str = "srgb", exposure: float = 0.0
) -> Array:
    """transfer(tonemap(radiance 2^exposure))."""
    return TRANSFERS[transfer](TONEMAPS[tonemap](radiance * 2.0**exposure))


def flag_invalid(radiance: Array, otherwise: Array) -> Array:
    """NaN magenta, infinite yellow, negative cyan, in this order."""
    flags = [
        np.isnan(radiance).any(axis=-1, keepdims=True),
        np.isinf(radiance).any(axis=-1, keepdims=True),
        (radiance < 0.0).any(axis=-1, keepdims=True),
    ]
    loud = [np.array(color) for color in ([1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0])]
    return np.select(flags, loud, otherwise)


def invalid_view(radiance: Array) -> Array:
    """The loud colours over a grey of sqrt(L / (1 + L)) / 4."""
    with np.errstate(invalid="ignore"):
        L = luminance(radiance)
        grey = column(0.25 * np.sqrt(L / (1.0 + L)))
    return flag_invalid(radiance, np.repeat(grey, 3, axis=-1))


def invalid(radiance: Array) -> Array:
    """1 where a channel is NaN, infinite or negative."""
    bad = ~np.isfinite(radiance) | (radiance < 0.0)
    return np.where(bad.any(axis=-1), 1.0, 0.0)


# lib functions with no twin above


def pow5(x: Array) -> Array:
    """x^5."""
    return x**5


def fresnel0(n1: Array, n2: Array) -> Array:
    """((n1 - n2) / (n1 + n2))^2."""
    return ((n1 - n2) / (n1 + n2)) ** 2


def specular_power(c: Array, sin2: Array, n: Array) -> Array:
    """max(0, cos)^n of an angle known by its cosine and its squared sine; 1 for n = 0."""
    cosine = np.where(sin2 < 0.5, np.sqrt(np.maximum(1.0 - sin2, 0.0)), c)
    return np.where(n == 0.0, 1.0, np.where(c > 0.0, np.maximum(cosine, 0.0) ** n, 0.0))


def smith_correlated(NoL: Array, NoV: Array, cosL: Array, cosV: Array) -> Array:
    """1 / (4 NoL NoV (1 + Lambda(l) + Lambda(v))), from the products cosine times Lambda."""
    return 1.0 / (4.0 * NoL * NoV * (1.0 + cosL / NoL + cosV / NoV))


def smith_separable(NoL: Array, NoV: Array, cosL: Array, cosV: Array) -> Array:
    """1 / (4 NoL NoV (1 + Lambda(l)) (1 + Lambda(v)))."""
    return 1.0 / (4.0 * NoL * NoV * (1.0 + cosL / NoL) * (1.0 + cosV / NoV))


def has_tone(Y: Array) -> Array:
    """1 for a finite luminance above 0."""
    return (np.isfinite(Y) & (Y > 0.0)).astype(np.float64)


def display_range(linear: Array) -> Array:
    """Clamped to [0, 1]; magenta where a channel is NaN."""
    magenta = np.array([1.0, 0.0, 1.0])
    nan = np.isnan(linear).any(axis=-1, keepdims=True)
    return np.where(nan, magenta, np.clip(linear, 0.0, 1.0))


FUNCTIONS: dict[tuple[str, str], Callable[..., Array]] = {
    ("ambients/constant.glsl", "ambient"): constant_ambient,
    ("ambients/none.glsl", "ambient"): no_ambient,
    ("attenuations/inverse_square.glsl", "attenuation"): inverse_square,
    ("attenuations/polynomial.glsl", "attenuation"): polynomial,
    ("lib/alpha.glsl", "alphaFromRoughness"): alpha_from_roughness,
    ("lib/base.glsl", "blendWithBase"): blend_with_base,
    ("lib/base.glsl", "overBase"): over_base,
    ("lib/display.glsl", "displayRange"): display_range,
    ("lib/frame.glsl", "facingNormal"): facing_normal,
    ("lib/frame.glsl", "halfVector"): half_vector,
    ("lib/frame.glsl", "unitNormal"): unit_normal,
    ("lib/fresnel.glsl", "fresnel0"): fresnel0,
    ("lib/fresnel.glsl", "pow5"): pow5,
    ("lib/invalid.glsl", "flagInvalid"): flag_invalid,
    ("lib/invalid.glsl", "invalid"): invalid,
    ("lib/log1p.glsl", "log1p"): np.log1p,
    ("lib/luminance.glsl", "luminance"): luminance,
    ("lib/smith.glsl", "smithCorrelated"): smith_correlated,
    ("lib/smith.glsl", "smithSeparable"): smith_separable,
    ("lib/specular_power.glsl", "specularPower"): specular_power,
    ("lib/spot.glsl", "spot"): spot,
    ("lib/tone.glsl", "hasTone"): has_tone,
    ("models/blinn_phong.glsl", "brdf"): over_cosine(blinn_phong_cos),
    ("models/blinn_phong.glsl", "brdfCos"): blinn_phong_cos,
    ("models/cook_torrance.glsl", "brdf"): cook_torrance,
    ("models/cook_torrance.glsl", "brdfCos"): cook_torrance_cos,
    ("models/lambert.glsl", "brdf"): lambert,
    ("models/phong.glsl", "brdf"): over_cosine(phong_cos),
    ("models/phong.glsl", "brdfCos"): phong_cos,
    ("shadows/none.glsl", "shadow"): unshadowed,
    ("views/final.glsl", "view"): final_view,
    ("views/invalid.glsl", "view"): invalid_view,
}
for _name, _distribution in DISTRIBUTIONS.items():
    FUNCTIONS[f"distributions/{_name}.glsl", "distribution"] = _distribution
for _name, _masking in MASKINGS.items():
    FUNCTIONS[f"maskings/{_name}.glsl", "masking"] = _masking
    FUNCTIONS[f"maskings/{_name}.glsl", "visibility"] = VISIBILITIES[_name]
for _name, _fresnel in FRESNELS.items():
    FUNCTIONS[f"fresnels/{_name}.glsl", "fresnel"] = _fresnel
for _name, _tonemap in TONEMAPS.items():
    FUNCTIONS[f"tonemaps/{_name}.glsl", "tonemap"] = _tonemap
for _name, _transfer in TRANSFERS.items():
    FUNCTIONS[f"transfers/{_name}.glsl", "transfer"] = _transfer
for _name, _lambda in {"Ggx": lambda_ggx, "Beckmann": lambda_beckmann}.items():
    FUNCTIONS[f"lib/lambda_{_name.lower()}.glsl", f"lambda{_name}"] = _lambda
FUNCTIONS["lib/lambda_beckmann.glsl", "cosLambdaBeckmann"] = cos_lambda(lambda_beckmann)
FUNCTIONS["lib/lambda_ggx.glsl", "slopeGgx"] = slope_ggx
