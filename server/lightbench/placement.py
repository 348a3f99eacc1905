"""Where an object's own coordinates lie in the world, as matrices about a point."""

import math
from collections.abc import Sequence

from lightbench import matrix
from lightbench.scene import Object

__all__ = ["corners", "inverse_matrix", "model_matrix", "normal_matrix"]

Vector = Sequence[float]


def corners(thing: Object, origin: Vector) -> list[Vector]:
    """The three corners of a triangle in the world about `origin`."""
    position = matrix.subtract(thing.position, origin)
    whole = matrix.compose(position, thing.rotation, thing.scale)
    return [matrix.transform(whole, corner) for corner in thing.corners or ()]


def _triangle(thing: Object, origin: Vector) -> tuple[Vector, Vector, Vector, Vector]:
    """(first corner, the two edges from it, unit normal); no normal where there is no area."""
    a, b, c = corners(thing, origin)
    first, second = matrix.subtract(b, a), matrix.subtract(c, a)
    across = matrix.cross(first, second)
    length = math.sqrt(matrix.dot(across, across))
    normal = [x / length for x in across] if length > 0 else [0.0, 0.0, 0.0]
    return a, first, second, normal


def model_matrix(thing: Object, origin: Vector) -> list[float]:
    """4x4: from the object's mesh to the world about `origin`."""
    if thing.shape == "triangle":
        a, first, second, normal = _triangle(thing, origin)
        return [*first, 0.0, *second, 0.0, *normal, 0.0, *a, 1.0]
    position = matrix.subtract(thing.position, origin)
    return matrix.compose(position, thing.rotation, thing.scale)


def normal_matrix(thing: Object) -> list[float]:
    """3x3: from normals of the object's mesh to ones in the world, not unit."""
    if thing.shape == "triangle":
        normal = _triangle(thing, (0, 0, 0))[3]
        return [0.0] * 6 + [*normal]
    return matrix.normal_matrix(thing.rotation, thing.scale)


def inverse_matrix(thing: Object, origin: Vector) -> list[float]:
    """4x4: from the world about `origin` to the object's own coordinates."""
    position = matrix.subtract(thing.position, origin)
    r = matrix.rotation(thing.rotation)
    rows = [[r[3 * i + j] / thing.scale[i] for j in range(3)] for i in range(3)]
    columns = [[row[j] for row in rows] + [0.0] for j in range(3)]
    back = [-matrix.dot(row, position) for row in rows]
    return [*columns[0], *columns[1], *columns[2], *back, 1.0]
