"""The lab's ray tracer in float64, written from its script: what the GPU's picture is held to.

No offset of a ray's origin is needed here: float64 meets the surface it left again within 1e-13,
far below `eps`. Sentences of the script that can be read in two ways are fields of `Reading`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lightbench.exact.directions import Array, column, dot, unit
from tests.lab.edges import Ids, surfaces
from tests.lab.geometry import intersect, matrix, normals, pixels, reflected
from tests.lab.tables import Light, Material, Scene, Shape
from tests.lab.texture import look_up

Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]

MISS = -1
# How a light stands to a surface, in the ids.
AWAY, SHADOWED, LIT = 0, 1, 2


@dataclass(frozen=True)
class Reading:
    """How the script is read. The defaults are what the lab means."""

    fov: Literal["horizontal", "vertical"] = "horizontal"
    handed: Literal["left", "right"] = "left"
    pi: float = math.pi
    two_sided: bool = True
    turn_normals: bool = False  # towards the ray
    ambient: Literal["per light", "first light"] = "per light"
    cos_threshold: float = 1e-3
    shadows: bool = True
    shadows_end_at_light: bool = True
    mapping: Literal["lab", "sphere"] = "lab"
    bounces: int = 1
    min_energy: float = 0.01
    mirror_keeps: Literal["all", "the rest"] = "all"  # of its own shading: all, or 1 - reflectance
    eps: float = 1e-4


SCRIPT = Reading()


@dataclass(frozen=True)
class Rays:
    """Origins and directions (N, 3), the energy each carries (N,) and its pixel (N,)."""

    origin: Array
    direction: Array
    energy: Array
    pixel: Ints

    def __getitem__(self, rows: Ints | Bools) -> Rays:
        return Rays(self.origin[rows], self.direction[rows], self.energy[rows], self.pixel[rows])


@dataclass(frozen=True)
class Traced:
    """A picture (H, W, 3), linear and unclamped, and what each pixel saw."""

    linear: Array
    ids: Ids


def _nearest(scene: Scene, rays: Rays, reading: Reading) -> tuple[Array, Ints]:
    """Distance to the first hit of each ray and which object it is; inf and MISS for none. Of
    objects at the same distance the first in the list counts."""
    t = np.full(len(rays.pixel), np.inf)
    index = np.full(len(rays.pixel), MISS)
    for k, shape in enumerate(scene.objects):
        here = intersect(rays.origin, rays.direction, shape, reading.eps, reading.two_sided)
        closer = here < t
        t[closer], index[closer] = here[closer], k
    return t, index


def _in_shadow(scene: Scene, points: Array, light: Light, reading: Reading) -> Bools:
    """Whether anything stands between the points and the light."""
    towards = np.asarray(light.position) - points
    reach = np.linalg.norm(towards, axis=-1) if reading.shadows_end_at_light else np.inf
    blocked = np.zeros(len(points), np.bool_)
    for shape in scene.objects if reading.shadows else ():
        blocked |= intersect(points, unit(towards), shape, reading.eps, reading.two_sided) < reach
    return blocked


def _light(m: Material, light: Light, n: Array, v: Array, points: Array, cut: float) -> Array:
    """I_dif + I_spec of (1.44)-(1.48) at lit points; the highlight where n.h is above `cut`."""
    towards = unit(np.asarray(light.position) - points)
    both = towards + v
    length = np.linalg.norm(both, axis=-1)
    cos_half = dot(n, both) / np.where(length > 0.0, length, 1.0)  # no highlight for l = -v
    diffuse = np.asarray(m.diffuse) * column(dot(n, towards))
    glossy = cos_half > cut
    power = np.where(glossy, cos_half, 0.0) ** m.shininess
    specular = np.asarray(m.specular) * column(np.where(glossy, power, 0.0))
    return np.asarray(light.color) * (diffuse + specular)


def _shade(
    scene: Scene, shape: Shape, points: Array, direction: Array, reading: Reading
) -> tuple[Array, Ints, Ints]:
    """One object's colour at points of it, how each light stands there, and the texel's cell."""
    m = shape.material
    n = normals(shape, points)
    if reading.turn_normals:
        n = np.where(column(dot(n, direction) > 0.0), -n, n)
    color = np.zeros_like(points)
    standing = np.zeros(len(points), np.int64)
    for k, light in enumerate(scene.lights):
        if k == 0 or reading.ambient == "per light":
            color += np.multiply(m.ambient, light.color)
        faces = dot(n, unit(np.asarray(light.position) - points)) > reading.cos_threshold
        lit = faces & ~_in_shadow(scene, points, light, reading)
        color[lit] += _light(m, light, n[lit], -direction[lit], points[lit], reading.cos_threshold)
        standing += 3**k * np.where(lit, LIT, np.where(faces, SHADOWED, AWAY))
    cells = np.zeros(len(points), np.int64)
    if m.textured:
        texels = look_up(n, reading.mapping)
        color *= column(texels)
        cells = (texels < 1.0).astype(np.int64)
    if scene.flat is not None:
        color[:] = scene.flat
    return color, standing, cells


def _mirrored(shape: Shape, rays: Rays, points: Array, reading: Reading) -> Rays:
    """What goes on from a mirror; nothing from any other surface."""
    reflectance = shape.material.reflectance
    on = (rays.energy > reading.min_energy) & (reflectance > 0.0)
    rays, points = rays[on], points[on]
    onward = reflected(rays.direction, normals(shape, points))
    return Rays(points, onward, rays.energy * reflectance, rays.pixel)


def _join(parts: list[Rays]) -> Rays:
    return Rays(
        np.concatenate([part.origin for part in parts]),
        np.concatenate([part.direction for part in parts]),
        np.concatenate([part.energy for part in parts]),
        np.concatenate([part.pixel for part in parts]),
    )


def primary_rays(scene: Scene, reading: Reading = SCRIPT) -> Rays:
    """One ray through each pixel's centre, row by row from the top."""
    projection = matrix(scene.camera, fov=reading.fov, handed=reading.handed, pi=reading.pi)
    direction = pixels(scene.camera, projection)
    origin = np.broadcast_to(np.asarray(scene.camera.eye, float), direction.shape)
    return Rays(origin, direction, np.ones(len(direction)), np.arange(len(direction)))


def trace(scene: Scene, reading: Reading = SCRIPT) -> Traced:
    """The scene's picture, before over-saturation, gamma and quantisation."""
    height, width = scene.camera.height, scene.camera.width
    rays = primary_rays(scene, reading)
    color = np.zeros((height * width, 3))
    ids = Ids.of_misses(reading.bounces + 1, height, width)
    groups = surfaces(scene)
    for bounce in range(reading.bounces + 1):
        t, index = _nearest(scene, rays, reading)
        if bounce == 0:
            color[index == MISS] = scene.background
        onward = []
        for k, shape in enumerate(scene.objects):
            here = rays[index == k]
            points = here.origin + column(t[index == k]) * here.direction
            local, standing, cells = _shade(scene, shape, points, here.direction, reading)
            keeps = 1.0 - shape.material.reflectance * (reading.mirror_keeps == "the rest")
            color[here.pixel] += column(here.energy) * keeps * local
            ids.put(bounce, here.pixel, groups[k], standing, cells)
            onward.append(_mirrored(shape, here, points, reading))
        rays = _join(onward)
    return Traced(color.reshape(height, width, 3), ids)
