"""Microfacets in float64: distributions, maskings, Fresnel terms.

Vectors rounded to float32 are made unit again where a formula needs sines from cosines. Where a
value is infinite or undefined the shader file's documented limit is returned.
"""
# ruff: noqa: E741  (l is the direction to the light)

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from lightbench.exact.directions import GRAZING_COS, HORIZON, Array, Material, column, dot, unit
from lightbench.exact.terms import erfc

ALPHA_MIN = 1e-4  # lib/alpha.glsl: narrower lobes are taken as this wide

# Distributions: Walter et al. 2007, eqs. 25, 30 and 33


def width(alpha: Array) -> Array:
    """The width that a lobe is given."""
    return np.maximum(alpha, ALPHA_MIN)


def alpha_from_roughness(roughness: Array) -> Array:
    """Burley 2012, section 5.4."""
    return width(roughness**2)


def beckmann(h: Array, alpha: Array) -> Array:
    """exp(-tan^2 / alpha^2) / (pi alpha^2 cos^4)."""
    c = np.maximum(unit(h)[..., 2], 1e-30)
    exponent = (c**2 - 1.0) / (width(alpha) ** 2 * c**2)
    log_d = exponent - np.log(math.pi * width(alpha) ** 2) - 4.0 * np.log(c)
    return np.where(h[..., 2] > 0.0, np.exp(log_d), 0.0)


def blinn_phong(h: Array, alpha: Array) -> Array:
    """(p + 2) / (2 pi) cos^p, p = 2 / alpha^2 - 2."""
    p = 2.0 / width(alpha) ** 2 - 2.0
    c = np.maximum(unit(h)[..., 2], 0.0)
    return np.where(c > 0.0, (p + 2.0) / (2.0 * math.pi) * c**p, 0.0)


def ggx(h: Array, alpha: Array) -> Array:
    """alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2)."""
    c, a2 = unit(h)[..., 2], width(alpha) ** 2
    return np.where(c > 0.0, a2 / (math.pi * (c**2 * (a2 - 1.0) + 1.0) ** 2), 0.0)


DISTRIBUTIONS = {"beckmann": beckmann, "blinn_phong": blinn_phong, "ggx": ggx}

# Maskings


def slope(w: Array, alpha: Array) -> Array:
    """a = cos / (alpha sin), with the square that [Heitz 2014] has under the root."""
    c = np.maximum(unit(w)[..., 2], HORIZON)
    with np.errstate(divide="ignore"):
        return c / (width(alpha) * np.sqrt(np.maximum(1.0 - c**2, 0.0)))


def lambda_ggx(w: Array, alpha: Array) -> Array:
    """(-1 + sqrt(1 + 1 / a^2)) / 2: Heitz 2014, eq. 72."""
    return (-1.0 + np.sqrt(1.0 + 1.0 / slope(w, alpha) ** 2)) / 2.0


def lambda_beckmann(w: Array, alpha: Array) -> Array:
    """The rational fit of Walter et al. 2007, eq. 27, held at 0 where it dips below."""
    a = np.minimum(slope(w, alpha), 1.6)
    fit = (1.0 - 1.259 * a + 0.396 * a**2) / (3.535 * a + 2.181 * a**2)
    return np.where(a < 1.6, np.maximum(fit, 0.0), 0.0)


def lambda_beckmann_exact(w: Array, alpha: Array) -> Array:
    """(erf(a) - 1) / 2 + exp(-a^2) / (2 a sqrt(pi)): Heitz 2014, eq. 66."""
    a = np.minimum(slope(w, alpha), 25.0)
    return np.asarray(np.exp(-(a**2)) / (2.0 * a * math.sqrt(math.pi)) - erfc(a) / 2.0)


Lambda = Callable[[Array, Array], Array]


def cos_lambda(function: Lambda) -> Lambda:
    """cos Lambda, on the horizon its limit."""

    def product(w: Array, alpha: Array) -> Array:
        return unit(lifted(w))[..., 2] * function(lifted(w), alpha)

    return product


