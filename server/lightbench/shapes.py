"""Triangle meshes by key: plane, cube, icosphere and cone, made once, and those of models.

Texture coordinates: u grows along the tangent, v against the bitangent w * cross(normal, tangent).
They may leave 0..1 where a surface wraps around, so a texture repeats.
"""

import math
import re
from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from lightbench import assets
from lightbench.errors import NotFoundError
from lightbench.mesh import Mesh, pack

__all__ = ["ICOSPHERE_ERRORS", "mesh", "pack"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
# Positions, normals, uvs, tangents and faces.
Arrays = tuple[Floats, Floats, Floats, Floats, Ints]
Direction = tuple[int, int, int]

MAX_STACKS, MIN_SECTORS, MAX_SECTORS = 256, 3, 1024
# 1 - the distance from the centre to the nearest triangle's plane, by subdivision level. It is the
# largest gap in the outline too: a view along that triangle shows its plane as an outline edge.
ICOSPHERE_ERRORS = (
    2.05345527708e-1,
    6.58276410373e-2,
    1.77530536232e-2,
    4.52836760946e-3,
    1.13788327036e-3,
    2.84835354166e-4,
    7.12316626448e-5,
    1.78093428027e-5,
)
CUBE_NORMALS = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
CUBE_TANGENTS = [(0, 0, -1), (0, 0, 1), (1, 0, 0), (1, 0, 0), (1, 0, 0), (-1, 0, 0)]


def mesh(key: str) -> Mesh:
    """The mesh that a key such as "plane", "cube", "icosphere-5" or "cone-16x32" says how to make.

    plane: 1 x 1 in xz at y = 0, facing +y. triangle: the origin and the ends of x and y, facing +z.
    cube: edge 1, centred. icosphere-LEVEL: radius 1.
    cone-STACKSxSECTORS: base disk of radius 1 at y = 0, apex at y = 1. mesh-HASH: that of a model,
    in the asset store. Raises NotFoundError.
    """
    return assets.mesh(key) if key.startswith("mesh-") else _made(key)


@lru_cache(maxsize=32)
def _made(key: str) -> Mesh:
    if key == "plane":
        return _quads([(0, 1, 0)], [(1, 0, 0)], offset=0.0)
    if key == "triangle":
        return _corner()
    if key == "cube":
        return _quads(CUBE_NORMALS, CUBE_TANGENTS, offset=0.5)
    if match := re.fullmatch(r"icosphere-(\d)", key, re.ASCII):
        level = int(match[1])
        if level < len(ICOSPHERE_ERRORS):
            return _icosphere(level)
    if match := re.fullmatch(r"cone-([1-9]\d{0,3})x([1-9]\d{0,3})", key, re.ASCII):
        stacks, sectors = int(match[1]), int(match[2])
        if stacks <= MAX_STACKS and MIN_SECTORS <= sectors <= MAX_SECTORS:
            return _cone(stacks, sectors)
    raise NotFoundError(
        f"no mesh {key!r}; meshes are: plane, triangle, cube, icosphere-LEVEL (0 to "
        f"{len(ICOSPHERE_ERRORS) - 1}), cone-STACKSxSECTORS "
        f"(1 to {MAX_STACKS} x {MIN_SECTORS} to {MAX_SECTORS})"
    )


def _mesh(positions: Floats, normals: Floats, uvs: Floats, tangents: Floats, faces: Ints) -> Mesh:
    """The arrays in their final types, all bitangents being cross(normal, tangent).

    `uvs` come with v along the bitangent, up the image; a mesh has v down the image.
    """
    signed = np.column_stack([tangents, np.ones(len(tangents))])
    uvs = np.column_stack([uvs[:, 0], 1 - uvs[:, 1]])
    return Mesh(
        positions.astype(np.float32),
        normals.astype(np.float32),
        uvs.astype(np.float32),
        signed.astype(np.float32),
        faces.astype(np.uint32),
    )


def _quads(normals: list[Direction], tangents: list[Direction], offset: float) -> Mesh:
    """A unit square for every normal, `offset` away from the origin along it."""
    n, t = np.array(normals, np.float64), np.array(tangents, np.float64)
    b = np.cross(n, t)
    corners = np.array([(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)])
    across = corners @ np.stack([t, b], axis=1)
    positions = (across + offset * n[:, None]).reshape(-1, 3)
    faces = np.array([(0, 1, 2), (0, 2, 3)]) + 4 * np.arange(len(n))[:, None, None]
    uvs = np.tile(corners + 0.5, (len(n), 1))
    return _mesh(positions, n.repeat(4, 0), uvs, t.repeat(4, 0), faces.reshape(-1, 3))


def _corner() -> Mesh:
    """The triangle between the origin and the ends of x and y, facing +z."""
    positions = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)])
    normals, tangents = (np.tile(axis, (3, 1)) for axis in ((0.0, 0, 1), (1.0, 0, 0)))
    return _mesh(positions, normals, positions[:, :2], tangents, np.array([(0, 1, 2)]))


def _icosahedron() -> tuple[Floats, Ints]:
    """The unit vertices and outward faces of the icosahedron (+-1, 0, +-phi) and permutations."""
    phi = (1 + math.sqrt(5)) / 2
    corners = [(x, 0.0, z) for x in (-1.0, 1.0) for z in (-phi, phi)]
    vertices = np.array([np.roll(corner, shift) for shift in range(3) for corner in corners])
    faces = [
        (a, b, c) if np.linalg.det(vertices[[a, b, c]]) > 0 else (a, c, b)
        for a, b, c in combinations(range(12), 3)
        if all(math.dist(vertices[i], vertices[j]) < 2.1 for i, j in ((a, b), (b, c), (c, a)))
    ]
    return vertices / math.hypot(1, phi), np.array(faces)


