"""Where a picture of the lab has edges: pixels in which float32 may fall on the other side.

An edge is where what neighbouring pixels saw differs, directly or in a mirror. Triangles of one
plane and one material are one surface: nothing may show where they join, so that is no edge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lightbench.exact.directions import dot, unit
from tests.lab.tables import Scene, Triangle

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]


def surfaces(scene: Scene) -> list[int]:
    """For each object the first one that it is one surface with."""
    keys: list[object] = []
    for k, shape in enumerate(scene.objects):
        key: object = k
        if isinstance(shape, Triangle):
            n = unit(np.cross(np.subtract(shape.v1, shape.v0), np.subtract(shape.v2, shape.v0)))
            plane = np.round([*n, float(dot(n, np.asarray(shape.v0)))], 9) + 0.0
            key = (*plane.tolist(), shape.material)
        keys.append(key)
    return [keys.index(key) for key in keys]


def near_change(labels: NDArray[np.generic], pixels: int = 1) -> Bools:
    """Where a label (H, W) differs from one at most `pixels` away, diagonals too."""
    height, width = labels.shape
    near = np.zeros(labels.shape, np.bool_)
    padded = np.pad(labels, pixels, mode="edge")
    for row in range(2 * pixels + 1):
        for col in range(2 * pixels + 1):
            near |= padded[row : row + height, col : col + width] != labels
    return near


def _any_near_change(planes: Ints, pixels: int) -> Bools:
    near: Bools = np.any([near_change(plane, pixels) for plane in planes], axis=0)
    return near


@dataclass(frozen=True)
class Ids:
    """What each pixel's ray met, (bounces + 1, H, W): the surface (-1 for none), how each light
    stands there (base 3, one digit a light) and whether its texel is a dark one."""

    surface: Ints
    lights: Ints
    texel: Ints

    @staticmethod
    def of_misses(rays: int, height: int, width: int) -> Ids:
        """Rays that met nothing."""
        shape = (rays, height, width)
        return Ids(np.full(shape, -1), np.zeros(shape, np.int64), np.zeros(shape, np.int64))

    def put(self, ray: int, pixel: Ints, surface: int, lights: Ints, texel: Ints) -> None:
        """Notes what the rays of these pixels, counted row by row, met."""
        row, col = np.unravel_index(pixel, self.surface.shape[1:])
        self.surface[ray, row, col] = surface
        self.lights[ray, row, col] = lights
        self.texel[ray, row, col] = texel

    def silhouettes(self, pixels: int = 1) -> Bools:
        """Near the outline of a surface, seen directly or mirrored (H, W)."""
        return _any_near_change(self.surface, pixels)

    def shadow_edges(self, pixels: int = 1) -> Bools:
        """Near the end of a shadow or of the side that faces a light (H, W)."""
        return _any_near_change(self.lights, pixels)

    def texture_edges(self, pixels: int = 1) -> Bools:
        """Near the border of two cells of the texture (H, W)."""
        return _any_near_change(self.texel, pixels)

    def edges(self, pixels: int = 1) -> Bools:
        """Near any of them (H, W)."""
        return self.silhouettes(pixels) | self.shadow_edges(pixels) | self.texture_edges(pixels)
