"""Where objects are: bounding spheres for what is in sight, extents for fitting a light's map."""

import math
from collections.abc import Iterable, Sequence

from lightbench import matrix
from lightbench.placement import corners, model_matrix
from lightbench.scene import Object, Scene

__all__ = ["bounding_sphere", "distance", "extent", "farthest", "fit"]

Vector = Sequence[float]

# Centre and half size of the box about each shape, in its own axes.
BOXES: dict[str, tuple[Vector, Vector]] = {
    "plane": ((0, 0, 0), (0.5, 0, 0.5)),
    "cube": ((0, 0, 0), (0.5, 0.5, 0.5)),
    "sphere": ((0, 0, 0), (1, 1, 1)),
    "cone": ((0, 0.5, 0), (1, 0.5, 1)),
}
# Radius of the sphere about the origin of each shape that contains it.
RADII = {"plane": math.sqrt(0.5), "cube": math.sqrt(0.75), "sphere": 1.0, "cone": 1.0}


def _box(scene: Scene, thing: Object) -> tuple[Vector, Vector]:
    if thing.mesh is None:
        return BOXES[thing.shape]
    asset = scene.meshes[thing.mesh]
    pairs = list(zip(asset.low, asset.high, strict=True))
    return [(a + b) / 2 for a, b in pairs], [(b - a) / 2 for a, b in pairs]


def bounding_sphere(scene: Scene, thing: Object) -> tuple[Vector, float]:
    """(centre, radius) of a sphere that contains the object, in metres."""
    largest = max(thing.scale)
    if thing.shape == "triangle":
        return _sphere_about(*corners(thing, (0, 0, 0)))
    if thing.mesh is None:
        return thing.position, RADII[thing.shape] * largest
    center, half = _box(scene, thing)
    model = model_matrix(thing, (0, 0, 0))
    return matrix.transform(model, center), math.sqrt(matrix.dot(half, half)) * largest


def _sphere_about(a: Vector, b: Vector, c: Vector) -> tuple[Vector, float]:
    center = [(a[i] + b[i] + c[i]) / 3 for i in range(3)]
    offsets = [matrix.subtract(p, center) for p in (a, b, c)]
    return center, max(math.sqrt(matrix.dot(o, o)) for o in offsets)


def distance(scene: Scene, thing: Object, point: Vector) -> float:
    """From a point to the middle of an object."""
    offset = matrix.subtract(bounding_sphere(scene, thing)[0], point)
    return math.sqrt(matrix.dot(offset, offset))


def _arms(scene: Scene, thing: Object) -> tuple[Vector, list[Vector]]:
    """The centre of an object's box and its three half axes, in the world."""
    center, half = _box(scene, thing)
    model = matrix.compose(thing.position, thing.rotation, thing.scale)
    columns = [model[0:3], model[4:7], model[8:11]]
    arms: list[Vector] = [[c * h for c in column] for column, h in zip(columns, half, strict=True)]
    return matrix.transform(model, center), arms


def extent(scene: Scene, thing: Object, axis: Vector) -> tuple[float, float]:
    """The lowest and the highest coordinate of an object along a unit axis."""
    if thing.shape == "triangle":
        along = [matrix.dot(corner, axis) for corner in corners(thing, (0, 0, 0))]
        return min(along), max(along)
    center, arms = _arms(scene, thing)
    a, b, c = (matrix.dot(arm, axis) for arm in arms)
    round_shape = thing.shape == "sphere"
    half = math.sqrt(a * a + b * b + c * c) if round_shape else abs(a) + abs(b) + abs(c)
    middle = matrix.dot(center, axis)
    return middle - half, middle + half


def fit(scene: Scene, things: Iterable[Object], axis: Vector) -> tuple[float, float]:
    """The extent of several objects together; of none, from -1 to 1."""
    spans = [extent(scene, thing, axis) for thing in things]
    return min((s[0] for s in spans), default=-1.0), max((s[1] for s in spans), default=1.0)


def farthest(scene: Scene, things: Iterable[Object], point: Vector) -> float:
    """The distance from a point that no part of these objects exceeds; of none, 1."""
    return max((_farthest(scene, thing, point) for thing in things), default=1.0)


def _farthest(scene: Scene, thing: Object, point: Vector) -> float:
    if thing.shape == "sphere":
        return distance(scene, thing, point) + max(thing.scale)
    if thing.shape == "triangle":
        return max(math.sqrt(matrix.dot(corner, corner)) for corner in corners(thing, point))
    center, (a, b, c) = _arms(scene, thing)
    offset = matrix.subtract(center, point)
    signs = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    ends = [[offset[i] + x * a[i] + y * b[i] + z * c[i] for i in range(3)] for x, y, z in signs]
    return max(math.sqrt(matrix.dot(corner, corner)) for corner in ends)
