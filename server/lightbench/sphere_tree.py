"""A tree of spheres about objects, so that a ray looks closer only at those in its way.

A node is one texel: its sphere's centre and radius. The radius is rounded up to end in as many
zeros as a number has bits, and has that number in their place: of a node about one object, where
the radius is negative, the object's; else how many nodes are from here to the end of all below.
"""

import math
import struct
from collections.abc import Sequence

from lightbench import matrix
from lightbench.errors import SceneError
from lightbench.values import float32

__all__ = ["MOST_OBJECTS", "ROOM", "Sphere", "sphere_tree"]

# Centre and radius: four numbers.
Sphere = Sequence[float]

# Bits of a number, as in shaders/stages/listed.glsl: six of a radius are left, so that it grows by
# 1/32 at most. A tree has a node less than twice its objects.
NUMBER_BITS = 17
MOST_OBJECTS = 2 ** (NUMBER_BITS - 1)
# What a sphere is larger by than what is in it, for what float32 loses of both.
ROOM = 1 + 1e-5
# Least radius: its float is a normal one, whose bits every GL keeps.
SMALLEST = 1e-30


def sphere_tree(spheres: Sequence[Sphere]) -> list[float]:
    """The texels of all nodes, twice as many as objects less one. Raises SceneError.

    Spheres are about the eye, in float32. A node comes before all below it, and what begins nearer
    to the eye before the other: a ray goes on to the next node, or passes over all below.
    """
    if len(spheres) > MOST_OBJECTS:
        raise SceneError(f"rays find {MOST_OBJECTS} objects at most: there are {len(spheres)}")
    return _nodes(spheres, range(len(spheres)))


def _nodes(spheres: Sequence[Sphere], members: Sequence[int]) -> list[float]:
    """The node about spheres by their numbers, and all below it."""
    if len(members) == 1:
        *center, radius = spheres[members[0]]
        return [*center, -_with_number(radius, members[0])]
    center, radius = _around([spheres[i] for i in members])
    first, second = (_nodes(spheres, part) for part in _parts(spheres, members, radius))
    below = second + first if _begins(second) < _begins(first) else first + second
    return [*center, _with_number(radius, 1 + len(below) // 4), *below]


def _parts(
    spheres: Sequence[Sphere], members: Sequence[int], radius: float
) -> tuple[Sequence[int], Sequence[int]]:
    """Those above half of a radius, and the others: a floor is not among what stands on it. Where
    there are not both, halves along the widest axis.
    """
    large = [i for i in members if spheres[i][3] > radius / 2]
    if 0 < len(large) < len(members):
        return large, [i for i in members if spheres[i][3] <= radius / 2]
    axes = [[spheres[i][axis] for i in members] for axis in range(3)]
    widths = [max(axis) - min(axis) for axis in axes]
    widest = widths.index(max(widths))
    along = sorted(members, key=lambda i: spheres[i][widest])
    half = (len(along) + 1) // 2
    return along[:half], along[half:]


def _around(spheres: Sequence[Sphere]) -> tuple[list[float], float]:
    """A sphere about spheres, its centre in float32: from the middle of their box."""
    lows = (min(s[axis] - s[3] for s in spheres) for axis in range(3))
    highs = (max(s[axis] + s[3] for s in spheres) for axis in range(3))
    center = float32((low + high) / 2 for low, high in zip(lows, highs, strict=True))
    return center, ROOM * max(_length(matrix.subtract(s, center)) + s[3] for s in spheres)


def _begins(nodes: Sequence[float]) -> float:
    """How far from the eye the sphere of the first node begins."""
    return _length(nodes) - abs(nodes[3])


def _length(v: Sequence[float]) -> float:
    return math.sqrt(matrix.dot(v, v))


def _with_number(radius: float, number: int) -> float:
    """A radius that is no less, with a number in its last bits."""
    (bits,) = struct.unpack("<I", struct.pack("<f", max(radius, SMALLEST)))
    mask = (1 << NUMBER_BITS) - 1
    (packed,) = struct.unpack("<f", struct.pack("<I", (bits + mask & ~mask) | number))
    return float(packed)