def slope_ggx(w: Array, alpha: Array) -> Array:
    """cos (1 + 2 Lambda) of GGX = sqrt(cos^2 + (alpha sin)^2)."""
    w = unit(w)
    return np.asarray(
        np.sqrt(w[..., 2] ** 2 + width(alpha) ** 2 * (w[..., 0] ** 2 + w[..., 1] ** 2))
    )


Masking = Callable[[Array, Array, Array, Array], Array]


def correlated(function: Lambda) -> Masking:
    """G2 = 1 / (1 + Lambda(l) + Lambda(v)): Heitz 2014, eq. 99."""

    def masking(l: Array, v: Array, h: Array, alpha: Array) -> Array:
        lit = (l[..., 2] > 0.0) & (v[..., 2] > 0.0)
        return np.where(lit, 1.0 / (1.0 + function(l, alpha) + function(v, alpha)), 0.0)

    return masking


def separable(function: Lambda) -> Masking:
    """G2 = G1(l) G1(v), G1 = 1 / (1 + Lambda): Heitz 2014, eq. 98."""

    def masking(l: Array, v: Array, h: Array, alpha: Array) -> Array:
        lit = (l[..., 2] > 0.0) & (v[..., 2] > 0.0)
        g = 1.0 / (1.0 + function(l, alpha)) / (1.0 + function(v, alpha))
        return np.where(lit, g, 0.0)

    return masking


def v_cavity(l: Array, v: Array, h: Array, alpha: Array) -> Array:
    """min(1, 2 NoH NoV / VoH, 2 NoH NoL / VoH): Cook & Torrance 1982."""
    twice = 2.0 * unit(h)[..., 2] / np.maximum(dot(unit(v), unit(h)), 1e-300)
    g = np.minimum(1.0, twice * np.minimum(unit(l)[..., 2], unit(v)[..., 2]))
    return np.maximum(g, 0.0)


def hammon(l: Array, v: Array, h: Array, alpha: Array) -> Array:
    """2 NoL NoV / mix(2 NoL NoV, NoL + NoV, alpha): Hammon 2017, p. 82."""
    NoL, NoV, a = unit(l)[..., 2], unit(v)[..., 2], width(alpha)
    lit = (NoL > 0.0) & (NoV > 0.0)
    both, total = np.where(lit, 2.0 * NoL * NoV, 1.0), np.where(lit, NoL + NoV, 1.0)
    return np.where(lit, both / (both * (1.0 - a) + total * a), 0.0)


def unmasked(l: Array, v: Array, h: Array, alpha: Array) -> Array:
    """1."""
    return np.ones(np.broadcast_shapes(l.shape[:-1], v.shape[:-1], alpha.shape))


MASKINGS: dict[str, Masking] = {
    "cook_torrance": v_cavity,
    "none": unmasked,
    "smith_beckmann": correlated(lambda_beckmann),
    "smith_beckmann_exact": correlated(lambda_beckmann_exact),
    "smith_beckmann_uncorrelated": separable(lambda_beckmann),
    "smith_ggx": correlated(lambda_ggx),
    "smith_ggx_fast": hammon,
    "smith_ggx_uncorrelated": separable(lambda_ggx),
}


def lifted(w: Array) -> Array:
    """Directions with those on the horizon raised by a cosine that float64 can divide by."""
    return np.concatenate([w[..., :2], np.maximum(w[..., 2:], HORIZON)], axis=-1)


def visibility(masking: Masking) -> Masking:
    """G / (4 NoL NoV), on the horizon its limit; 0 below."""

    def visible(l: Array, v: Array, h: Array, alpha: Array) -> Array:
        seen = (l[..., 2] >= 0.0) & (v[..., 2] >= 0.0)
        l, v = lifted(l), lifted(v)
        g = masking(l, v, h, alpha)
        return np.where(seen, g / (4.0 * unit(l)[..., 2] * unit(v)[..., 2]), 0.0)

    return visible


