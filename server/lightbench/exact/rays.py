"""Rays through a picture, triangles and mirrors in float64, by linear algebra."""

from __future__ import annotations

import numpy as np

from lightbench.exact.directions import Array

# Share of an edge by which lib/triangle.glsl lets a ray miss.
EDGE = 1e-6


def triangle_hit(origin: Array, direction: Array, v0: Array, e1: Array, e2: Array) -> Array:
    """The t above 0 of o + t d = v0 + u e1 + v e2 with u, v, 1 - u - v no less than -EDGE."""
    system = np.stack(np.broadcast_arrays(-direction, e1, e2), axis=-1)
    flat = np.abs(np.linalg.det(system)) == 0.0
    system = np.where(flat[:, None, None], np.eye(3), system)
    t, u, v = np.moveaxis(np.linalg.solve(system, (origin - v0)[..., None])[..., 0], -1, 0)
    found = (np.minimum(u, v) >= -EDGE) & (u + v <= 1.0 + EDGE) & (t > 0.0) & ~flat
    return np.where(found, t, -1.0)


def along_edges(offset: Array, e1: Array, e2: Array) -> Array:
    """The u and v for which u e1 + v e2 is nearest to a vector: by the pseudo-inverse."""
    edges = np.stack(np.broadcast_arrays(e1, e2), axis=-1)
    return np.asarray((np.linalg.pinv(edges) @ offset[..., None])[..., 0])


def through_picture(at: Array, right: Array, up: Array, forward: Array) -> Array:
    """x right + y up + forward."""
    return np.asarray(np.einsum("nk,nkc->nc", at, np.stack([right, up], axis=1)) + forward)


def mirrored(direction: Array, n: Array) -> Array:
    """The Householder reflection of a direction."""
    across = np.eye(3) - 2.0 * n[:, :, None] * n[:, None, :]
    return np.asarray((across @ direction[..., None])[..., 0])
