"""Outlines in float64: the Sobel operator."""

from __future__ import annotations

import numpy as np

from lightbench.exact.directions import Array

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
