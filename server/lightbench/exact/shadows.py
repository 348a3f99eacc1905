"""Shadow maps in float64: biases, faces of a cube, points of a disk."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lightbench.exact.directions import Array, column

GOLDEN_ANGLE = np.pi * (3.0 - np.sqrt(5.0))

# Each face's axis, and what of the direction runs along u and v on it: +x -x +y -y +z -z.
AXES = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
UP = np.array([[0, 1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1], [0, 1, 0], [0, 1, 0]], float)
RIGHT = np.cross(AXES, UP)


def unshadowed(light: Array, receiver: Mapping[str, Array]) -> Array:
    """1."""
    return np.ones(len(receiver["NoL"]))


def constant_bias(
    distance: Array, far: Array, reach: Array, NoL: Array, bias_constant: float = 0.001
) -> Array:
    """The squared share of far less one number."""
    return np.asarray((distance / far) ** 2 - bias_constant)


def slope_bias(distance: Array, reach: Array, NoL: Array) -> Array:
    """reach tan(theta), to 84 degrees, and 1e-4 of the distance: RTR 4th ed., section 7.4.1."""
    theta = np.arccos(np.clip(NoL, 0.1, 1.0))
    return np.asarray(reach * np.tan(theta) + 1e-4 * distance)


def sloped(distance: Array, far: Array, reach: Array, NoL: Array) -> Array:
    """The squared share of far, less the bias by slope, of the distance."""
    return (np.maximum(distance - slope_bias(distance, reach, NoL), 0.0) / far) ** 2


def normal_shift(reach: Array, NoL: Array) -> Array:
    """reach sin(theta): Holbert 2011."""
    return np.asarray(reach * np.sin(np.arccos(np.minimum(NoL, 1.0))))


def cube_face(d: Array) -> Array:
    """(u, v, face) of the face whose axis is nearest; of faces as near, the first."""
    face = np.argmax(np.abs(d), axis=-1) * 2
    axis = np.take_along_axis(d, (face // 2)[..., None], axis=-1)
    face = face + np.where(axis[..., 0] < 0.0, 1, 0)
    away = np.abs(axis[..., 0])
    u, v = (np.sum(d * across[face], axis=-1) / away for across in (RIGHT, UP))
    return np.stack([0.5 + 0.5 * u, 0.5 + 0.5 * v, face], axis=-1)


def cube_direction(at: Array) -> Array:
    """The point of the face's plane at distance 1."""
    face = at[..., 2].astype(int)
    u, v = (column(2.0 * at[..., i] - 1.0) for i in (0, 1))
    return np.asarray(AXES[face] + u * RIGHT[face] + v * UP[face])


def disk_point(i: Array, n: Array) -> Array:
    """sqrt((i + 1/2) / n) at the angle i (3 - sqrt 5) pi: Vogel 1979."""
    radius, angle = np.sqrt((i + 0.5) / n), i * GOLDEN_ANGLE
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
