"""Rays where a shape's formulas are strained: along faces, through corners, apex and poles."""

import itertools

import numpy as np
import pytest

from lightbench.exact.directions import Array, unit
from lightbench.glsl import call
from lightbench.shapes import mesh

FILES = {"cube": "lib/shapes.glsl", "round": "lib/shapes.glsl", "cone": "lib/cone.glsl"}
# The lowest point, and from where the axes cross each shape in its middle.
LOW = {"cube": -0.5, "round": -1.0, "cone": 0.0}


def asked(function: str, *arguments: object) -> Array:
    """What a function of rays and shapes answers; numbers all."""
    file = "lib/cone.glsl" if function.startswith(("cone", "onBase")) else "lib/shapes.glsl"
    found = call(file, function, *(np.asarray(a, float) for a in arguments))
    assert np.isfinite(found).all(), function
    return found.astype(np.float64)


def within(shape: str, count: int = 2000) -> Array:
    """Points in a shape."""
    p = np.random.default_rng(5).uniform(-1.0, 1.0, (20 * count, 3))
    inside = {
        "cube": np.abs(p).max(axis=1) < 0.5,
        "round": np.linalg.norm(p, axis=1) < 1.0,
        "cone": (p[:, 1] > 0.0) & (np.hypot(p[:, 0], p[:, 2]) < 1.0 - p[:, 1]),
    }
    return np.asarray(p[inside[shape]][:count])


@pytest.mark.parametrize("shape", FILES)
@pytest.mark.parametrize("away", [3.0, 1e3])
def test_no_ray_misses_what_it_is_aimed_at(shape: str, away: float) -> None:
    """Towards any point of a body from afar: it enters before that, and leaves behind it."""
    target = within(shape)
    direction = unit(np.random.default_rng(6).normal(size=target.shape))
    origin = target - away * direction
    entered, left = (asked(f"{shape}{end}", origin, direction) for end in ("Hit", "Exit"))
    assert (entered > 0.0).all()
    assert (entered <= left).all()
    assert (entered < away * (1.0 + 1e-6) + 1e-4).all()
    assert (left > away * (1.0 - 1e-6) - 1e-4).all()


@pytest.mark.parametrize("shape", FILES)
def test_from_within_a_body_is_only_left(shape: str) -> None:
    origin = 0.9 * within(shape)
    origin[:, 1] += 0.02
    direction = np.random.default_rng(7).normal(size=origin.shape)
    np.testing.assert_array_equal(asked(f"{shape}Hit", origin, direction), -1.0)
    assert (asked(f"{shape}Exit", origin, direction) > 0.0).all()
    behind = origin + 9.0 * direction / np.linalg.norm(direction, axis=1, keepdims=True)
    for end in ("Hit", "Exit"):
        np.testing.assert_array_equal(asked(f"{shape}{end}", behind, direction), -1.0)


@pytest.mark.parametrize("shape", FILES)
def test_along_an_axis(shape: str) -> None:
    """Two components of the direction are 0, of either sign: through the middle, and far off it."""
    for axis, sign, zero in itertools.product(range(3), (-1.0, 1.0), (0.0, -0.0)):
        direction = np.full(3, zero)
        direction[axis] = sign
        middle = np.array([0.0, 0.25, 0.0])
        origin = middle - 4.0 * direction * np.abs(np.eye(3)[axis])
        high = {"cube": 0.5, "round": 1.0, "cone": 1.0}[shape]
        ends = {
            "cube": (-0.5, 0.5), "round": 2 * (np.sqrt(1 - 0.25**2),), "cone": (-0.75, 0.75),
        }[shape]  # fmt: skip
        low, up = (-ends[-1], ends[-1]) if axis != 1 else (LOW[shape] - 0.25, high - 0.25)
        first, last = (4.0 + low, 4.0 + up) if sign > 0.0 else (4.0 - up, 4.0 - low)
        assert asked(f"{shape}Hit", [origin], [direction])[0] == pytest.approx(first, rel=1e-6)
        assert asked(f"{shape}Exit", [origin], [direction])[0] == pytest.approx(last, rel=1e-6)
        aside = origin + 5.0 * np.roll(np.eye(3)[axis], 1)
        for end in ("Hit", "Exit"):
            assert asked(f"{shape}{end}", [aside], [direction])[0] == -1.0


