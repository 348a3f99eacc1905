"""Normals and shading frames: flat where the file has none, repaired where they say nothing."""

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import ModelError

__all__ = ["face_normals", "frames", "orthogonal", "repaired", "unit"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

# Least length that has a direction: above where float64 squares vanish.
SHORTEST = 1e-150


def unit(vectors: Floats) -> Floats:
    """Vectors (N, k) of length 1; those without a direction as zero."""
    largest = np.abs(vectors).max(axis=1, keepdims=True, initial=0)
    scaled = vectors / np.where(largest > SHORTEST, largest, 1)
    lengths = np.linalg.norm(scaled, axis=1, keepdims=True)
    return np.where(largest > SHORTEST, scaled / np.where(lengths > 0, lengths, 1), 0.0)


def face_normals(positions: Floats, triangles: Ints) -> Floats:
    """Unit normals (T, 3) of triangles, counter-clockwise; zero for one without an area."""
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    return unit(np.cross(unit(b - a), unit(c - a)))


def repaired(normals: Floats, positions: Floats, triangles: Ints, where: str) -> Floats:
    """Normals of length 1; a zero one becomes that of a triangle at its vertex.

    Raises ModelError if a triangle has no normal other than zero: nothing says how it is meant.
    """
    normals = unit(normals)
    zero: Bools = (normals == 0).all(axis=1)
    if not zero.any():
        return normals
    faces = face_normals(positions, triangles)
    flat: Bools = (faces != 0).any(axis=1)
    lost: Bools = zero[triangles].all(axis=1) & flat
    if lost.any():
        raise ModelError(
            f"{where}: the normals of triangle {int(lost.argmax())} are all zero; allowed are unit "
            "vectors, or none for flat shading"
        )
    for corner in range(3):
        touched: Bools = flat & zero[triangles[:, corner]]
        normals[triangles[touched, corner]] = faces[touched]
    normals[~normals.any(axis=1)] = (0, 0, 1)
    return normals


def orthogonal(tangents: Floats, normals: Floats) -> Floats:
    """Tangents (V, 3) turned square to their normals and of length 1; where that is nothing, any
    direction square to the normal."""
    across = unit(tangents - normals * (normals * tangents).sum(axis=1, keepdims=True))
    lost = np.abs((across * normals).sum(axis=1)) > 1e-6
    lost |= ~across.any(axis=1)
    across[lost] = frames(normals[lost])
    return across


def frames(normals: Floats) -> Floats:
    """A unit tangent (V, 3) for each normal: along x where that is not too near the normal."""
    axis = np.where(np.abs(normals[:, :1]) < 0.9, (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    return unit(axis - normals * (normals * axis).sum(axis=1, keepdims=True))
