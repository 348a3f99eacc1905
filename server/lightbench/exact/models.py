"""Lighting models in float64, each as brdf times cosine: see `over_cosine`."""
# ruff: noqa: E741  (l is the direction to the light)

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from lightbench.exact.directions import (
    GRAZING_COS,
    Array,
    Material,
    column,
    dot,
    half_vector,
    unit,
)
from lightbench.exact.facets import (
    DISTRIBUTIONS,
    FRESNELS,
    VISIBILITIES,
    alpha_from_roughness,
)


def above(l: Array, v: Array) -> Array:
    """1 where light from l can be seen from v, else 0; (N, 1)."""
    return np.where(column((l[..., 2] > 0.0) & (v[..., 2] >= 0.0)), 1.0, 0.0)


def lambert(m: Material, l: Array, v: Array) -> Array:
    """base / pi."""
    return above(l, v) * m["base_color"] / math.pi


def phong_cos(m: Material, l: Array, v: Array) -> Array:
    """kd NoL + ks max(0, r.v)^s, r the mirrored l: Phong 1975, p. 315."""
    r = unit(l) * [-1.0, -1.0, 1.0]
    lobe = np.maximum(dot(r, unit(v)), 0.0) ** m["shininess"]
    return above(l, v) * (m["kd"] * column(unit(l)[..., 2]) + m["ks"] * column(lobe))


def blinn_phong_cos(m: Material, l: Array, v: Array) -> Array:
    """kd NoL + ks max(0, n.h)^s: Blinn 1977, p. 193."""
    lobe = np.maximum(half_vector(l, v)[..., 2], 0.0) ** m["shininess"]
    return above(l, v) * (m["kd"] * column(unit(l)[..., 2]) + m["ks"] * column(lobe))


def lab_cos(m: Material, l: Array, v: Array) -> Array:
    """kd [n.l] + ks [n.h]^s where n.l > 0.001, a cosine up to 0.001 being none."""
    up = half_vector(l, v)[..., 2]
    lobe = np.where(up > 1e-3, np.maximum(up, 1e-3) ** m["shininess"], 0.0)
    lit = m["kd"] * l[..., 2:] + m["ks"] * column(lobe)
    return np.where(l[..., 2:] > 1e-3, lit, 0.0)


Color = tuple[float, float, float]


def tone_level(cosine: Array, tones: float = 2) -> Array:
    """min(floor(cos n), n - 1): of n tones, that of one light."""
    return np.asarray(np.clip(np.floor(cosine * tones), 0.0, tones - 1.0))


def toned(
    m: Material,
    mean: Array,
    tones: float = 2,
    toon_dark: Color = (0.2, 0.25, 0.4),
    toon_lit: Color = (1.0, 1.0, 1.0),
) -> Array:
    """The colour of the mean tone rounded, halves down."""
    level = column(np.ceil(mean - 0.5)) / (tones - 1.0)
    dark, lit = (np.array(color, np.float64) for color in (toon_dark, toon_lit))
    return np.asarray(m["base_color"] * ((1.0 - level) * dark + level * lit))


def toon_cos(
    m: Material,
    l: Array,
    v: Array,
    tones: float = 2,
    toon_dark: Color = (0.2, 0.25, 0.4),
    toon_lit: Color = (1.0, 1.0, 1.0),
) -> Array:
    """The colour of one light's tone, over pi: a tone is found from the cosine as it is given."""
    color = toned(m, tone_level(l[..., 2], tones), tones, toon_dark, toon_lit)
    return above(l, v) * color / math.pi


Model = Callable[..., Array]


def over_cosine(model_cos: Model) -> Model:
    """brdf from brdf times cosine; nearer to the horizon than GRAZING_COS divided by that."""

    def brdf(m: Material, l: Array, v: Array, **settings: Any) -> Array:
        return model_cos(m, l, v, **settings) / column(np.maximum(unit(l)[..., 2], GRAZING_COS))

    return brdf


def over_base(m: Material, F: Array, facets: Array) -> Array:
    """(1 - F) (1 - metalness) base / pi + facets."""
    return (1.0 - F) * (1.0 - column(m["metalness"])) * m["base_color"] / math.pi + facets


def blend_with_base(m: Material, facets: Array) -> Array:
    """Base and facets mixed by metalness, which is at least 0.005."""
    share = np.maximum(column(m["metalness"]), 0.005)
    return (1.0 - share) * m["base_color"] / math.pi + share * facets


def cook_torrance(
    m: Material,
    l: Array,
    v: Array,
    distribution: str = "ggx",
    masking: str = "smith_ggx",
    fresnel: str = "schlick",
    thesis_blend: bool = False,
) -> Array:
    """D F G / (4 NoL NoV) over a matt base: Walter et al. 2007, eq. 20."""
    h = half_vector(l, v)
    alpha = alpha_from_roughness(m["roughness"])
    F = FRESNELS[fresnel](m, dot(unit(v), h))
    facets = DISTRIBUTIONS[distribution](h, alpha) * VISIBILITIES[masking](l, v, h, alpha)
    lit = F * column(facets)
    return above(l, v) * (blend_with_base(m, lit) if thesis_blend else over_base(m, F, lit))


def cook_torrance_cos(
    m: Material,
    l: Array,
    v: Array,
    distribution: str = "ggx",
    masking: str = "smith_ggx",
    fresnel: str = "schlick",
    thesis_blend: bool = False,
) -> Array:
    """Cook-Torrance times NoL."""
    return cook_torrance(m, l, v, distribution, masking, fresnel, thesis_blend) * l[..., 2:]
