"""Arguments for the functions of rays and shapes, away from every edge and outline."""

from collections.abc import Callable
from typing import Any

import numpy as np

from lightbench.exact import cone, shapes
from lightbench.exact import rays as exact_rays
from lightbench.exact.directions import Array, unit
from tests.samples import COUNT, Argument, Arguments, Single, single, uniform

Form = Callable[..., Array]

# How much larger and smaller a shape may be without a change in what a ray meets.
MARGIN, STEADY = 1e-3, 0.02

DIRECTIONS = unit(np.random.default_rng(11).normal(size=(COUNT, 3)))
POLES = [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, 0.8], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]]
ROUND = single([*DIRECTIONS, *POLES])
PLANE = single(uniform(-0.5, 0.5, COUNT, 3) * [1.0, 0.0, 1.0])
_AT = uniform(-0.49, 0.49, COUNT, 3)
_FACES = np.arange(COUNT) % 6
CUBE = single(np.where(np.arange(3) == _FACES[:, None] // 2, _FACES[:, None] % 2 - 0.5, _AT))
_RADII = uniform(0.01, 0.98, COUNT)
_ANGLES = 2.0 * np.pi * uniform(0.0, 1.0, COUNT, 1)[:, 0]
_HEIGHTS = np.where(np.arange(COUNT) % 2 == 0, 0.0, 1.0 - _RADII)
CONE = single(
    [*np.c_[_RADII * np.sin(_ANGLES), _HEIGHTS, _RADII * np.cos(_ANGLES)], [0.0, 1.0, 0.0]]
)
SIDES = single(np.resize([1.0, 1.0, -1.0, -1.0, 1.0], 3 * COUNT))


def shots(seed: int, middle: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> tuple[Array, Array]:
    """Origins and directions of any length: towards a shape, away from it, and from within."""
    random = np.random.default_rng(seed)
    out = unit(random.normal(size=(COUNT, 3))) * random.uniform(1.8, 4.0, (COUNT, 1))
    target = random.uniform(-0.8, 0.8, (COUNT, 3))
    within = random.uniform(-0.3, 0.3, (COUNT, 3))
    origin = np.concatenate([out, out, within]) + middle
    direction = np.concatenate([target - out, out - target, DIRECTIONS])
    return origin, direction * 10.0 ** random.uniform(-1.0, 1.0, (3 * COUNT, 1))


def settled(form: Form, origin: Any, *others: Any) -> Arguments:
    """The rows that meet the shape, or miss it, from origins a little to either side too."""
    rows = [single(argument) for argument in (origin, *others)]
    exact = [row.astype(np.float64) for row in rows]
    aside = np.random.default_rng(1).normal(size=exact[0].shape) * MARGIN
    here, *there = (form(exact[0] + k * aside, *exact[1:]) for k in (0.0, 1.0, -1.0))
    kept = np.ones(len(here), bool)
    for other in there:
        kept &= ((here > 0.0) == (other > 0.0)) & (np.abs(other - here) <= STEADY * np.abs(here))
    return tuple(row[kept] for row in rows)


def shot(form: Form, seed: int, *more: Argument, middle: Any = (0.0, 0.0, 0.0)) -> Arguments:
    """Shots at a shape, those near its outline left out."""
    return settled(form, *shots(seed, middle), *more)


def balls() -> Arguments:
    """Unit rays and spheres of any size anywhere."""
    origin, direction = shots(21)
    size = 10.0 ** uniform(-1.0, 1.0, 3 * COUNT)
    centre = uniform(-5.0, 5.0, 3 * COUNT, 3)
    at = single(origin * size[:, None] + centre), single(unit(direction))
    return settled(shapes.sphere_exit, *at, centre, size)


def triangles() -> Arguments:
    """Rays and triangles of any shape; one is a line."""
    origin, direction = shots(22)
    v0, e1, e2 = (uniform(-1.0, 1.0, 3 * COUNT, 3 * k)[:, :3] for k in (1, 2, 3))
    rows = settled(exact_rays.triangle_hit, origin, direction, v0, e1, e2)
    flat = [[0.2, 0.1, 2], [0, 0, -1], [-1, 0, 0], [1, 0, 0], [2, 0, 0]]
    return tuple(np.concatenate([a, single([b])]) for a, b in zip(rows, flat, strict=True))


def edges() -> Arguments:
    """Vectors anywhere, and edges that are not nearly in line."""
    e1, e2, offset = (uniform(-1.0, 1.0, COUNT, 3 * k)[:, :3] for k in (4, 5, 6))
    sine = np.linalg.norm(np.cross(unit(e1), unit(e2)), axis=1)
    kept = (sine > 0.5) & (np.abs(e1).max(axis=1) > 0.2) & (np.abs(e2).max(axis=1) > 0.2)
    return single(offset[kept]), single(e1[kept]), single(e2[kept])


def frames() -> tuple[Single, Single, Single]:
    """Points, and the normals and tangents of a cube's faces."""
    return single(_AT), single(shapes.NORMALS[_FACES]), single(shapes.TANGENTS[_FACES])


APEX = (0.0, 0.4, 0.0)
RAYS: dict[tuple[str, str], Callable[[], Arguments]] = {
    ("cone", "onBase"): lambda: (CONE,),
    ("longitude", "east"): lambda: (ROUND,),
    ("longitude", "longitude"): lambda: (ROUND * single(10.0 ** uniform(-6, 6, len(ROUND), 1)),),
    ("ray", "mirrored"): lambda: (single(DIRECTIONS), single(DIRECTIONS[::-1])),
    ("ray", "throughPicture"): lambda: (
        single(uniform(-1.0, 1.0, COUNT, 2)),
        *(single(uniform(-1.0, 1.0, COUNT, k)[:, :3]) for k in (3, 4, 5))),
    ("cone", "coneBase"): lambda: shot(cone.cone_base, 1),
    ("cone", "coneExit"): lambda: shot(cone.cone_exit, 2, middle=APEX),
    ("cone", "coneHit"): lambda: shot(cone.cone_hit, 3, middle=APEX),
    ("cone", "coneNormal"): lambda: (CONE,),
    ("cone", "coneSide"): lambda: shot(cone.cone_side, 4, SIDES, middle=APEX),
    ("cone", "coneTangent"): lambda: (CONE,),
    ("cone", "coneUv"): lambda: (CONE,),
    ("shapes", "cubeExit"): lambda: shot(shapes.cube_exit, 5),
    ("shapes", "cubeHit"): lambda: shot(shapes.cube_hit, 6),
    ("shapes", "cubeNormal"): lambda: (CUBE,),
    ("shapes", "cubeSpan"): lambda: tuple(single(row) for row in shots(7)),
    ("shapes", "cubeTangent"): lambda: (CUBE,),
    ("shapes", "cubeUv"): lambda: (CUBE,),
    ("shapes", "faceUv"): frames,
    ("shapes", "planeHit"): lambda: shot(shapes.plane_hit, 8, SIDES),
    ("shapes", "planeNormal"): lambda: (PLANE,),
    ("shapes", "planeTangent"): lambda: (PLANE,),
    ("shapes", "planeUv"): lambda: (PLANE,),
    ("shapes", "roundExit"): lambda: shot(shapes.round_exit, 9),
    ("shapes", "roundHit"): lambda: shot(shapes.round_hit, 10),
    ("shapes", "roundNormal"): lambda: (ROUND,),
    ("shapes", "roundTangent"): lambda: (ROUND,),
    ("shapes", "roundUv"): lambda: (ROUND,),
    ("sphere", "sphereExit"): balls,
    ("triangle", "alongEdges"): edges,
    ("triangle", "triangleHit"): triangles,
}  # fmt: skip
