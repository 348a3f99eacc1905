"""Meshes: closed, outward, with frames that follow the texture, and right in area and volume."""

from __future__ import annotations

import dataclasses
import math
import struct
from collections import Counter

import numpy as np
import pytest
from numpy.typing import NDArray

from lightbench import assets
from lightbench.errors import LightbenchError, NotFoundError
from lightbench.mesh import Mesh
from lightbench.shapes import ICOSPHERE_ERRORS, mesh, pack

Floats = NDArray[np.float64]

CONES = ["cone-1x3", "cone-2x3", "cone-5x7", "cone-16x32"]
SPHERES = [f"icosphere-{level}" for level in range(6)]
CLOSED = ["cube", *SPHERES, *CONES]
ALL = ["plane", "triangle", *CLOSED]


def corners(made: Mesh, name: str = "positions") -> Floats:
    """A vertex array by triangle and corner, (T, 3, k) in float64."""
    values: Floats = getattr(made, name)[made.indices].astype(np.float64)
    return values


def face_normals(made: Mesh) -> Floats:
    """Cross products (T, 3), twice as long as the triangles' areas."""
    a, b, c = np.moveaxis(corners(made), 1, 0)
    return np.cross(b - a, c - a)


def area(made: Mesh) -> float:
    return float(np.linalg.norm(face_normals(made), axis=1).sum() / 2)


def volume(made: Mesh) -> float:
    return float((face_normals(made) * corners(made)[:, 0]).sum() / 6)


def welded(made: Mesh) -> NDArray[np.int64]:
    """The triangles (T, 3) with vertices at one position made one."""
    _, same = np.unique(np.round(made.positions, 6) + 0.0, axis=0, return_inverse=True)
    triangles: NDArray[np.int64] = same.reshape(-1)[made.indices]
    return triangles


def directed_edges(made: Mesh) -> Counter[tuple[int, int]]:
    triangles = welded(made)
    pairs = triangles[:, [(0, 1), (1, 2), (2, 0)]].reshape(-1, 2)
    return Counter((int(a), int(b)) for a, b in pairs)


@pytest.mark.parametrize("key", CLOSED)
def test_closed(key: str) -> None:
    edges = directed_edges(mesh(key))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges)


@pytest.mark.parametrize("key", CLOSED)
def test_euler_characteristic_of_a_sphere(key: str) -> None:
    made = mesh(key)
    triangles = welded(made)
    edges = len(directed_edges(made)) // 2
    assert len(np.unique(triangles)) - edges + len(triangles) == 2


@pytest.mark.parametrize("key", CLOSED)
def test_faces_look_outward(key: str) -> None:
    made = mesh(key)
    inside = np.array([0, 0.25, 0]) if key.startswith("cone") else np.zeros(3)
    assert ((face_normals(made) * (corners(made)[:, 0] - inside)).sum(1) > 0).all()


@pytest.mark.parametrize("key", ALL)
def test_vertex_normals_agree_with_their_faces(key: str) -> None:
    made = mesh(key)
    facing = face_normals(made)
    facing /= np.linalg.norm(facing, axis=1, keepdims=True)
    assert (np.einsum("tk,tck->tc", facing, corners(made, "normals")) > 0.5).all()


@pytest.mark.parametrize("key", ALL)
def test_frames_are_orthonormal(key: str) -> None:
    made = mesh(key)
    tangents = made.tangents[:, :3]
    np.testing.assert_allclose(np.linalg.norm(made.normals, axis=1), 1, atol=2e-7)
    np.testing.assert_allclose(np.linalg.norm(tangents, axis=1), 1, atol=2e-7)
    np.testing.assert_allclose((made.normals * tangents).sum(1), 0, atol=3e-7)
    assert set(np.unique(made.tangents[:, 3])) <= {-1.0, 1.0}


def derivatives(made: Mesh) -> tuple[Floats, Floats]:
    """Of the position by u and by v, constant on each triangle, (T, 3) both."""
    a, b, c = np.moveaxis(corners(made), 1, 0)
    ua, ub, uc = np.moveaxis(corners(made, "uvs"), 1, 0)
    first, second = ub - ua, uc - ua
    determinant = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    assert (np.abs(determinant) > 0).all()
    by_u = ((b - a) * second[:, 1:] - (c - a) * first[:, 1:]) / determinant[:, None]
    by_v = ((c - a) * first[:, :1] - (b - a) * second[:, :1]) / determinant[:, None]
    return by_u, by_v


def cosines(directions: Floats, vectors: Floats) -> Floats:
    """Between a triangle's direction and the mean of its corners' vectors, (T,)."""
    mean = vectors.mean(axis=1)
    lengths = np.linalg.norm(directions, axis=1) * np.linalg.norm(mean, axis=1)
    found: Floats = (directions * mean).sum(1) / lengths
    return found