def test_within_the_plane_of_a_cube_s_face() -> None:
    """Entered and left at its edges, or missed by both; a hair to either side it is clear."""
    beside = (0.5, -0.5, 0.49999, -0.49999, 0.50001, -0.50001)
    origin = np.array([[-2.0, y, 0.1] for y in beside])
    for zero in (0.0, -0.0):
        hits, left = (asked(f"cube{end}", origin, [[1.0, zero, zero]]) for end in ("Hit", "Exit"))
        # One of the two: so has one of two cubes side by side what runs between them.
        assert sorted(zip(hits[:2], left[:2], strict=True)) == [(-1.0, -1.0), (1.5, 2.5)]
        np.testing.assert_allclose(hits[2:], [1.5, 1.5, -1.0, -1.0], rtol=1e-6)
        np.testing.assert_allclose(left[2:], [2.5, 2.5, -1.0, -1.0], rtol=1e-6)


def test_a_ray_has_not_met_what_it_starts_on() -> None:
    for function, origin, direction in (
        ("coneHit", [0, 1, 0], [0, -1, 0]), ("coneExit", [0, 1, 0], [0, 1, 0]),
        ("coneBase", [0.5, 0, 0], [0, 1, 0]), ("cubeHit", [0.5, 0, 0.1], [-1, 0, 0]),
        ("cubeExit", [0.5, 0, 0.1], [1, 0, 0]), ("roundHit", [0, 0, 1], [0, 0, -1]),
        ("roundExit", [0, 0, 1], [0, 0, 1]),
    ):  # fmt: skip
        assert asked(function, [origin], [direction])[0] == -1.0, function
    for side in (1.0, -1.0):
        assert asked("planeHit", [[0.1, 0, 0.2]], [[0, -side, 0]], [side])[0] == -1.0


def test_a_sphere_is_met_from_near_by() -> None:
    """Straight down from a height: that is how far it is."""
    height = np.array([1e-3, 0.02, 0.1, 0.3, 0.41, 0.6])
    up = unit(np.random.default_rng(8).normal(size=(len(height), 3)))
    found = asked("roundHit", (1.0 + height[:, None]) * up, -up)
    np.testing.assert_allclose(found, height, rtol=1e-6, atol=3e-7)


def test_an_edge_belongs_to_its_shape() -> None:
    """Rims, corners and edges, where float32 says exactly that a ray comes to them."""
    assert asked("coneBase", [[1, -2, 0]], [[0, 1, 0]])[0] == 2.0
    assert asked("planeHit", [[0.5, 3, -0.5]], [[0, -1, 0]], [1.0])[0] == 3.0
    for end in ("Hit", "Exit"):
        assert asked(f"cube{end}", [[-1.5, -0.5, 0]], [[1, 1, 0]])[0] == 1.0
    # Within the plane of the base, through its middle.
    assert asked("coneHit", [[-3, 0, 0]], [[1, 0, 0]])[0] == 2.0
    assert asked("coneExit", [[-3, 0, 0]], [[1, 0, 0]])[0] == 4.0
    edges = [[0.5, 0.5, 0.1], [-0.5, 0.1, 0.5], [0.1, -0.5, 0.5], [0.5, 0.5, -0.5]]
    faces = [[1, 0, 0], [-1, 0, 0], [0, -1, 0], [1, 0, 0]]
    np.testing.assert_array_equal(asked("cubeNormal", edges), faces)


def test_a_ray_within_the_plane_never_meets_it() -> None:
    for height, zero, side in itertools.product((0.0, 0.1, -0.1), (0.0, -0.0), (1.0, -1.0)):
        found = asked("planeHit", [[-2.0, height, 0.0]], [[1.0, zero, 0.0]], [side])
        assert found[0] == -1.0
        assert asked("coneBase", [[-2.0, height, 0.0]], [[1.0, zero, 0.0]])[0] == -1.0


def test_a_plane_is_seen_from_its_side_only() -> None:
    above, down = [[0.1, 2.0, 0.1]], [[0.0, -1.0, 0.0]]
    below, up = [[0.1, -2.0, 0.1]], [[0.0, 1.0, 0.0]]
    for origin, direction, side, found in (
        (above, down, 1.0, 2.0), (above, down, -1.0, -1.0), (below, up, -1.0, 2.0),
        (below, up, 1.0, -1.0), (above, up, 1.0, -1.0), (above, up, -1.0, -1.0),
    ):  # fmt: skip
        assert asked("planeHit", origin, direction, [side])[0] == found


