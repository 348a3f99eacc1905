"""Rays and the cone |x, z|^2 = (1 - y)^2 from its base at y = 0 to its apex, in float64."""

from __future__ import annotations

import numpy as np

from lightbench.exact.crossings import across, east, entered, first, left, points, quadric, turn
from lightbench.exact.directions import Array, column

# The double cone about the apex as a diagonal quadratic form.
CONE = np.array([1.0, -1.0, 1.0])


def _side_crossings(origin: Array, direction: Array) -> Array:
    """Of the double cone, where it is the side."""
    t = quadric(CONE, origin - [0.0, 1.0, 0.0], direction, 0.0)
    y = points(origin, direction, t)[..., 1]
    return np.where((y >= 0.0) & (y <= 1.0), t, np.nan)


def _base_crossings(origin: Array, direction: Array) -> Array:
    """Of the plane y = 0, where it is the base."""
    t = column(across(origin, direction, np.array([0.0, 1.0, 0.0]), 0.0))
    p = points(origin, direction, t)
    return np.where(np.hypot(p[..., 0], p[..., 2]) <= 1.0, t, np.nan)


def _cone_crossings(origin: Array, direction: Array) -> Array:
    return np.concatenate(
        [_side_crossings(origin, direction), _base_crossings(origin, direction)], axis=-1
    )


def cone_side(origin: Array, direction: Array, side: Array) -> Array:
    """In front of the origin, where the side is met from without (1) or from within (-1)."""
    t = _side_crossings(origin, direction)
    p = points(origin, direction, t)
    outward = np.stack([p[..., 0], 1.0 - p[..., 1], p[..., 2]], axis=-1)
    against = np.sum(outward * direction[:, None], axis=-1) * column(side) < 0.0
    return first(np.where(against & (t > 0.0), t, np.nan))


def cone_base(origin: Array, direction: Array) -> Array:
    """In front of the origin, the base."""
    t = _base_crossings(origin, direction)
    return first(np.where(t > 0.0, t, np.nan))


def cone_hit(origin: Array, direction: Array) -> Array:
    """Into the cone from its base of radius 1 at y = 0 to its apex at y = 1."""
    return entered(_cone_crossings(origin, direction))


def cone_exit(origin: Array, direction: Array) -> Array:
    """Out of it."""
    return left(_cone_crossings(origin, direction))


def on_base(p: Array) -> Array:
    """1 for a point of the surface on the base: it is on the side at the rim alone."""
    return np.where(p[:, 1] < 1.0 - p[:, 1] - np.hypot(p[:, 0], p[:, 2]), 1.0, 0.0)


def cone_normal(p: Array) -> Array:
    """Half the gradient of x^2 + z^2 - (1 - y)^2, up at the apex; down on the base."""
    away = np.stack([p[:, 0], 1.0 - p[:, 1], p[:, 2]], axis=-1)
    away = np.where(column(np.hypot(p[:, 0], p[:, 2]) > 1e-12), away, [0.0, 1.0, 0.0])
    return np.where(column(on_base(p) > 0.0), [0.0, -1.0, 0.0], away)


def cone_tangent(p: Array) -> Array:
    """Around the side; along x on the base."""
    return np.where(column(on_base(p) > 0.0), [1.0, 0.0, 0.0], east(p))


def cone_uv(p: Array) -> Array:
    """u around the side, v down it from the apex; the base as a disk in the image."""
    side = np.stack([turn(p) % 1.0, 1.0 - p[:, 1]], axis=-1)
    base = np.stack([0.5 + 0.5 * p[:, 0], 0.5 - 0.5 * p[:, 2]], axis=-1)
    return np.where(column(on_base(p) > 0.0), base, side)