def unmasked_visibility(l: Array, v: Array, h: Array, alpha: Array) -> Array:
    """1 / (4 NoL NoV), the cosines no lower than GRAZING_COS: on the horizon it is infinite."""
    return 0.25 / np.maximum(l[..., 2], GRAZING_COS) / np.maximum(v[..., 2], GRAZING_COS)


VISIBILITIES = {name: visibility(masking) for name, masking in MASKINGS.items()}
VISIBILITIES["none"] = unmasked_visibility

# Fresnel


def schlick(m: Material, VoH: Array) -> Array:
    """f0 + (1 - f0) (1 - VoH)^5: Schlick 1994."""
    return m["f0"] + (1.0 - m["f0"]) * column(np.maximum(1.0 - VoH, 0.0) ** 5)


def dielectric(m: Material, VoH: Array) -> Array:
    """The mean of both polarisations, for eta = (1 + sqrt(f0)) / (1 - sqrt(f0)): Fresnel 1823.

    1 on the horizon, unless nothing is there to reflect, f0 = 0.
    """
    s, c = np.sqrt(m["f0"]), column(VoH)
    clear = s < 1.0
    eta = (1.0 + s) / np.where(clear, 1.0 - s, 1.0)
    t = np.sqrt(1.0 - (1.0 - c**2) / eta**2)
    flat = (c == 0.0) | ~clear
    across = np.where(flat, -1.0, (c - eta * t) / np.where(flat, 1.0, c + eta * t))
    along = np.where(flat, -1.0, (eta * c - t) / np.where(flat, 1.0, eta * c + t))
    return np.where(s > 0.0, (across**2 + along**2) / 2.0, 0.0)


def conductor(m: Material, VoH: Array) -> Array:
    """The mean of both polarisations, for the complex index eta + i k: Born & Wolf, sec. 14.2.

    1 on the horizon, unless nothing is there to reflect, eta = 1 and k = 0.
    """
    index, c = m["eta"] + 1j * m["k"], column(VoH)
    t = np.sqrt(index**2 - (1.0 - c) * (1.0 + c))
    flat = c == 0.0
    across = np.where(flat, -1.0, (c - t) / np.where(flat, 1.0, c + t))
    along = np.where(flat, -1.0, (index**2 * c - t) / np.where(flat, 1.0, index**2 * c + t))
    return np.where(index == 1.0, 0.0, (np.abs(across) ** 2 + np.abs(along) ** 2) / 2.0)


F0_MAX = 0.999  # lib/conductor.glsl: a perfect mirror has no index


def clear_eta(f0: Array) -> Array:
    """The index of the clear medium that reflects f0 at normal incidence."""
    return (1.0 + np.sqrt(f0)) / (1.0 - np.sqrt(f0))


def eta_of(f0: Array, metalness: Array) -> Array:
    """Gulbrandsen 2014, eq. 11, with the metalness for the edge tint."""
    r, g = np.minimum(f0, F0_MAX), column(metalness)
    return g * (1.0 - r) / (1.0 + r) + (1.0 - g) * clear_eta(r)


def k_of(f0: Array, metalness: Array) -> Array:
    """Gulbrandsen 2014, eq. 13."""
    r, n = np.minimum(f0, F0_MAX), eta_of(f0, metalness)
    k2 = (r * (n + 1.0) ** 2 - (n - 1.0) ** 2) / (1.0 - r)
    # A clear medium's is 0, of which the difference leaves its rounding.
    return np.where(column(metalness) > 0.0, np.sqrt(np.maximum(k2, 0.0)), 0.0)


def mirror(m: Material, VoH: Array) -> Array:
    """1."""
    return np.ones((*VoH.shape, 3))


FRESNELS = {
    "schlick": schlick, "dielectric": dielectric, "conductor": conductor, "none": mirror,
}  # fmt: skip
