"""What the views show, in float64: of a surface, of a light's answer, and as display code."""
# ruff: noqa: E741  (l is the direction to the light)

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from lightbench.exact import models
from lightbench.exact.directions import Array, Material, column, dot, half_vector, unit
from lightbench.exact.display import TONEMAPS, TRANSFERS, display_range
from lightbench.exact.facets import DISTRIBUTIONS, FRESNELS, MASKINGS, alpha_from_roughness
from lightbench.exact.light import constant_ambient, no_ambient

AMBIENTS: dict[str, Callable[..., Array]] = {"constant": constant_ambient, "none": no_ambient}
MODELS: dict[str, Callable[..., Array]] = {
    "blinn_phong": models.over_cosine(models.blinn_phong_cos),
    "cook_torrance": models.cook_torrance,
    "lab": models.over_cosine(models.lab_cos),
    "lambert": models.lambert,
    "phong": models.over_cosine(models.phong_cos),
    "toon": models.over_cosine(models.toon_cos),
}

# Of the whole picture


def light_view(radiance: Array, tonemap: str = "none", transfer: str = "srgb") -> Array:
    """Light, as in the final picture but for the exposure."""
    return TRANSFERS[transfer](TONEMAPS[tonemap](radiance))


def color_view(radiance: Array, transfer: str = "srgb") -> Array:
    """A colour."""
    return TRANSFERS[transfer](display_range(radiance))


def signed_view(vector: Array) -> Array:
    """-1 to 1 as 0 to 1."""
    return display_range(0.5 + 0.5 * vector)


def component_view(index: int) -> Callable[[Array], Array]:
    """One component, -1 to 1 as 0 to 1 of its own channel."""

    def view(vector: Array) -> Array:
        return signed_view(np.where(np.arange(3) == index, vector[..., index : index + 1], -1.0))

    return view


def depth_view(radiance: Array, depth_range: float | Array = 10.0) -> Array:
    """White near, black from depth_range on; 0, where nothing was drawn, is far."""
    d = np.where(radiance[..., 0] > 0.0, radiance[..., 0], depth_range)
    return display_range(np.repeat(column(1.0 - d / depth_range), 3, axis=-1))


def heat(share: Array) -> Array:
    """Black, blue, green, yellow, red at 0, 1/4 ... 1, and straight lines between."""
    stops = np.linspace(0.0, 1.0, 5)
    colors = np.array([[0, 0, 0], [0, 0, 1], [0, 1, 0], [1, 1, 0], [1, 0, 0]], float)
    return np.stack([np.interp(share, stops, channel) for channel in colors.T], axis=-1)


def overdraw_view(radiance: Array, overdraw_range: float | Array = 8.0) -> Array:
    """The count as heat."""
    return heat(radiance[..., 0] / overdraw_range)


# Of a surface


def field(name: str) -> Callable[[Material], Array]:
    """A field of the material, as a colour."""

    def inspect(m: Material) -> Array:
        return m[name] if m[name].ndim > 1 else np.repeat(column(m[name]), 3, axis=-1)

    return inspect


def ambient(m: Material, ambient: str = "constant") -> Array:
    """What the ambient choice adds."""
    return AMBIENTS[ambient](m)


def seen(visibility: Array) -> Array:
    """The visibility, grey."""
    return np.repeat(column(visibility), 3, axis=-1)


# Of a light's answer


def without_base(m: Material) -> Material:
    """The material, black below its surface."""
    return {**m, "base_color": 0.0 * m["base_color"], "kd": 0.0 * m["kd"]}


def whole(m: Material, l: Array, v: Array, model: str = "cook_torrance", **given: Any) -> Array:
    """All that the model answers, times the cosine."""
    return np.asarray(MODELS[model](m, l, v, **given) * np.maximum(l[..., 2:], 0.0))


def diffuse(m: Material, l: Array, v: Array, **given: Any) -> Array:
    """What a black base takes from it."""
    return np.maximum(whole(m, l, v, **given) - whole(without_base(m), l, v, **given), 0.0)


def specular(m: Material, l: Array, v: Array, **given: Any) -> Array:
    """The rest."""
    return np.maximum(whole(m, l, v, **given) - diffuse(m, l, v, **given), 0.0)


def _of_facets(term: Callable[..., Array]) -> Callable[..., Array]:
    """A term of l, v and their half vector, grey unless coloured; 0 for a viewer below."""

    def answer(m: Material, l: Array, v: Array, **given: str) -> Array:
        found = term(m, l, v, half_vector(l, v), **given)
        found = found if found.ndim > 1 else np.repeat(column(found), 3, axis=-1)
        return np.where(v[..., 2:] > 0.0, found, 0.0)

    return answer


def _distribution(m: Material, l: Array, v: Array, h: Array, distribution: str = "ggx") -> Array:
    return DISTRIBUTIONS[distribution](h, alpha_from_roughness(m["roughness"]))


def _masking(m: Material, l: Array, v: Array, h: Array, masking: str = "smith_ggx") -> Array:
    return MASKINGS[masking](l, v, h, alpha_from_roughness(m["roughness"]))


def _fresnel(m: Material, l: Array, v: Array, h: Array, fresnel: str = "schlick") -> Array:
    return FRESNELS[fresnel](m, dot(unit(v), h))


distribution_term = _of_facets(_distribution)
masking_term = _of_facets(_masking)
fresnel_term = _of_facets(_fresnel)

VIEWS: dict[str, Callable[..., Array]] = {
    "ambient": light_view,
    "base_color": color_view,
    "depth": depth_view,
    "diffuse": light_view,
    "dir_x": component_view(0),
    "dir_y": component_view(1),
    "dir_z": component_view(2),
    "distribution": light_view,
    "fresnel": display_range,
    "light_depth": display_range,
    "masking": display_range,
    "metalness": display_range,
    "normal": signed_view,
    "overdraw": overdraw_view,
    "roughness": display_range,
    "shadow": display_range,
    "specular": light_view,
    "tangent": signed_view,
    "uv": display_range,
}
HOOKS: dict[tuple[str, str], Callable[..., Array]] = {
    ("ambient", "inspect"): ambient,
    ("base_color", "inspect"): field("base_color"),
    ("diffuse", "reflected"): diffuse,
    ("distribution", "term"): distribution_term,
    ("fresnel", "term"): fresnel_term,
    ("masking", "term"): masking_term,
    ("metalness", "inspect"): field("metalness"),
    ("normal", "inspectNormal"): lambda n: n,
    ("roughness", "inspect"): field("roughness"),
    ("shadow", "seen"): seen,
    ("specular", "reflected"): specular,
}
