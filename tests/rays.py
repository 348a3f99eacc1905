"""Where a picture's pixels look, and what a ray meets: in float64, from the scene's own numbers."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from lightbench.exact.directions import Array, unit
from lightbench.scene import Scene

__all__ = ["plane", "rays", "sphere"]


def rays(scene: Scene, size: Sequence[int]) -> tuple[Array, Array]:
    """Origins and unit directions (H, W, 3) of a camera's pixels, row 0 at the top."""
    camera, (width, height) = scene.camera, size
    eye = np.array(camera.eye, np.float64)
    z = unit(eye - camera.target)
    x = unit(np.cross(camera.up, z))
    y = np.cross(z, x)
    parallel = camera.projection == "orthographic"
    half = camera.height / 2 if parallel else np.tan(np.radians(camera.fov) / 2)
    u = ((np.arange(width) + 0.5) / width * 2 - 1) * half * width / height
    v = (1 - (np.arange(height) + 0.5) / height * 2) * half
    across = u[None, :, None] * x + v[:, None, None] * y
    if parallel:
        return eye + across, np.broadcast_to(-z, across.shape)
    return np.broadcast_to(eye, across.shape), unit(across - z)


def plane(rays: tuple[Array, Array], point: ArrayLike, normal: ArrayLike) -> Array:
    """(H, W) distances along the rays to a plane; infinite where they do not come to it."""
    origin, direction = rays
    toward = direction @ np.asarray(normal, np.float64)
    away = (np.asarray(point) - origin) @ np.asarray(normal, np.float64)
    with np.errstate(divide="ignore"):
        t = away / np.where(toward == 0.0, np.inf, toward)
    return np.where(t > 0.0, t, np.inf)


def sphere(rays: tuple[Array, Array], centre: ArrayLike, radius: float) -> Array:
    """(H, W) distances along the rays to a sphere from outside; infinite where they miss it."""
    origin, direction = rays
    f = np.asarray(centre) - origin
    along = (f * direction).sum(axis=-1)
    inside = radius**2 - (f * f).sum(axis=-1) + along**2
    hit = (inside >= 0.0) & (along > 0.0)
    return np.where(hit, along - np.sqrt(np.maximum(inside, 0.0)), np.inf)
