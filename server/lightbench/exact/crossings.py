"""Where rays cross surfaces, in float64.

A body is convex: what a ray crosses of its surface, (N, k) with NaN for what it does not, is where
it enters and where it leaves. Distances are in lengths of the direction; -1 is none.
"""

from __future__ import annotations

import numpy as np

from lightbench.exact.directions import Array, column, dot


def first(distances: Array) -> Array:
    """The least of each row, or -1."""
    least = np.where(np.isnan(distances), np.inf, distances).min(axis=-1)
    return np.where(np.isfinite(least), least, -1.0)


def entered(crossings: Array) -> Array:
    """Where a body is entered, if that is in front of the origin."""
    distance = first(crossings)
    return np.where(distance > 0.0, distance, -1.0)


def left(crossings: Array) -> Array:
    """Where a body is left, if that is in front of the origin."""
    last = np.where(np.isnan(crossings), -np.inf, crossings).max(axis=-1)
    return np.where(last > 0.0, last, -1.0)


def quadric(form: Array, origin: Array, direction: Array, level: float) -> Array:
    """Both roots t of form((o + t d)^2) = level, (N, 2): companion matrices, one a row."""
    a, b = dot(form * direction, direction), 2.0 * dot(form * origin, direction)
    c = dot(form * origin, origin) - level
    companion = np.zeros((len(b), 2, 2))
    companion[:, 0, 0], companion[:, 0, 1], companion[:, 1, 0] = -b / a, -c / a, 1.0
    roots = np.linalg.eigvals(companion)
    return np.where(np.abs(roots.imag) == 0.0, roots.real, np.nan)


def across(origin: Array, direction: Array, n: Array, level: float) -> Array:
    """Where a ray crosses the plane n.p = level; NaN for one along it."""
    speed = dot(np.broadcast_to(n, direction.shape), direction)
    gap = level - dot(np.broadcast_to(n, origin.shape), origin)
    return np.where(speed == 0.0, np.nan, gap / np.where(speed == 0.0, 1.0, speed))


def points(origin: Array, direction: Array, t: Array) -> Array:
    """The points (N, k, 3) of rays at distances (N, k)."""
    return np.asarray(origin[:, None] + t[..., None] * direction[:, None])


# Longitude


def east(p: Array) -> Array:
    """The derivative of a point by its angle about y, from z to x; x on the axis."""
    about = np.cross([0.0, 1.0, 0.0], p)
    return np.where(column(np.hypot(p[:, 0], p[:, 2]) > 1e-12), about, [1.0, 0.0, 0.0])


def turn(p: Array) -> Array:
    """The share of a turn about y, from z to x, -1/2 to 1/2."""
    return np.angle(p[..., 2] + 1j * p[..., 0]) / (2.0 * np.pi)
