"""Directions in the shading frame, in float64; z is the normal."""
# ruff: noqa: E741  (l is the direction to the light)

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Material = Mapping[str, Array]

GRAZING_COS = 1e-7  # lib/constants.glsl: lowest cosine that is divided by
HORIZON = 1e-100  # a cosine so small that float64 gives the limit for 0 to all digits


def unit(w: Array) -> Array:
    """The vectors (N, 3) with length 1."""
    length: Array = np.linalg.norm(w, axis=-1, keepdims=True)
    return w / length


def dot(a: Array, b: Array) -> Array:
    """Scalar products of the rows, (N,)."""
    return np.asarray(np.sum(a * b, axis=-1))


def column(x: NDArray[Any]) -> Array:
    """(N,) as (N, 1), to multiply colours."""
    wide: Array = x[..., None]
    return wide


def half_vector(l: Array, v: Array) -> Array:
    """(l + v) / |l + v|, and the normal for l = -v."""
    s = l + v
    length = np.linalg.norm(s, axis=-1, keepdims=True)
    opposite = length < 1e-15
    return np.where(opposite, [0.0, 0.0, 1.0], s / np.where(opposite, 1.0, length))


def unit_normal(n: Array, fallback: Array) -> Array:
    """n / |n|, and the fallback for a normal shorter than 1e-10."""
    length = np.linalg.norm(n, axis=-1, keepdims=True)
    return np.where(length > 1e-10, n / np.maximum(length, 1e-300), fallback)


def facing_normal(n: Array, v: Array) -> Array:
    """The reflection of n across the plane normal to v where n faces away from v."""
    away = dot(n, v) < 0.0
    return np.where(column(away), n - 2.0 * column(dot(n, v)) * v, n)


def unpacked_normal(rgb: Array, scale: Array) -> Array:
    """A normal map's vector, 128 / 255 being 0, x and y scaled: glTF 2.0, 3.9.3."""
    s = (rgb * 255.0 - 128.0) / 127.0
    return np.concatenate([column(scale) * s[..., :2], s[..., 2:]], axis=-1)


def mapped_normal(n: Array, tangent: Array, rgb: Array, scale: Array) -> Array:
    """x t + y w (n x t) + z n, nothing made unit: MikkTSpace."""
    s = unpacked_normal(rgb, scale)
    t, b = tangent[..., :3], tangent[..., 3:] * np.cross(n, tangent[..., :3])
    return np.asarray(s[..., :1] * t + s[..., 1:2] * b + s[..., 2:] * n)
