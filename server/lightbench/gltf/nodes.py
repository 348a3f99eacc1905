"""The node hierarchy: where each node of the scene stands in the world, and skins at rest."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lightbench import matrix
from lightbench.errors import ModelError
from lightbench.gltf.schema import Document, Node

__all__ = ["Placed", "decomposed", "placed", "worlds"]

Floats = NDArray[np.float64]
# Relative error up to which position, rotation and scale stand for a matrix.
TOLERANCE = 1e-6
# The scene's own limits (lightbench.scene): metres, and the least scale.
FARTHEST, SMALLEST = 1e6, 1e-6


@dataclass(frozen=True)
class Placed:
    """A node of the scene with its matrix (4, 4) to the world."""

    index: int
    node: Node
    world: Floats


def worlds(document: Document) -> dict[int, Floats]:
    """The matrix (4, 4) to the world of every node, in whatever scene. Raises ModelError."""
    children = {child for node in document.nodes for child in node.children}
    waiting = [(i, np.eye(4)) for i in range(len(document.nodes)) if i not in children]
    found: dict[int, Floats] = {}
    for index, parent in waiting:
        node = document.nodes[index]
        with np.errstate(over="ignore", invalid="ignore"):
            found[index] = parent @ _local(node, f"nodes[{index}]")
        if not np.isfinite(found[index]).all():
            raise ModelError(f"nodes[{index}]: its place in the world is not finite")
        waiting.extend((child, found[index]) for child in node.children)
    return found


def placed(document: Document, found: dict[int, Floats]) -> list[Placed]:
    """The nodes of the default scene (the first if none is named; all roots if there is no
    scene), each before its children."""
    if document.scenes:
        waiting = list(document.scenes[document.scene or 0].nodes)
    else:
        children = {child for node in document.nodes for child in node.children}
        waiting = [i for i in range(len(document.nodes)) if i not in children]
    waiting.reverse()
    ordered = []
    while waiting:
        index = waiting.pop()
        node = document.nodes[index]
        ordered.append(Placed(index, node, found[index]))
        waiting.extend(reversed(node.children))
    return ordered


def _local(node: Node, where: str) -> Floats:
    trs = (node.translation, node.rotation, node.scale)
    if node.matrix is not None:
        if any(part is not None for part in trs):
            raise ModelError(f"{where}.matrix: stands beside translation, rotation or scale")
        local = np.array(node.matrix, np.float64).reshape(4, 4).T
        if not np.allclose(local[3], (0, 0, 0, 1), rtol=0, atol=TOLERANCE):
            raise ModelError(f"{where}.matrix: its last row is not 0, 0, 0, 1")
        local[3] = (0, 0, 0, 1)
        return local
    local = np.eye(4)
    local[:3, :3] = _turned(node.rotation or (0, 0, 0, 1), where) * (node.scale or (1, 1, 1))
    local[:3, 3] = node.translation or (0, 0, 0)
    return local


def _turned(quaternion: Sequence[float], where: str) -> Floats:
    """The rotation matrix (3, 3) of a quaternion x, y, z, w, made a unit one."""
    length = math.hypot(*quaternion)
    if not 1e-6 < length < math.inf:
        raise ModelError(f"{where}.rotation: a quaternion of length {length:g}; allowed is 1")
    x, y, z, w = (c / length for c in quaternion)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip


def decomposed(world: Floats) -> dict[str, list[float]] | None:
    """Position, rotation (Euler x, y, z in degrees) and scale of an object under a matrix.

    None if they cannot stand for it to 1e-6: it shears, mirrors, is too small or too far.
    """
    scale = np.sqrt((world[:3, :3] ** 2).sum(axis=0))
    position = world[:3, 3]
    if not (scale.min() >= SMALLEST and max(scale.max(), np.abs(position).max()) <= FARTHEST):
        return None
    turn = world[:3, :3] / scale
    degrees = _euler(turn)
    rebuilt = np.array(matrix.rotation(degrees)).reshape(3, 3).T
    if np.abs(rebuilt - turn).max() > TOLERANCE:
        return None
    return {
        "position": _tidy(position),
        "rotation": _tidy(np.round(degrees, 9)),
        "scale": _tidy(scale),
    }


def _euler(turn: Floats) -> list[float]:
    """Angles x, y, z in degrees of a rotation matrix Rz Ry Rx; about x alone where y is 90."""
    across = math.hypot(turn[2, 1], turn[2, 2])
    y = math.atan2(-turn[2, 0], across)
    if across < 1e-8:
        x, z = math.atan2(-turn[1, 2], turn[1, 1]), 0.0
    else:
        x, z = math.atan2(turn[2, 1], turn[2, 2]), math.atan2(turn[1, 0], turn[0, 0])
    return [math.degrees(angle) for angle in (x, y, z)]


def _tidy(values: Floats) -> list[float]:
    """As plain numbers, -0 as 0."""
    return [float(value) + 0.0 for value in values]
