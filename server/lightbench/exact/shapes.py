"""Rays and the shapes of scenes in float64: implicit equations, and the meshes' definitions."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lightbench.exact import cone, rays
from lightbench.exact.crossings import across, east, entered, left, points, quadric, turn
from lightbench.exact.directions import Array, column, unit
from lightbench.shapes import CUBE_NORMALS, CUBE_TANGENTS

NORMALS, TANGENTS = np.array(CUBE_NORMALS, float), np.array(CUBE_TANGENTS, float)
# The unit sphere as a diagonal quadratic form.
ROUND = np.ones(3)

# The plane


def plane_hit(origin: Array, direction: Array, side: Array) -> Array:
    """Where a ray comes through y = 0 within the square, from above (side 1) or below (-1)."""
    t = across(origin, direction, np.array([0.0, 1.0, 0.0]), 0.0)
    p = origin + column(t) * direction
    found = (np.abs(p[:, [0, 2]]) <= 0.5).all(axis=-1) & (origin[:, 1] * side > 0.0) & (t > 0.0)
    return np.where(found, t, -1.0)


def _always(*value: float) -> Callable[[Array], Array]:
    """The same vector at every point."""
    return lambda p: np.broadcast_to(np.array(value), p.shape)


def face_uv(p: Array, n: Array, t: Array) -> Array:
    """u along the tangent, v against the bitangent w = n x t, 1/2 in the middle."""
    frame = np.stack(np.broadcast_arrays(t, np.cross(n, t), n), axis=-1)
    inside = np.linalg.solve(frame, p[..., None])[..., 0]
    return np.stack([0.5 + inside[..., 0], 0.5 - inside[..., 1]], axis=-1)


def plane_uv(p: Array) -> Array:
    """Across xz, u along x."""
    return np.stack([p[:, 0] + 0.5, p[:, 2] + 0.5], axis=-1)


# The cube


def _cube_crossings(origin: Array, direction: Array) -> Array:
    """Of the six planes, where the point is on the face."""
    t = np.stack([across(origin, direction, n, 0.5) for n in NORMALS], axis=-1)
    p = np.abs(points(origin, direction, t))
    others = np.where(np.abs(NORMALS) > 0.0, 0.0, p)
    return np.where((others <= 0.5).all(axis=-1), t, np.nan)


def cube_span(origin: Array, direction: Array) -> Array:
    """From where a ray is between all three pairs of planes to where it leaves the first."""
    t = np.stack([across(origin, direction, n, 0.5) for n in NORMALS], axis=-1)
    pairs = np.sort(t.reshape(-1, 3, 2), axis=-1)
    return np.stack([pairs[..., 0].max(axis=-1), pairs[..., 1].min(axis=-1)], axis=-1)


def cube_hit(origin: Array, direction: Array) -> Array:
    """Into the cube |x|, |y|, |z| <= 1/2."""
    return entered(_cube_crossings(origin, direction))


def cube_exit(origin: Array, direction: Array) -> Array:
    """Out of it."""
    return left(_cube_crossings(origin, direction))


def _face(p: Array) -> Array:
    """Which face of the cube is the farthest out at a point."""
    return np.asarray(np.argmax(p @ NORMALS.T, axis=-1))


def cube_normal(p: Array) -> Array:
    """That of the face."""
    return np.asarray(NORMALS[_face(p)])


def cube_tangent(p: Array) -> Array:
    """That of the face."""
    return np.asarray(TANGENTS[_face(p)])


def cube_uv(p: Array) -> Array:
    """On the face."""
    return face_uv(p, cube_normal(p), cube_tangent(p))


# The sphere


def round_hit(origin: Array, direction: Array) -> Array:
    """Into the unit sphere."""
    return entered(quadric(ROUND, origin, direction, 1.0))


def round_exit(origin: Array, direction: Array) -> Array:
    """Out of it."""
    return left(quadric(ROUND, origin, direction, 1.0))


def sphere_exit(origin: Array, direction: Array, centre: Array, radius: Array) -> Array:
    """Out of a sphere anywhere, along a unit direction."""
    size = column(np.broadcast_to(radius, origin.shape[:1]))
    return round_exit((origin - centre) / size, unit(direction) / size)


def spherical(p: Array) -> Array:
    """Longitude and the angle from the north pole."""
    down = np.angle(p[..., 1] + 1j * np.abs(p[..., 2] + 1j * p[..., 0]))
    return np.stack([0.5 + turn(p), down / np.pi], axis=-1)


def arcsines(n: Array) -> Array:
    """1/2 + asin(n_x) / pi and 1/2 - asin(n_y) / pi, n made unit."""
    s = np.arcsin(np.clip(unit(n)[..., :2], -1.0, 1.0)) / np.pi
    return np.stack([0.5 + s[..., 0], 0.5 - s[..., 1]], axis=-1)


# By file of lib/ and name.
FORMS: dict[tuple[str, str], Callable[..., Array]] = {
    ("cone", "coneBase"): cone.cone_base,
    ("cone", "coneExit"): cone.cone_exit,
    ("cone", "coneHit"): cone.cone_hit,
    ("cone", "coneNormal"): cone.cone_normal,
    ("cone", "coneSide"): cone.cone_side,
    ("cone", "coneTangent"): cone.cone_tangent,
    ("cone", "coneUv"): cone.cone_uv,
    ("cone", "onBase"): cone.on_base,
    ("longitude", "east"): east,
    ("longitude", "longitude"): turn,
    ("ray", "mirrored"): rays.mirrored,
    ("ray", "throughPicture"): rays.through_picture,
    ("shapes", "cubeExit"): cube_exit,
    ("shapes", "cubeHit"): cube_hit,
    ("shapes", "cubeNormal"): cube_normal,
    ("shapes", "cubeSpan"): cube_span,
    ("shapes", "cubeTangent"): cube_tangent,
    ("shapes", "cubeUv"): cube_uv,
    ("shapes", "faceUv"): face_uv,
    ("shapes", "planeHit"): plane_hit,
    ("shapes", "planeNormal"): _always(0.0, 1.0, 0.0),
    ("shapes", "planeTangent"): _always(1.0, 0.0, 0.0),
    ("shapes", "planeUv"): plane_uv,
    ("shapes", "roundExit"): round_exit,
    ("shapes", "roundHit"): round_hit,
    ("shapes", "roundNormal"): lambda p: p,
    ("shapes", "roundTangent"): east,
    ("shapes", "roundUv"): spherical,
    ("sphere", "sphereExit"): sphere_exit,
    ("triangle", "alongEdges"): rays.along_edges,
    ("triangle", "triangleHit"): rays.triangle_hit,
}
