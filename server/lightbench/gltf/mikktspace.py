"""Tangents after MikkTSpace, the convention that normal maps are baked with.

Source: M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008, and his reference
implementation, mikktspace.c, with its default angle threshold of 180 degrees. A tangent is the mean
over a group of triangle corners: those at one vertex (equal position, normal and texture
coordinates) that edges connect and whose texture has one orientation.
"""

import numpy as np
from numpy.typing import NDArray

__all__ = ["tangents"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

# Below float32's least normal number the reference takes a value for zero.
ZERO = float(np.finfo(np.float32).tiny)
# Times that triangles without a texture direction ask their neighbours for one.
ADOPTIONS = 8


def tangents(
    positions: Floats, normals: Floats, uvs: Floats, triangles: Ints
) -> tuple[Floats, Ints, Ints]:
    """(tangents (W, 4), the vertex (W,) that each is of, triangles (T, 3) of the new vertices).

    From positions (V, 3), unit normals (V, 3), glTF texture coordinates (V, 2: v down the image)
    and triangles (T, 3) without equal corners. A vertex is split where its corners have different
    tangents. One whose texture has no direction gets the zero vector.
    """
    welded = _weld(positions, normals, uvs)[triangles]
    along, area = _texture_direction(positions, uvs, triangles)
    usable = (np.abs(area) > ZERO) & (np.linalg.norm(along, axis=1) > ZERO)
    neighbours = _neighbours(welded)
    upright, joined = _orientations(area > 0, usable, neighbours)
    groups = _groups(neighbours, welded, upright, joined)
    shares = _shares(
        positions, normals, triangles, _unit(along) * np.where(area > 0, 1, -1)[:, None]
    )
    shares[~usable] = 0
    sums = _sum_by(groups.ravel(), shares.reshape(-1, 3))
    corners = np.column_stack(
        [_unit(sums)[groups.ravel()], np.where(np.repeat(upright, 3), 1.0, -1.0)]
    )
    return _vertices(triangles, groups, corners)


def _weld(positions: Floats, normals: Floats, uvs: Floats) -> Ints:
    """One number for all vertices that are equal in all three."""
    rows = np.ascontiguousarray(np.column_stack([positions, normals, uvs]).astype(np.float32) + 0.0)
    whole = rows.view(np.dtype((np.void, rows.dtype.itemsize * rows.shape[1]))).ravel()
    return np.unique(whole, return_inverse=True)[1].reshape(-1).astype(np.int64)


def _texture_direction(positions: Floats, uvs: Floats, triangles: Ints) -> tuple[Floats, Floats]:
    """The direction (T, 3) in which u grows, times the sign of the second: the area (T,) in uv.

    v is turned up the image, as MikkTSpace has it.
    """
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    ta, tb, tc = (uvs[triangles[:, i]] * (1, -1) for i in range(3))
    first, second = tb - ta, tc - ta
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    along = second[:, 1:] * (b - a) - first[:, 1:] * (c - a)
    return along, area


def _neighbours(welded: Ints) -> Ints:
    """(T, 3): the corner that follows edge i of a triangle's neighbour across its edge i, or -1.

    Edge i runs from corner i to the next; the neighbour has the same edge the other way around.
    Where more than two triangles meet, the first pairs with the first.
    """
    starts, ends = welded.ravel(), np.roll(welded, -1, axis=1).ravel()
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    codes = 2 * (low * (int(welded.max()) + 1) + high) + (starts > ends)
    order = np.argsort(codes, kind="stable")
    codes = codes[order]
    begins = np.flatnonzero(np.diff(codes, prepend=-1))
    run = np.repeat(np.arange(len(begins)), np.diff(begins, append=len(codes)))
    place = np.arange(len(codes))
    # The k-th of a run of equal edges one way pairs with the k-th of the run the other way, which
    # follows it: its code is one more.
    partner = np.append(begins, len(codes))[run + 1] + place - begins[run]
    partner = np.minimum(partner, len(codes) - 1)
    pairs = (codes % 2 == 0) & (codes[partner] == codes + 1)
    found = np.full(len(codes), -1)
    found[order[pairs]] = order[partner[pairs]]
    found[order[partner[pairs]]] = order[pairs]
    return found.reshape(-1, 3)


def _orientations(upright: Bools, usable: Bools, neighbours: Ints) -> tuple[Bools, Bools]:
    """(orientation, whether in a group), (T,) both.

    Triangles without a texture direction of their own adopt a neighbour's orientation.
    """
    upright, joined = upright.copy(), usable.copy()
    for _ in range(ADOPTIONS):
        others = np.where(neighbours >= 0, neighbours // 3, 0)
        willing = (neighbours >= 0) & joined[others] & ~joined[:, None]
        adopting = np.flatnonzero(willing.any(axis=1))
        if not len(adopting):
            break
        chosen = others[adopting, willing[adopting].argmax(axis=1)]
        upright[adopting], joined[adopting] = upright[chosen], True
    return upright, joined


def _groups(neighbours: Ints, welded: Ints, upright: Bools, joined: Bools) -> Ints:
    """A label (T, 3) that corners share if edges connect them about their vertex."""
    corner = np.arange(neighbours.size)
    across = neighbours.ravel()
    triangle, other = corner // 3, np.where(across >= 0, across // 3, 0)
    linked = (
        (across >= 0) & joined[triangle] & joined[other] & (upright[triangle] == upright[other])
    )
    here, there = corner[linked], across[linked]
    # An edge joins two pairs of corners: its start here is its end there, and the other way.
    pairs = np.concatenate([np.stack([here, _next(there)]), np.stack([_next(here), there])], axis=1)
    return _connected(neighbours.size, pairs[0], pairs[1]).reshape(-1, 3)


def _next(corner: Ints) -> Ints:
    return corner - corner % 3 + (corner + 1) % 3


def _connected(count: int, first: Ints, second: Ints) -> Ints:
    """The least member of each element's connected component (Shiloach and Vishkin 1982)."""
    label = np.arange(count)
    while True:
        low = np.minimum(label[first], label[second])
        before = label.copy()
        np.minimum.at(label, label[first], low)
        np.minimum.at(label, label[second], low)
        while (label != (jumped := label[label])).any():
            label = jumped
        if (label == before).all():
            return label


def _shares(positions: Floats, normals: Floats, triangles: Ints, along: Floats) -> Floats:
    """What each corner adds to its group (T, 3, 3): its tangent times its angle."""
    shares = np.empty((len(triangles), 3, 3))
    for i in range(3):
        normal = normals[triangles[:, i]]
        here = positions[triangles[:, i]]
        arms = [
            _unit(_flatten(positions[triangles[:, (i + step) % 3]] - here, normal))
            for step in (1, 2)
        ]
        angle = np.arccos(np.clip((arms[0] * arms[1]).sum(axis=1), -1, 1))
        shares[:, i] = _unit(_flatten(along, normal)) * angle[:, None]
    return shares


def _flatten(vectors: Floats, normals: Floats) -> Floats:
    """Vectors less what of them lies along the normals."""
    flat: Floats = vectors - normals * (normals * vectors).sum(axis=1, keepdims=True)
    return flat


def _unit(vectors: Floats) -> Floats:
    """Vectors of length 1; those too short to have a direction stay as zero."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    directions: Floats = vectors / np.where(lengths > ZERO, lengths, np.inf)
    return directions


def _sum_by(labels: Ints, values: Floats) -> Floats:
    return np.column_stack(
        [np.bincount(labels, values[:, i], minlength=len(labels)) for i in range(3)]
    )


def _vertices(triangles: Ints, groups: Ints, corners: Floats) -> tuple[Floats, Ints, Ints]:
    """One vertex for each pair of an old vertex and a group."""
    keys = triangles.ravel() * (groups.size + 1) + groups.ravel()
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return corners[first], triangles.ravel()[first], inverse.reshape(-1, 3)
