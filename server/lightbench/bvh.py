"""A mesh's triangles as a table of texels that `shaders/lib/bvh.glsl` follows rays through.

The table is one list of texels of four int32, floats by their bits, so that several tables can lie
one after the other in a texture of WIDTH columns: every place in it counts from its own start.

    3 texels    centre of all (3 floats) and nodes of an order; cells a unit (3 floats) and where
                the triangles begin; where the vertices begin, texels of a vertex, triangles
    8 orders    of the nodes, for the signs of a ray's direction (x + 2 y + 4 z, 1 where negative)
    triangles   3 texels each: its corners, each with its place among the vertices
    vertices    normal; uv0 and uv1; tangent; colour, if the mesh has colours

A node is one texel: six sides of its box in cells, and what comes next. An order has every node
before its children and the nearer child before the other, so that a ray reads on after a node that
it meets and else passes over all below: it keeps no list of what is left (Torres et al. 2009, Ray
Casting using a Roped BVH with CUDA). In an order's own coordinates all rays run upwards, so that a
box's lower sides (the low halves, plus BIAS) are the near ones.
"""

import numpy as np
from numpy.typing import NDArray

from lightbench.hierarchy import Floats, Hierarchy, Ints, build
from lightbench.mesh import Mesh

__all__ = ["WIDTH", "bake"]

# Columns of the texture: what every WebGL2 promises.
WIDTH = 2048
HEADER, ORDERS, CORNERS = 3, 8, 3
# Cells along each axis of the whole, and what makes a lower side's cell positive.
CELLS, BIAS = 65000, 32768
# Cells that a box is larger by at each side, beyond being rounded outwards.
MARGIN = 1
# The extents of the whole that cells are made for, at least: of the largest, and at all.
FLATTEST, SMALLEST = 1e-3, 1e-18
# A leaf's triangles: (first << COUNT_BITS) + number.
COUNT_BITS = 3

Texels = NDArray[np.int32]


def bake(mesh: Mesh) -> Texels:
    """The table (texels, 4). A triangle without an area is left out: no ray meets it."""
    corners = mesh.positions.astype(np.float64)[mesh.indices]
    e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    whole = np.flatnonzero(np.cross(e1, e2).any(axis=1))
    tree = build(corners[whole].min(axis=1), corners[whole].max(axis=1))
    triangles = _triangles(mesh, mesh.indices[whole[tree.order]])
    vertices = _vertices(mesh)
    centre, scale = _cells(tree)
    nodes = _nodes(tree, centre.astype(np.float64), scale.astype(np.float64))
    header = np.zeros((HEADER, 4), np.int32)
    header[0] = [*centre.view(np.int32), len(tree.child)]
    header[1] = [*scale.view(np.int32), HEADER + len(nodes)]
    header[2, 0] = HEADER + len(nodes) + len(triangles)
    header[2, 1:3] = len(vertices) // max(len(mesh.positions), 1), len(whole)
    return np.concatenate([header, nodes, triangles, vertices])


def _cells(tree: Hierarchy) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Centre of the whole and cells a unit, (3,) each."""
    if not len(tree.child):
        return np.zeros(3, np.float32), np.ones(3, np.float32)
    extent = tree.high[0] - tree.low[0]
    extent = np.maximum(extent, max(FLATTEST * extent.max(), SMALLEST))
    middle = (tree.low[0] + tree.high[0]) / 2
    return middle.astype(np.float32), (CELLS / extent).astype(np.float32)


def _nodes(tree: Hierarchy, centre: Floats, scale: Floats) -> Texels:
    """All orders (ORDERS * N, 4)."""
    count = len(tree.child)
    below = _nodes_below(tree)
    leaf = tree.child == 0
    following = np.where(leaf, -1 - ((tree.start << COUNT_BITS) + tree.count), below)
    low, high = (tree.low - centre) * scale, (tree.high - centre) * scale
    found = np.zeros((ORDERS, count, 4), np.int32)
    for order in range(ORDERS):
        negative = (order >> np.arange(3)) & 1 == 1
        near = np.floor(np.where(negative, -high, low)).astype(np.int64) - MARGIN + BIAS
        far = np.ceil(np.where(negative, -low, high)).astype(np.int64) + MARGIN
        place = _places(tree, below, negative[tree.axis])
        found[order, place, :3] = (far << 16) + near
        found[order, place, 3] = following
    return found.reshape(-1, 4)


def _nodes_below(tree: Hierarchy) -> Ints:
    """Nodes of each subtree, its root included."""
    below = np.ones(len(tree.child), np.int64)
    for inner in reversed(_inner(tree)):
        first = tree.child[inner]
        below[inner] += below[first] + below[first + 1]
    return below


def _places(tree: Hierarchy, below: Ints, swapped: NDArray[np.bool_]) -> Ints:
    """Where each node stands when children follow their parent, the second first if `swapped`."""
    place = np.zeros(len(tree.child), np.int64)
    for inner in _inner(tree):
        first = tree.child[inner] + swapped[inner]
        second = tree.child[inner] + ~swapped[inner]
        place[first] = place[inner] + 1
        place[second] = place[inner] + 1 + below[first]
    return place


def _inner(tree: Hierarchy) -> list[Ints]:
    """The nodes with children, level by level."""
    pairs = zip(tree.levels[:-1], tree.levels[1:], strict=True)
    return [begin + np.flatnonzero(tree.child[begin:end]) for begin, end in pairs]


def _triangles(mesh: Mesh, indices: NDArray[np.uint32]) -> Texels:
    """CORNERS texels of each of the triangles (T, 3)."""
    found = np.zeros((len(indices), CORNERS, 4), np.int32)
    found[..., :3] = mesh.positions[indices].view(np.int32)
    found[..., 3] = indices
    return found.reshape(-1, 4)


def _vertices(mesh: Mesh) -> Texels:
    """Each vertex's texels."""
    count = len(mesh.positions)
    texels = np.zeros((count, 3 + (mesh.colors is not None), 4), np.float32)
    texels[:, 0, :3] = mesh.normals
    texels[:, 1, :2] = mesh.uvs
    if mesh.uvs1 is not None:
        texels[:, 1, 2:] = mesh.uvs1
    texels[:, 2] = mesh.tangents
    if mesh.colors is not None:
        texels[:, 3] = mesh.colors
    return texels.reshape(-1, 4).view(np.int32)