@pytest.mark.parametrize("key", ["plane", "triangle", "cube", "icosphere-5", "cone-8x256"])
def test_tangents_follow_the_texture(key: str) -> None:
    made = mesh(key)
    by_u, by_v = derivatives(made)
    tangents = corners(made, "tangents")
    bitangents = tangents[..., 3:] * np.cross(corners(made, "normals"), tangents[..., :3])
    # Next to a pole a triangle spans enough longitude to turn by 10 degrees.
    assert cosines(by_u, tangents[..., :3]).min() > 0.98
    assert cosines(-by_v, bitangents).min() > 0.98


@pytest.mark.parametrize("key", SPHERES)
def test_sphere_texture_is_longitude_and_latitude(key: str) -> None:
    made = mesh(key)
    longitude, latitude = (made.uvs.astype(np.float64) - 0.5).T * [[2 * math.pi], [-math.pi]]
    ring = np.cos(latitude)
    expected = [ring * np.sin(longitude), np.sin(latitude), ring * np.cos(longitude)]
    np.testing.assert_allclose(made.positions, np.transpose(expected), atol=2e-6)


@pytest.mark.parametrize("key", SPHERES)
def test_sphere_texture_is_not_torn_at_the_seam(key: str) -> None:
    made = mesh(key)
    u = corners(made, "uvs")[..., 0]
    assert np.ptp(u, axis=1).max() <= 0.5
    assert 0 <= u.min() < u.max() < 1.25


@pytest.mark.parametrize("level", range(1, 6))
def test_every_triangle_at_a_pole_has_its_own_pole(level: int) -> None:
    made = mesh(f"icosphere-{level}")
    pole = np.flatnonzero(np.abs(made.positions[:, 1]) > 0.9999999)
    uses = Counter(made.indices.reshape(-1).tolist())
    assert len(pole) == 12
    assert {uses[int(vertex)] for vertex in pole} == {1}
    for row in made.indices[np.isin(made.indices, pole).any(1)]:
        at_pole = np.isin(row, pole)
        others = made.uvs[row[~at_pole], 0]
        np.testing.assert_allclose(made.uvs[row[at_pole], 0], others.mean(), atol=1e-6)


@pytest.mark.parametrize("level", range(8))
def test_icosphere_counts_and_error(level: int) -> None:
    made = mesh(f"icosphere-{level}")
    assert len(made.indices) == 20 * 4**level
    assert len(np.unique(made.positions, axis=0)) == 10 * 4**level + 2
    facing = face_normals(made)
    distance = (facing * corners(made)[:, 0]).sum(1) / np.linalg.norm(facing, axis=1)
    # float32 positions move a plane by as much as their rounding.
    assert ICOSPHERE_ERRORS[level] == pytest.approx(1 - distance.min(), rel=1e-6, abs=4e-7)


def test_icosphere_error_starts_at_the_inscribed_sphere_and_falls_fourfold() -> None:
    phi = (1 + math.sqrt(5)) / 2
    inscribed = phi**2 / math.sqrt(3) / math.sqrt(1 + phi**2)
    assert ICOSPHERE_ERRORS[0] == pytest.approx(1 - inscribed, rel=1e-11)
    ratios = np.divide(ICOSPHERE_ERRORS[:-1], ICOSPHERE_ERRORS[1:])
    assert (np.diff(ratios) > 0).all()
    assert ratios[-1] == pytest.approx(4, rel=1e-3)


@pytest.mark.parametrize(("level", "tolerance"), [(3, 1e-2), (5, 6e-4), (7, 4e-5)])
def test_sphere_area_and_volume_converge(level: int, tolerance: float) -> None:
    made = mesh(f"icosphere-{level}")
    assert area(made) == pytest.approx(4 * math.pi, rel=tolerance)
    assert volume(made) == pytest.approx(4 * math.pi / 3, rel=tolerance)
    assert area(made) < 4 * math.pi


@pytest.mark.parametrize(("key", "tolerance"), [("cone-4x64", 2e-3), ("cone-16x1024", 7e-6)])
def test_cone_area_and_volume_converge(key: str, tolerance: float) -> None:
    made = mesh(key)
    assert area(made) == pytest.approx(math.pi * (1 + math.sqrt(2)), rel=tolerance)
    assert volume(made) == pytest.approx(math.pi / 3, rel=tolerance)


def test_cube_and_plane_measures() -> None:
    assert area(mesh("cube")) == 6
    assert volume(mesh("cube")) == pytest.approx(1)
    assert area(mesh("plane")) == 1
    assert area(mesh("triangle")) == 0.5
    np.testing.assert_array_equal(mesh("plane").normals, np.tile([0, 1, 0], (4, 1)))


