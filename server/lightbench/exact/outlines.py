"""Outlines in float64: the Sobel operator, and lines in a plane."""

from __future__ import annotations

import numpy as np

from lightbench.exact.directions import Array, dot

# Gonzalez & Wintz, Digital Image Processing; rows from the top.
ACROSS = np.array([[-1.0, 0.0, 1.0], [-2.0, 0.0, 2.0], [-1.0, 0.0, 1.0]])
DOWN = -ACROSS.T


def sobel(
    nw: Array, n: Array, ne: Array, w: Array, e: Array, sw: Array, s: Array, se: Array
) -> Array:
    """|gx| + |gy| of the values about a pixel, each (N, K)."""
    grid = np.array([[nw, n, ne], [w, 0.0 * n, e], [sw, s, se]])
    gx, gy = (np.einsum("ij,ij...->...", kernel, grid) for kernel in (ACROSS, DOWN))
    return np.asarray(np.abs(gx) + np.abs(gy))


def unlined(pixel: Array) -> Array:
    """0."""
    return np.zeros(len(pixel))


def segment_distance(q: Array, h: Array) -> Array:
    """Distance of q to the points t h, t from -1 to 1."""
    t = np.clip(dot(q, h) / dot(h, h), -1.0, 1.0)
    return np.asarray(np.linalg.norm(q - t[..., None] * h, axis=-1))


def square_distance(q: Array, x: Array, y: Array) -> Array:
    """Distance of q to the four edges between the corners +-x +-y."""
    edges = [segment_distance(q + side * y, x) for side in (-1.0, 1.0)]
    edges += [segment_distance(q + side * x, y) for side in (-1.0, 1.0)]
    return np.asarray(np.minimum.reduce(edges))


def circle_distance(q: Array, x: Array) -> Array:
    """Distance of q to the circle of radius |x|."""
    return np.asarray(np.abs(np.linalg.norm(q, axis=-1) - np.linalg.norm(x, axis=-1)))


def stroke_coverage(distance: Array, width: Array) -> Array:
    """A ramp of one pixel about half the width."""
    return np.clip(width / 2.0 - distance + 0.5, 0.0, 1.0)
