"""The lab's camera and intersections in float64: equations (1.7)-(1.33) and the reflected ray.

Rays are rows: origins and directions (N, 3). A distance t counts in lengths of the direction.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from lightbench.exact.directions import Array, dot, unit
from tests.lab.tables import Camera, Shape, Sphere, Triangle

# How far outside of an edge, in barycentric units, still counts as on it: rounding of float64.
ON_EDGE = 1e-12


def matrix(
    camera: Camera,
    *,
    fov: Literal["horizontal", "vertical"] = "horizontal",
    handed: Literal["left", "right"] = "left",
    pi: float = math.pi,
) -> Array:
    """[u v o] of (1.7)-(1.11), (3, 3): pixel coordinates to a direction. `right` mirrors u."""
    look = np.subtract(camera.look_at, camera.eye)
    u = unit(np.cross(camera.up, look))
    v = unit(np.cross(u, look))
    if handed == "right":
        u = -u
    across = camera.width if fov == "horizontal" else camera.height
    focal = across / (2.0 * math.tan(camera.fov * pi / 180.0 / 2.0))
    o = unit(look) * focal - (camera.width / 2.0 * u + camera.height / 2.0 * v)
    return np.stack([u, v, o], axis=1)


def through(projection: Array, x: Array | float, y: Array | float) -> Array:
    """Unit directions (..., 3) through points of the picture, pixel centres at + 0.5 (1.16)."""
    points = np.stack(np.broadcast_arrays(x, y, 1.0), axis=-1)
    return unit(points @ projection.T)


def pixels(camera: Camera, projection: Array) -> Array:
    """Unit directions (H * W, 3), row 0 at the top."""
    x, y = np.meshgrid(np.arange(camera.width) + 0.5, np.arange(camera.height) + 0.5)
    return through(projection, x, y).reshape(-1, 3)


def _sphere(origin: Array, direction: Array, sphere: Sphere, eps: float) -> Array:
    """The smaller root of (1.27) above eps, or inf."""
    from_center = origin - np.asarray(sphere.center, float)
    a = dot(direction, direction)
    b = 2.0 * dot(from_center, direction)
    c = dot(from_center, from_center) - sphere.radius**2
    discriminant = b * b - 4.0 * a * c
    root = np.sqrt(np.maximum(discriminant, 0.0))
    near, far = (-b - root) / (2.0 * a), (-b + root) / (2.0 * a)
    first = np.where(near > eps, near, far)
    return np.where((discriminant >= 0.0) & (first > eps), first, np.inf)


def _triangle(
    origin: Array, direction: Array, triangle: Triangle, eps: float, two_sided: bool
) -> Array:
    """Where the plane is met, if within the triangle or on its edge, from either side; or inf."""
    v0 = np.asarray(triangle.v0, float)
    e1, e2 = np.subtract(triangle.v1, v0), np.subtract(triangle.v2, v0)
    p = np.cross(direction, e2)
    determinant = dot(p, e1)
    meets = np.abs(determinant) > ON_EDGE
    if not two_sided:
        meets &= determinant > 0.0
    scale = 1.0 / np.where(meets, determinant, 1.0)
    from_v0 = origin - v0
    q = np.cross(from_v0, e1)
    b1, b2 = dot(from_v0, p) * scale, dot(direction, q) * scale
    inside = (b1 >= -ON_EDGE) & (b2 >= -ON_EDGE) & (b1 + b2 <= 1.0 + ON_EDGE)
    t = dot(np.broadcast_to(e2, q.shape), q) * scale
    return np.where(meets & inside & (t > eps), t, np.inf)


def intersect(
    origin: Array, direction: Array, shape: Shape, eps: float = 1e-4, two_sided: bool = True
) -> Array:
    """The first t above eps at which each ray meets the shape, or inf."""
    if isinstance(shape, Sphere):
        return _sphere(origin, direction, shape, eps)
    return _triangle(origin, direction, shape, eps, two_sided)


def normals(shape: Shape, points: Array) -> Array:
    """Unit normals (N, 3) of (1.34) and (1.39), turned to nobody."""
    if isinstance(shape, Sphere):
        return unit(points - np.asarray(shape.center, float))
    n = unit(np.cross(np.subtract(shape.v1, shape.v0), np.subtract(shape.v2, shape.v0)))
    return np.broadcast_to(n, points.shape)


def reflected(direction: Array, normal: Array) -> Array:
    """normalise(v - 2 (v.n) n)."""
    return unit(direction - 2.0 * dot(direction, normal)[..., None] * normal)