def test_cone_side_has_the_cones_own_normals() -> None:
    made = mesh("cone-4x16")
    side = made.normals[:, 1] > 0
    np.testing.assert_allclose(made.normals[side, 1], math.sqrt(0.5), atol=1e-7)
    toward_apex = np.array([0, 1, 0]) - made.positions[side]
    np.testing.assert_allclose((toward_apex * made.normals[side]).sum(1), 0, atol=2e-7)
    apex = made.positions[:, 1] == 1
    assert apex.sum() == 16
    assert len(np.unique(made.normals[apex], axis=0)) == 16


@pytest.mark.parametrize("key", CONES)
def test_cone_counts(key: str) -> None:
    stacks, sectors = map(int, key.removeprefix("cone-").split("x"))
    made = mesh(key)
    assert len(made.indices) == sectors + 2 * sectors * (stacks - 1) + sectors
    assert len(made.positions) == sectors + stacks * (sectors + 1) + sectors + 1


@pytest.mark.parametrize("key", ALL)
def test_arrays(key: str) -> None:
    made = mesh(key)
    vertices = len(made.positions)
    for name, width in (("positions", 3), ("normals", 3), ("uvs", 2), ("tangents", 4)):
        array = getattr(made, name)
        assert (array.dtype, array.shape) == (np.float32, (vertices, width))
        assert np.isfinite(array).all()
        assert not array.flags.writeable
    assert made.indices.dtype == np.uint32
    assert set(made.indices.reshape(-1).tolist()) == set(range(vertices))
    assert mesh(key) is made


def packed_arrays(made: Mesh) -> list[NDArray[np.float32]]:
    """The vertex arrays in the order of a packed mesh."""
    optional = [array for array in (made.colors, made.uvs1) if array is not None]
    return [made.positions, made.normals, made.uvs, made.tangents, *optional]


def with_extras(colors: bool, uvs1: bool) -> Mesh:
    made = mesh("cone-2x3")
    rows = len(made.positions)
    return dataclasses.replace(
        made,
        colors=np.linspace(0, 1, 4 * rows, dtype=np.float32).reshape(rows, 4) if colors else None,
        uvs1=-np.arange(2 * rows, dtype=np.float32).reshape(rows, 2) if uvs1 else None,
    )


@pytest.mark.parametrize(
    ("made", "flags"),
    [*((mesh(key), 0) for key in ALL),
     *((with_extras(bool(flags & 1), bool(flags & 2)), flags) for flags in range(4))],
)  # fmt: skip
def test_pack_round_trip(made: Mesh, flags: int) -> None:
    data = pack(made)
    vertices, indices, found_flags = struct.unpack_from("<III", data)
    assert (vertices, indices) == (len(made.positions), 3 * len(made.indices))
    assert found_flags == flags
    at = 12
    for array in packed_arrays(made):
        np.testing.assert_array_equal(np.frombuffer(data, "<f4", array.size, at), array.ravel())
        at += 4 * array.size
    np.testing.assert_array_equal(np.frombuffer(data, "<u4", indices, at), made.indices.ravel())
    assert len(data) == at + 4 * indices


def test_optional_arrays_are_read_only_too() -> None:
    made = with_extras(colors=True, uvs1=True)
    assert made.colors is not None
    assert made.uvs1 is not None
    assert not made.colors.flags.writeable
    assert not made.uvs1.flags.writeable


def test_meshes_of_models_come_from_the_asset_store() -> None:
    made = with_extras(colors=True, uvs1=False)
    key = assets.add_mesh(made, keep=False)
    assert mesh(key) is made
    with pytest.raises(NotFoundError, match="mesh-0000"):
        mesh(f"mesh-{0:032}")


def test_images_stand_upright_on_the_cube() -> None:
    """On its four sides the first row of an image (v = 0) is the upper edge."""
    made = mesh("cube")
    side = made.normals[:, 1] == 0
    np.testing.assert_array_equal(made.uvs[side, 1] == 0, made.positions[side, 1] > 0)


@pytest.mark.parametrize(
    "key",
    [
        "",
        "sphere",
        "plane ",
        "cube\n",
        "Cube",
        "icosphere",
        "icosphere--1",
        "icosphere-8",
        "icosphere-05",
        "icosphere-\u0665",
        "cone-16",
        "cone-0x8",
        "cone-257x8",
        "cone-4x2",
        "cone-4x1025",
        "cone-04x8",
        "cone-4x8x2",
        "cone-1e9x3",
        "../cube",
    ],
)
def test_bad_key_is_refused_with_what_is_allowed(key: str) -> None:
    with pytest.raises(LightbenchError) as refused:
        mesh(key)
    for allowed in (repr(key)[1:-1], "plane, triangle, cube", "0 to 7", "1 to 256", "3 to 1024"):
        assert allowed in str(refused.value)


@pytest.mark.parametrize("key", ["icosphere-0", "icosphere-7", "cone-1x3", "cone-256x1024"])
def test_the_limits_themselves_are_allowed(key: str) -> None:
    made = mesh(key)
    assert made.indices.max() == len(made.positions) - 1