def test_the_apex_of_a_cone_is_no_hole() -> None:
    """From straight above it and from above aslant, on it and a hair beside it."""
    aside = np.array([0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3])
    for tilt, height in itertools.product((0.0, 0.3, 0.9), (2.0, 50.0, 1e3)):
        direction = unit(np.array([tilt, -1.0, 0.0]))
        origin = np.array([0.0, 1.0, 0.0]) - height * direction + np.outer(aside, [0.0, 0.0, 1.0])
        found = asked("coneHit", origin, [direction])
        np.testing.assert_allclose(found, height, atol=4e-3, rtol=1e-6)


def test_along_the_side_of_a_cone() -> None:
    """Parallel to it, where the quadratic's first number is 0: within, beside and far off."""
    direction = unit(np.array([1.0, -1.0, 0.0]))
    origin = np.array([[-2.0, 2.9, 0.0], [-2.0, 3.1, 0.0], [-2.0, 2.5, 0.0], [2.0, 1.0, 0.0]])
    found = asked("coneHit", origin, [direction])
    p = origin[[0, 2]] + found[[0, 2], None] * direction
    np.testing.assert_allclose(np.hypot(p[:, 0], p[:, 2]), 1.0 - p[:, 1], atol=1e-5)
    np.testing.assert_array_equal(found[[1, 3]], -1.0)
    level = asked("coneHit", [[-3.0, 1.0, 0.0], [-3.0, 1.5, 0.0]], [[1.0, 0.0, 0.0]])
    assert level[1] == -1.0
    assert level[0] in (-1.0, 3.0)


def test_frames_where_they_turn() -> None:
    """Poles and an apex have a unit normal and tangent across each other, as edges have."""
    ends = {
        "round": [[0, 1, 0], [0, -1, 0]],
        "cone": [[0, 1, 0], [1, 0, 0], [0, 0, 0]],
        "cube": [[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.0, 0.5)],
    }
    for shape, points in ends.items():
        n, t = (unit(asked(f"{shape}{name}", points)) for name in ("Normal", "Tangent"))
        assert np.isfinite(n).all()
        assert np.isfinite(t).all()
        np.testing.assert_allclose((n * t).sum(axis=1), 0.0, atol=1e-6)
        uv = asked(f"{shape}Uv", points)
        assert ((uv >= 0.0) & (uv <= 1.0)).all()


@pytest.mark.parametrize(("shape", "key"), [("plane", "plane"), ("cube", "cube")])
def test_points_have_what_their_mesh_has(shape: str, key: str) -> None:
    """Normal, tangent and coordinates within each triangle, as between its vertices."""
    made = mesh(key)
    shares = np.array([[0.2, 0.3, 0.5], [0.6, 0.1, 0.3]])
    for name, kept in (("Normal", made.normals), ("Tangent", made.tangents), ("Uv", made.uvs)):
        between = np.einsum("sk,fkc->sfc", shares, np.asarray(kept)[made.indices.reshape(-1, 3)])
        points = np.einsum("sk,fkc->sfc", shares, made.positions[made.indices.reshape(-1, 3)])
        found = asked(f"{shape}{name}", points.reshape(-1, 3))
        want = between.reshape(len(found), -1)[:, : found.shape[1]]
        np.testing.assert_allclose(found, want, atol=1e-6)


def test_a_longitude_on_the_axis() -> None:
    points = np.array([[0.0, 1, 0], [0, -3, 0], [0, 0, 0], [-0.0, 1, -0.0], [1e-30, 1, 1e-30]])
    assert (np.abs(call("lib/longitude.glsl", "longitude", points)) <= 0.5).all()
    np.testing.assert_array_equal(call("lib/longitude.glsl", "longitude", points[:3]), 0.0)
    np.testing.assert_allclose(
        call("mappings/spherical.glsl", "mapping", points[:2]), [[0.5, 0], [0.5, 1]], atol=1e-6
    )


def test_a_triangle_along_the_ray_is_missed() -> None:
    """Seen edge-on, and so small that its area is nothing in float32."""
    v0, e1, e2 = [[0.0, 0, 0]], [[1.0, 0, 0]], [[0.0, 0, 1]]
    found = call("lib/triangle.glsl", "triangleHit", [[-2.0, 0, 0.2]], [[1.0, 0, 0]], v0, e1, e2)
    assert found[0] == -1.0
    tiny = np.array([[1e-25, 0, 0]]), np.array([[0, 1e-25, 0]])
    found = call("lib/triangle.glsl", "triangleHit", [[0.1, 0.1, 2]], [[0, 0, -1]], v0, *tiny)
    assert found[0] == -1.0