def _subdivide(vertices: Floats, faces: Ints) -> tuple[Floats, Ints]:
    """Each triangle split in four at its edges' midpoints, which neighbours share."""
    edges = np.sort(faces[:, [(0, 1), (1, 2), (2, 0)]], axis=-1).reshape(-1, 2)
    keys, inverse = np.unique(edges @ (len(vertices), 1), return_inverse=True)
    middles = vertices[keys // len(vertices)] + vertices[keys % len(vertices)]
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    a, b, c = faces.T
    ab, bc, ca = len(vertices) + inverse.reshape(-1, 3).T
    split = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    children = np.stack([np.stack(child, axis=1) for child in split], axis=1)
    return np.concatenate([vertices, middles]), children.reshape(-1, 3)


def _icosphere(level: int) -> Mesh:
    """The unit sphere with u by longitude and v by latitude, cut at the seam and the poles."""
    points, faces = _icosahedron()
    for _ in range(level):
        points, faces = _subdivide(points, faces)
    vertex, u, faces = _unwrap(points, faces)
    x, y, z = points[vertex].T
    latitude, longitude = np.arctan2(y, np.hypot(x, z)), 2 * math.pi * (u - 0.5)
    uvs = np.column_stack([u, 0.5 + latitude / math.pi])
    tangents = np.column_stack([np.cos(longitude), np.zeros(len(u)), -np.sin(longitude)])
    return _mesh(points[vertex], points[vertex], uvs, tangents, faces)


def _longitude(points: Floats) -> Floats:
    """u of directions (..., 3). Adding 0 makes -0 positive, so that the seam itself has u = 1."""
    return 0.5 + np.arctan2(points[..., 0] + 0.0, points[..., 2]) / (2 * math.pi)


def _unwrap(points: Floats, faces: Ints) -> tuple[Ints, Floats, Ints]:
    """(point of each cut vertex, its u, faces of cut vertices), with u continuous on every face.

    A point on the seam becomes one vertex a side; a pole, which has no longitude, becomes one
    vertex a triangle, midway between the triangle's two others.
    """
    u = _longitude(points)[faces]
    u -= np.round(u - _longitude(points[faces].mean(axis=1))[:, None])
    pole = np.hypot(points[:, 0], points[:, 2])[faces] < 1e-9
    u = np.where(pole, np.where(pole, 0, u).sum(axis=1, keepdims=True) / 2, u)
    u -= np.floor(u.min(axis=1, keepdims=True) + 1e-9)
    turns = np.where(pole, np.arange(u.size).reshape(u.shape), u > 0.75)
    keys = faces * (u.size + 1) + turns
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    return faces.ravel()[first], u.ravel()[first], inverse.reshape(-1, 3)


def _cone(stacks: int, sectors: int) -> Mesh:
    """Side and base of the cone x = v sin a, y = 1 - v, z = v cos a, with v from the apex down."""
    side, base = _cone_side(stacks, sectors), _cone_base(sectors)
    positions, normals, uvs, tangents = (
        np.concatenate(pair) for pair in zip(side[:4], base[:4], strict=True)
    )
    faces = np.concatenate([side[4], base[4] + len(side[0])])
    return _mesh(positions, normals, uvs, tangents, faces)


def _cone_side(stacks: int, sectors: int) -> Arrays:
    """An apex vertex for every sector, then the rings, each closed by a second first vertex."""
    middles = (np.arange(sectors) + 0.5) / sectors
    ring = np.arange(sectors + 1) / sectors
    u = np.concatenate([middles, np.tile(ring, stacks)])
    down = np.repeat(np.arange(stacks + 1) / stacks, [sectors] + [sectors + 1] * stacks)
    sine, cosine, zero = np.sin(2 * math.pi * u), np.cos(2 * math.pi * u), np.zeros(len(u))
    positions = np.column_stack([down * sine, 1 - down, down * cosine])
    normals = np.column_stack([sine, zero + 1, cosine]) / math.sqrt(2)
    tangents = np.column_stack([cosine, zero, -sine])
    uvs = np.column_stack([u, 1 - down])
    return positions, normals, uvs, tangents, _cone_side_faces(stacks, sectors)


def _cone_side_faces(stacks: int, sectors: int) -> Ints:
    apexes = np.arange(sectors)
    a = sectors + (sectors + 1) * np.arange(stacks - 1)[:, None] + apexes
    c = a + sectors + 1
    quads = np.stack([a, c, c + 1, a, c + 1, a + 1], axis=-1)
    cap = np.stack([apexes, sectors + apexes, sectors + apexes + 1], axis=-1)
    return np.concatenate([cap, quads.reshape(-1, 3)])


def _cone_base(sectors: int) -> Arrays:
    """The unit disk at y = 0 facing down, around a vertex at its centre."""
    turn = 2 * math.pi * np.arange(sectors) / sectors
    x, z = np.append(np.sin(turn), 0), np.append(np.cos(turn), 0)
    positions = np.column_stack([x, np.zeros(len(x)), z])
    normals, tangents = (np.tile(axis, (len(x), 1)) for axis in ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0)))
    rim = np.arange(sectors)
    faces = np.stack([np.full(sectors, sectors), (rim + 1) % sectors, rim], axis=-1)
    return positions, normals, np.column_stack([x, z]) / 2 + 0.5, tangents, faces
