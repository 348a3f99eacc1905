"""Triangle solids with normals and texture coordinates in metres over a texture's edge.

Lengths are metres, y is up. Texture coordinates are glTF's: v grows down the image, and u runs
along a piece's grain. Every triangle is counter-clockwise seen from outside.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from scenes.making.noise import Floats, Ints

__all__ = [
    "Line",
    "Mesh",
    "Point",
    "box",
    "curve",
    "join",
    "lathe",
    "place",
    "rounded",
    "sheet",
    "tube",
]

Point = Sequence[float]
Line = Floats | Sequence[Point]
AXES = np.eye(3)


class Mesh(NamedTuple):
    """`positions` (V, 3) metres, unit `normals` (V, 3), `uvs` (V, 2), `faces` (T, 3)."""

    positions: Floats
    normals: Floats
    uvs: Floats
    faces: Ints


def join(meshes: Iterable[Mesh]) -> Mesh:
    """One mesh of several."""
    parts = list(meshes)
    starts = np.cumsum([0, *(len(part.positions) for part in parts)])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=False)]
    columns = zip(*(part[:3] for part in parts), strict=True)
    positions, normals, uvs = (np.concatenate(column) for column in columns)
    return Mesh(positions, normals, uvs, np.concatenate(faces))


def place(mesh: Mesh, at: Point = (0, 0, 0), turn: Point = (0, 0, 0)) -> Mesh:
    """The mesh turned by `turn` degrees about x, then y, then z, and then moved to `at`."""
    matrix = np.eye(3)
    for axis, angle in enumerate(np.radians(turn)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        step = np.eye(3)
        step[[i, j], [i, j]] = np.cos(angle)
        step[i, j], step[j, i] = -np.sin(angle), np.sin(angle)
        matrix = step @ matrix
    positions = mesh.positions @ matrix.T + np.asarray(at)
    return Mesh(positions, mesh.normals @ matrix.T, mesh.uvs, mesh.faces)


def _made(positions: Floats, normals: Floats, uvs: Floats, faces: Ints) -> Mesh:
    """Turn each triangle to face as its normals do; drop those without area, and lone vertices."""
    a, b, c = np.moveaxis(positions[faces], 1, 0)
    cross = np.cross(b - a, c - a)
    outward = (cross * normals[faces].sum(1)).sum(1)
    faces = np.where(outward[:, None] < 0, faces[:, ::-1], faces)
    kept = faces[np.linalg.norm(cross, axis=1) > 1e-10]
    used, indices = np.unique(kept, return_inverse=True)
    return Mesh(positions[used], normals[used], uvs[used], indices.reshape(-1, 3))


def _planar(points: Floats, normal: Floats, along: Floats | None, edge: float) -> Floats:
    """Texture coordinates of points on a plane. u runs along `along`, or level if that is None."""
    wanted = np.cross(AXES[1], normal) if along is None else along
    flat = wanted - normal * (wanted @ normal)
    if np.linalg.norm(flat) < 1e-6:
        flat = AXES[int(np.argmin(np.abs(normal)))]
    right = flat / np.linalg.norm(flat)
    return np.column_stack([points @ right, -(points @ np.cross(normal, right))]) / edge


def box(
    low: Point,
    high: Point,
    edge: float,
    *,
    chamfer: float = 0.0,
    level: bool = False,
    offset: Point = (0, 0),
    taper: float = 1.0,
) -> Mesh:
    """A box between two corners; the chamfers' normals lead smoothly from face to face.

    The grain runs along the longest edge, or level all around if `level`. `offset` moves the
    texture, `taper` scales the lower end.
    """
    middle = (np.asarray(low, float) + np.asarray(high, float)) / 2
    half = np.asarray(high, float) - middle
    along = None if level else AXES[int(np.argmax(half))]
    pieces = [*_box_faces(half, chamfer), *(_box_chamfers(half, chamfer) if chamfer else [])]
    meshes = []
    for points, normals in pieces:
        uvs = _planar(points + middle, normals[0], along, edge) + np.asarray(offset)
        quad = [(0, 1, 2), (2, 1, 3)][: len(points) - 2]
        share = taper + (1 - taper) * (points[:, 1:2] / half[1] + 1) / 2
        shaped = points * np.where(np.arange(3) == 1, 1, share)
        meshes.append(_made(shaped + middle, normals, uvs, np.array(quad)))
    return join(meshes)


def _box_faces(half: Floats, chamfer: float) -> Iterable[tuple[Floats, Floats]]:
    for axis, sign in product(range(3), (-1.0, 1.0)):
        corners = np.array([*product((-1.0, 1.0), repeat=3)])
        corners = corners[corners[:, axis] == sign]
        inner = half - np.where(np.arange(3) == axis, 0, chamfer)
        yield corners * inner, np.tile(sign * AXES[axis], (4, 1))


def _box_chamfers(half: Floats, chamfer: float) -> Iterable[tuple[Floats, Floats]]:
    """The twelve bevels as quads and the eight corners as triangles."""
    for (i, j), s, t in product(combinations(range(3), 2), (-1.0, 1.0), (-1.0, 1.0)):
        k = 3 - i - j
        ends = [(axis, sign, end) for axis, sign in ((i, s), (j, t)) for end in (-1.0, 1.0)]
        signs = s * AXES[i] + t * AXES[j]
        points = [
            (signs + end * AXES[k]) * (half - chamfer * (np.arange(3) != axis))
            for axis, _, end in ends
        ]
        yield np.array(points), np.array([sign * AXES[axis] for axis, sign, _ in ends])
    for corner in product((-1.0, 1.0), repeat=3):
        signs = np.array(corner)
        yield signs * (half - chamfer * (1 - AXES)), AXES * signs


def rounded(
    low: Point, high: Point, radius: float, edge: float, *, cells: int = 6, swell: float = 0.0
) -> Mesh:
    """A box with round edges whose top swells by `swell` metres in the middle: a cushion."""
    middle = (np.asarray(low, float) + np.asarray(high, float)) / 2
    half = np.asarray(high, float) - middle
    ticks = np.sin(np.linspace(-np.pi / 2, np.pi / 2, cells + 1))
    a, b = (c.ravel() for c in np.meshgrid(ticks, ticks))
    faces = _grid_faces(cells + 1, cells + 1)
    meshes = []
    for axis, sign in product(range(3), (-1.0, 1.0)):
        unit = np.empty((len(a), 3))
        unit[:, axis], unit[:, (axis + 1) % 3], unit[:, (axis + 2) % 3] = sign, a, b
        core = np.clip(unit * half, radius - half, half - radius)
        normals = unit * half - core
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        points = core + radius * normals
        uvs = _planar(points, sign * AXES[axis], None, edge)
        bulge = (1 - (points[:, 0] / half[0]) ** 2) * (1 - (points[:, 2] / half[2]) ** 2)
        points[:, 1] += np.where(points[:, 1] > 0, swell * bulge, 0)
        meshes.append(_made(points + middle, normals, uvs, faces))
    return join(meshes)


def _grid_faces(rows: int, columns: int) -> Ints:
    """Two triangles for each cell of a grid of vertices counted row by row."""
    start = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    quad = [start, start + 1, start + columns, start + columns, start + 1, start + columns + 1]
    return np.stack(quad, axis=-1).reshape(-1, 3)


def curve(points: Line, steps: int) -> Floats:
    """A smooth (Catmull-Rom) curve through `points`, `steps` segments between two of them."""
    p = np.asarray(points, float)
    p = np.concatenate([2 * p[:1] - p[1:2], p, 2 * p[-1:] - p[-2:-1]])
    t = np.linspace(0, 1, steps, endpoint=False)[:, None]
    parts = [
        b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)))
        for a, b, c, d in zip(p, p[1:], p[2:], p[3:], strict=False)
    ]
    return np.concatenate([*parts, p[-2:-1]])


def _tangents(path: Floats, closed: bool = False) -> Floats:
    ahead, behind = np.roll(path, -1, 0), np.roll(path, 1, 0)
    if not closed:
        ahead[-1], behind[0] = path[-1], path[0]
    step = ahead - behind
    return np.asarray(step / np.linalg.norm(step, axis=1, keepdims=True))


def lathe(profiles: Sequence[Line], sectors: int, edge: float) -> Mesh:
    """Profiles of (radius, height) turned about the y axis; the corners between them stay sharp.

    A profile runs up the outside and down the inside: the surface faces right of its course.
    """
    return join(_turned(np.asarray(profile, float), sectors, edge) for profile in profiles)


def _turned(profile: Floats, sectors: int, edge: float) -> Mesh:
    turn = np.linspace(0, 2 * np.pi, sectors + 1)
    round_about = np.stack([np.sin(turn), np.zeros_like(turn), np.cos(turn)], axis=-1)
    tangent = _tangents(profile)
    radius, height = profile[:, :1, None], profile[:, 1:, None]
    positions = radius * round_about + height * AXES[1]
    normals = tangent[:, 1:, None] * round_about - tangent[:, :1, None] * AXES[1]
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
    repeats = max(1, round(2 * np.pi * float(profile[:, 0].max()) / edge))
    u, v = np.broadcast_arrays(turn / (2 * np.pi) * repeats, -length[:, None] / edge)
    uvs = np.stack([u, v], axis=-1).reshape(-1, 2)
    faces = _grid_faces(len(profile), sectors + 1)
    return _made(positions.reshape(-1, 3), normals.reshape(-1, 3), uvs, faces)


def tube(
    path: Line,
    radius: float | Floats,
    sectors: int,
    edge: float,
    *,
    closed: bool = False,
) -> Mesh:
    """A round pipe along `path`, capped unless closed; u runs along it, as a grain does."""
    line = np.asarray(path, float)
    if closed:
        line = np.concatenate([line, line[:1]])
    tangent = _tangents(line[:-1], closed=True) if closed else _tangents(line)
    tangent = np.concatenate([tangent, tangent[:1]]) if closed else tangent
    side = _carried(tangent, closed)
    other = np.cross(tangent, side)
    turn = np.linspace(0, 2 * np.pi, sectors + 1)[:, None]
    normals = np.cos(turn) * side[:, None] + np.sin(turn) * other[:, None]
    wide = np.broadcast_to(radius, (len(line) - closed,))
    wide = np.append(wide, wide[0]) if closed else wide
    positions = line[:, None] + wide[:, None, None] * normals
    u = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]) / edge
    repeats = max(1, round(2 * np.pi * float(wide.max()) / edge))
    u = u * max(1, round(u[-1])) / u[-1] if closed else u
    uvs = np.stack(np.broadcast_arrays(u[:, None], turn[:, 0] / (2 * np.pi) * repeats), axis=-1)
    faces = _grid_faces(len(line), sectors + 1)
    pipe = _made(positions.reshape(-1, 3), normals.reshape(-1, 3), uvs.reshape(-1, 2), faces)
    if closed:
        return pipe
    caps = [_cap(positions[end], sign * tangent[end], edge) for end, sign in ((0, -1), (-1, 1))]
    return join([pipe, *caps])


def _carried(tangent: Floats, closed: bool) -> Floats:
    """A unit vector across each tangent, turned as little as possible from one to the next."""
    side = np.cross(tangent[0], AXES[int(np.argmin(np.abs(tangent[0])))])
    sides = []
    for t in tangent:
        side = side - t * (side @ t)
        side = side / np.linalg.norm(side)
        sides.append(side)
    found = np.array(sides)
    if not closed:
        return found
    other = np.cross(tangent, found)
    missed = -np.arctan2(found[-1] @ other[0], found[-1] @ found[0])
    angle = np.linspace(0, missed, len(found))[:, None]
    return np.asarray(np.cos(angle) * found + np.sin(angle) * other)


def _cap(ring: Floats, normal: Floats, edge: float) -> Mesh:
    points = np.concatenate([ring[:-1], ring[:-1].mean(0, keepdims=True)])
    rim = np.arange(len(ring) - 1)
    faces = np.stack([rim, (rim + 1) % len(rim), np.full(len(rim), len(rim))], axis=-1)
    normals = np.tile(normal, (len(points), 1))
    return _made(points, normals, _planar(points, normal, None, edge), faces)


def sheet(line: Line, low: float, high: float, edge: float) -> Mesh:
    """A cloth hanging from `high` to `low` along a line of (x, z), facing right of its course."""
    path = np.asarray(line, float)
    tangent = _tangents(path)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    zero = np.zeros(len(path))
    normals = np.column_stack([-tangent[:, 1], zero, tangent[:, 0]])
    rows = [np.column_stack([path[:, 0], zero + y, path[:, 1]]) for y in (high, low)]
    uvs = [np.column_stack([length, zero - y]) / edge for y in (high, low)]
    faces = _grid_faces(2, len(path))
    return _made(np.concatenate(rows), np.tile(normals, (2, 1)), np.concatenate(uvs), faces)
