"""Rays through the table of a mesh: every one meets what it meets in float64."""

from __future__ import annotations

import numpy as np
import pytest

import lightbench as lb
from lightbench import hierarchy
from lightbench.bvh import CELLS, CORNERS, HEADER, MARGIN, ORDERS, WIDTH, bake
from lightbench.exact.directions import Array, unit
from lightbench.hierarchy import DEEPEST, LEAF, Hierarchy, build
from lightbench.mesh import Mesh
from lightbench.shapes import mesh as shape
from tests.meshes import FAR, Rays, distances, flat, traced
from tests.support import shared_models

# Roundings of a ray's way to a triangle that a hit may be off by.
OFF = 8.0


def soup(count: int, seed: int, size: float = 0.3) -> Mesh:
    """Random triangles that cut each other, in a cube of edge 2."""
    random = np.random.default_rng(seed)
    corners = random.uniform(-1, 1, (count, 1, 3)) + random.normal(size=(count, 3, 3)) * size
    return flat(corners.reshape(-1, 3), np.arange(3 * count))


def through(mesh: Mesh, count: int, seed: int, distance: float = 3.0) -> Rays:
    """Rays from around a mesh to points in its box."""
    random = np.random.default_rng(seed)
    low, high = mesh.positions.min(axis=0), mesh.positions.max(axis=0)
    middle, half = (low + high) / 2, (high - low) / 2
    target = middle + random.uniform(-1, 1, (count, 3)) * half
    origin = middle + distance * half.max() * unit(random.normal(size=(count, 3)))
    return towards(origin, target)


def towards(origin: Array, target: Array) -> Rays:
    """Unit rays from points to points, as float32 has them."""
    start = np.asarray(origin, np.float32)
    return Rays(start, unit(target - start.astype(np.float64)).astype(np.float32))


def assert_as_in_float64(mesh: Mesh, rays: Rays) -> None:
    """The nearest hit lies between those of triangles a little larger and a little smaller."""
    hit = traced(bake(mesh), rays)
    found = np.where(hit[:, 1] >= 0, hit[:, 0], np.inf)
    assert (found >= distances(mesh, rays, OFF)).all()
    assert (found <= distances(mesh, rays, -OFF)).all()


@pytest.mark.parametrize("count", [1, 2, 3, 5, 17, 300])
def test_a_soup(count: int) -> None:
    mesh = soup(count, count)
    assert_as_in_float64(mesh, through(mesh, 4000, 1))
    assert_as_in_float64(mesh, through(mesh, 4000, 2, distance=0.3))


# Meshes whose every edge and vertex is shared
BALLS = [shape("icosphere-0"), shape("icosphere-2"), shape("icosphere-3")]


@pytest.mark.parametrize("ball", BALLS, ids=lambda ball: str(len(ball.indices)))
def test_a_ball(ball: Mesh) -> None:
    assert_as_in_float64(ball, through(ball, 2000, 3))


@pytest.mark.parametrize("name", ["Duck.glb", "BoxTextured.glb"])
def test_a_model(name: str) -> None:
    path = shared_models() / name
    if not path.exists():
        pytest.skip("no shared models")
    scene = lb.load(str(path))
    for asset in scene.meshes.values():
        model = shape(asset.mesh)
        assert_as_in_float64(model, through(model, 1000, 4))


AXES = np.concatenate([np.eye(3), -np.eye(3)])


@pytest.mark.parametrize("ball", BALLS, ids=lambda ball: str(len(ball.indices)))
def test_a_ball_has_a_front_and_a_back(ball: Mesh) -> None:
    """From without its front is the near side, its back the far one; from within all is back."""
    rays, table = through(ball, 2000, 31), bake(ball)
    hit, front, back = (traced(table, rays, body) for body in ("hit", "front", "back"))
    met = hit[:, 1] >= 0
    np.testing.assert_array_equal(front, hit)
    np.testing.assert_array_equal(back[:, 1] >= 0, met)
    assert (back[met, 0] > hit[met, 0]).all()
    inside = Rays(np.zeros_like(rays.origin), rays.direction)
    np.testing.assert_array_equal(traced(table, inside, "back"), traced(table, inside))
    assert (traced(table, inside, "front")[:, 1] == -1).all()


def test_along_the_axes() -> None:
    """Two components of the direction are 0, and some origins lie in the planes of boxes."""
    mesh = soup(50, 6)
    places = np.concatenate([np.random.default_rng(5).uniform(-1, 1, (300, 3)), mesh.positions])
    for axis in AXES:
        origin = (places - 4.0 * axis).astype(np.float32)
        direction = np.tile(axis, (len(origin), 1)).astype(np.float32)
        for zero in (0.0, -0.0):
            direction[direction == 0.0] = zero
            assert_as_in_float64(mesh, Rays(origin, direction))


def test_a_flat_mesh_and_rays_within_its_plane() -> None:
    plane = shape("plane")
    assert_as_in_float64(plane, through(plane, 2000, 7))
    random = np.random.default_rng(8)
    origin = random.uniform(-2, 2, (2000, 3)) * (1, 0, 1)
    within = towards(origin, origin + random.normal(size=(2000, 3)) * (1, 0, 1))
    assert (traced(bake(plane), within)[:, 1] == -1).all()


def aimed(ball: Mesh, origin: Array) -> Rays:
    """Rays from a point at vertices, at middles and other points of edges, and at random ones."""
    corners = ball.positions.astype(np.float64)[ball.indices]
    random = np.random.default_rng(9)
    share = random.uniform(0, 1, (len(corners), 3, 1))
    share[:, 0] = 0.5
    edges = corners + share * (np.roll(corners, 1, axis=1) - corners)
    everywhere = unit(random.normal(size=(100_000, 3)))
    target = np.concatenate([ball.positions, edges.reshape(-1, 3), everywhere])
    return towards(np.broadcast_to(origin, target.shape), target)


@pytest.mark.parametrize("level", [0, 3, 5])
@pytest.mark.parametrize("origin", [(0.0, 0.0, 0.0), (0.3, -0.5, 0.1)])
def test_no_ray_leaves_a_closed_ball(level: int, origin: tuple[float, ...]) -> None:
    ball = shape(f"icosphere-{level}")
    rays = aimed(ball, np.array(origin))
    hit = traced(bake(ball), rays)
    assert (hit[:, 1] >= 0).all()
    met = rays.origin + hit[:, :1] * rays.direction
    assert np.linalg.norm(met, axis=1).max() < 1.0 + 1e-6


def test_no_ray_passes_a_ball_from_far_away() -> None:
    """Where a triangle is a few roundings of the way wide, none opens: its near side is met."""
    ball = shape("icosphere-5")
    target = 0.9 * ball.positions.astype(np.float64)
    for way in (10.0, 1e3, 1e4):
        rays = towards(np.broadcast_to((way, 0.4 * way, -0.3 * way), target.shape), 0.9 * target)
        hit = traced(bake(ball), rays)
        assert (hit[:, 1] >= 0).all()
        assert (hit[:, 0] < np.linalg.norm(rays.origin, axis=1)).all()


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_mesh_of_any_size_anywhere(scale: float) -> None:
    random = soup(60, 10)
    for offset in (0.0, 1e4 * scale):
        positions = random.positions.astype(np.float64) * scale + (offset, -offset, offset)
        mesh = flat(positions, random.indices)
        assert_as_in_float64(mesh, through(mesh, 1000, 11))


def test_a_mesh_of_light_years() -> None:
    """A ray crosses it in steps of 3e-13 cells a unit."""
    small = soup(60, 33)
    mesh = flat(small.positions * np.float32(1e17), small.indices)
    assert_as_in_float64(mesh, through(mesh, 1000, 34))


def test_directions_need_not_be_unit() -> None:
    ball = shape("icosphere-2")
    rays = through(ball, 1000, 12)
    unit_hit = traced(bake(ball), rays)
    for length in (1e-3, 8.0, 1e3):
        hit = traced(bake(ball), Rays(rays.origin, rays.direction * np.float32(length)))
        met = (hit[:, 1] >= 0) & (hit[:, 1] == unit_hit[:, 1])
        assert met.mean() > 0.3
        assert np.allclose(hit[met, 0] * length, unit_hit[met, 0], rtol=1e-5)


def test_triangles_without_an_area_are_never_met() -> None:
    good = soup(20, 13)
    a, b = np.random.default_rng(14).uniform(-1, 1, (2, 40, 3))
    points = np.concatenate([a, a, a, a, b, a, a, b, (a + b) / 2])
    flats = np.arange(len(points)).reshape(3, 3, 40).transpose(0, 2, 1).reshape(-1, 3)
    positions = np.concatenate([good.positions, points])
    indices = np.concatenate([good.indices, flats + len(good.positions)])
    mixed = flat(np.round(positions * 64) / 64, indices)
    assert_as_in_float64(mixed, through(mixed, 2000, 15))
    alone = flat(points[:240], flats[:80])
    table = bake(alone)
    assert table[0, 3] == 0
    assert (traced(table, through(alone, 1000, 16))[:, 1] == -1).all()


def test_an_empty_mesh_is_never_met() -> None:
    rays = through(soup(5, 1), 100, 17)
    table = bake(flat(np.zeros((0, 3)), []))
    assert (traced(table, rays)[:, 1] == -1).all()


def test_a_ray_passes_over_the_triangle_that_it_leaves() -> None:
    mesh = soup(100, 18)
    rays = through(mesh, 2000, 19)
    table = bake(mesh)
    first = traced(table, rays)
    met = first[:, 1] >= 0
    behind = Rays(rays.origin[met], rays.direction[met], leaves=first[met, 1])
    second = traced(table, behind)
    assert (second[:, 1] != first[met, 1]).all()
    again = second[:, 1] >= 0
    assert again.mean() > 0.3
    assert (second[again, 0] >= first[met, 0][again]).all()
    only = flat(mesh.positions[:3], [0, 1, 2])
    alone = traced(bake(only), through(only, 1000, 20))[:, 1] >= 0
    left = through(only, 1000, 20)
    left = Rays(left.origin, left.direction, leaves=0)
    assert alone.any()
    assert (traced(bake(only), left)[:, 1] == -1).all()


def test_nothing_is_met_beyond_its_reach() -> None:
    mesh = soup(100, 21)
    rays = through(mesh, 2000, 22)
    table = bake(mesh)
    hit = traced(table, rays)
    met = hit[:, 1] >= 0
    for share, seen in ((1.001, True), (0.999, False)):
        reach = np.where(met, hit[:, 0] * share, FAR)
        bounded = Rays(rays.origin, rays.direction, reach=reach)
        assert ((traced(table, bounded)[met, 1] >= 0) == seen).all()
    missed = traced(table, Rays(rays.origin, rays.direction, reach=7.0))
    assert (missed[~met, 0] == 7.0).all()


@pytest.mark.parametrize("base", [1, WIDTH - 1, 5 * WIDTH + 77])
def test_a_table_behind_others(base: int) -> None:
    ball = shape("icosphere-2")
    table, rays = bake(ball), through(ball, 1000, 23)
    for body in ("hit", "plane", "MESH_UVS"):
        seen = traced(table, rays)[:, 1] >= 0
        here = traced(table, rays, body)[seen]
        assert np.array_equal(traced(table, rays, body, base)[seen], here)


def leaves(mesh: Mesh, rays: Rays, larger: float) -> Array:
    """How many leaves' boxes, so much larger at each side, a ray meets before its reach."""
    tree = build(*boxes(mesh))
    leaf = tree.child == 0
    low, high = tree.low[leaf] - larger, tree.high[leaf] + larger
    origin, direction = rays.origin[:, None].astype(np.float64), rays.direction[:, None]
    a, b = (low - origin) / direction, (high - origin) / direction
    enter = np.minimum(a, b).max(axis=2).clip(0.0)
    leave = np.minimum(np.maximum(a, b).min(axis=2), np.reshape(rays.reach, (-1, 1)))
    return np.asarray((enter <= leave).sum(axis=1), np.float64)


@pytest.mark.parametrize(("distance", "reach"), [(3.0, FAR), (3.0, 3.0), (1e3, FAR), (1e4, FAR)])
def test_only_leaves_in_the_way_are_looked_at(distance: float, reach: float) -> None:
    """And all of those: boxes grow by what float32 loses on a long way, and no more than twice."""
    mesh = soup(500, 31, size=0.05)
    rays = through(mesh, 3000, 32, distance)
    rays = Rays(rays.origin, rays.direction, reach=reach)
    found = traced(bake(mesh), rays, "leaves")[:, 0]
    cell = np.ptp(mesh.positions, axis=0).max() / CELLS
    lost = 32 * 2.0**-24 * np.abs(rays.origin).max()
    assert (found >= leaves(mesh, rays, 0.0)).all()
    assert (found <= leaves(mesh, rays, (2.5 + MARGIN) * cell + lost)).all()


# What a hit has


def colored() -> Mesh:
    """Random triangles with everything that a vertex can have."""
    bare, random = soup(40, 24), np.random.default_rng(25)
    count = len(bare.positions)
    normals = unit(random.normal(size=(count, 3))).astype(np.float32)
    arrays = [random.uniform(-1, 1, (count, k)).astype(np.float32) for k in (2, 4, 4, 2)]
    uvs, tangents, colors, uvs1 = arrays
    return Mesh(bare.positions, normals, uvs, tangents, bare.indices, colors, uvs1)


def test_attributes_lie_between_those_of_the_vertices() -> None:
    mesh = colored()
    rays, table = through(mesh, 3000, 26), bake(mesh)
    hit = traced(table, rays)
    met = hit[:, 1] >= 0
    assert met.mean() > 0.3
    at = table[2, 0]
    corners = table[table[1, 3] : at].reshape(-1, CORNERS, 4)
    indices = corners[hit[met, 1].astype(int), :, 3]
    u, v = hit[met, 2:].T
    weights = np.stack([1 - u - v, u, v], axis=-1)[..., None]
    position = (mesh.positions[indices] * weights).sum(axis=1)
    assert np.abs(position - (rays.origin + hit[:, :1] * rays.direction)[met]).max() < 1e-5
    assert mesh.colors is not None
    assert mesh.uvs1 is not None
    uvs = np.column_stack([mesh.uvs, mesh.uvs1])
    for name, values in (
        ("MESH_NORMAL", np.pad(mesh.normals, ((0, 0), (0, 1)))), ("MESH_UVS", uvs),
        ("MESH_TANGENT", mesh.tangents), ("MESH_COLOR", mesh.colors),
    ):  # fmt: skip
        want = (values[indices] * weights).sum(axis=1)
        assert np.abs(traced(table, rays, name)[met] - want).max() < 1e-6, name
    a, b, c = np.moveaxis(mesh.positions[indices].astype(np.float64), 1, 0)
    plane = np.column_stack([np.cross(b - a, c - a), (b - a)[:, 0]])
    assert np.abs(traced(table, rays, "plane")[met] - plane).max() < 1e-6


def test_a_mesh_without_colours_has_no_texels_for_them() -> None:
    mesh = colored()
    bare = Mesh(mesh.positions, mesh.normals, mesh.uvs, mesh.tangents, mesh.indices)
    assert len(bake(mesh)) - len(bake(bare)) == len(mesh.positions)


# How tables and hierarchies are made


def boxes(mesh: Mesh) -> tuple[Array, Array]:
    corners = mesh.positions.astype(np.float64)[mesh.indices]
    return corners.min(axis=1), corners.max(axis=1)


def nested() -> Mesh:
    """Each triangle holds the next, half as large: no cut parts more than a few off."""
    corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]) * 0.5 ** np.arange(400)[:, None, None]
    return flat(corner.reshape(-1, 3).clip(1e-30), np.arange(1200))


SAME = flat(np.tile([[0, 0, 0], [1, 0, 0], [0, 1, 0.5]], (100, 1)), np.arange(300))
TREES = {"soup": soup(700, 27), "ball": BALLS[2], "one": soup(1, 1), "same": SAME,
         "nested": nested()}  # fmt: skip


@pytest.mark.parametrize("name", TREES)
def test_the_shape_of_a_hierarchy(name: str) -> None:
    low, high = boxes(TREES[name])
    tree = build(low, high)
    leaf = tree.child == 0
    assert len(tree.levels) - 1 <= DEEPEST
    assert (tree.count[leaf] >= 1).all()
    assert (tree.count[leaf] <= LEAF).all()
    assert (tree.count[~leaf] == 0).all()
    held = [tree.order[s : s + n] for s, n in zip(tree.start[leaf], tree.count[leaf], strict=True)]
    assert sorted(np.concatenate(held)) == list(range(len(low)))
    for node, numbers in zip(np.flatnonzero(leaf), held, strict=True):
        assert np.array_equal(tree.low[node], low[numbers].min(axis=0))
        assert np.array_equal(tree.high[node], high[numbers].max(axis=0))
    first, second = tree.child[~leaf], tree.child[~leaf] + 1
    assert sorted([0, *first, *second]) == list(range(len(leaf)))
    assert np.array_equal(tree.low[~leaf], np.minimum(tree.low[first], tree.low[second]))
    assert np.array_equal(tree.high[~leaf], np.maximum(tree.high[first], tree.high[second]))


def cost(tree: Hierarchy) -> float:
    """Nodes that a ray through the whole looks at, by their surface."""
    x, y, z = (tree.high - tree.low).T
    surface = x * y + y * z + z * x
    inner = np.flatnonzero(tree.child)
    return float(2 * surface[inner].sum() / surface[0])


def test_cuts_are_where_they_cost_least(monkeypatch: pytest.MonkeyPatch) -> None:
    """A few large boxes among small ones: halves by their number cost a quarter more."""
    random = np.random.default_rng(28)
    size = np.where(np.arange(2000) % 50 == 0, 1.0, 0.01)[:, None]
    low = random.uniform(-1, 1, (2000, 3)) ** 3
    least = cost(build(low, low + size))
    assert least < 40.0
    monkeypatch.setattr(hierarchy, "DEEPEST", 10)
    assert cost(build(low, low + size)) > 1.2 * least


@pytest.mark.parametrize("deepest", [9, 10, 12])
def test_no_more_levels_than_are_allowed(deepest: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """256 leaves take 9 levels at least; without the bound this one has more than 12."""
    low = np.geomspace(1e-30, 1.0, LEAF * 256)[:, None] * np.ones(3)
    assert len(build(low, 2 * low).levels) - 1 > 12
    monkeypatch.setattr(hierarchy, "DEEPEST", deepest)
    tree = build(low, 2 * low)
    assert len(tree.levels) - 1 <= deepest
    assert tree.count.sum() == len(low)
    assert tree.count.max() <= LEAF


def test_the_orders_of_a_table() -> None:
    """Every node but the root is its parent's next or its first sibling's; the near one is next."""
    table = bake(soup(200, 29))
    count = table[0, 3]
    assert table[1, 3] == HEADER + ORDERS * count
    for order in range(ORDERS):
        nodes = table[HEADER + order * count :][:count]
        after = nodes[:, 3]
        at = np.arange(count)
        ends = np.where(after > 0, at + after, at + 1)
        assert (ends <= count).all()
        assert ends[0] == count
        inner = np.flatnonzero(after > 0)
        assert np.array_equal(ends[ends[inner + 1]], ends[inner])
        near, far = nodes[:, :3] & 0xFFFF, (nodes[:, :3] >> 16) + 32768
        for child in (inner + 1, ends[inner + 1]):
            assert (near[child] >= near[inner]).all()
            assert (far[child] <= far[inner]).all()


def test_a_table_is_always_the_same() -> None:
    assert np.array_equal(bake(soup(300, 30)), bake(soup(300, 30)))


def test_a_ball_from_one_side() -> None:
    """From outside, its front is near and its back far; from within, all is back."""
    ball = shape("icosphere-4")
    random = np.random.default_rng(12)
    outside = 3 * unit(random.normal(size=(3000, 3)))
    inward = towards(outside, 0.5 * random.uniform(-1, 1, (3000, 3)))
    table = bake(ball)
    near, far = traced(table, inward, "front"), traced(table, inward, "back")
    np.testing.assert_array_equal(near, traced(table, inward))
    along = (inward.origin * inward.direction).sum(axis=1)
    root = np.sqrt(along**2 - (inward.origin.astype(np.float64) ** 2).sum(axis=1) + 1)
    np.testing.assert_allclose(near[:, 0], -along - root, atol=2e-2)
    np.testing.assert_allclose(far[:, 0], -along + root, atol=2e-2)
    within = towards(0.3 * unit(random.normal(size=(3000, 3))), outside)
    assert (traced(table, within, "front")[:, 1] == -1).all()
    assert (traced(table, within, "back")[:, 1] >= 0).all()


# The tests that a broken shader fails, the quickest first.
TRACED = (
    "test_along_the_axes",
    "test_attributes_lie_between_those_of_the_vertices",
    "test_a_flat_mesh_and_rays_within_its_plane",
    "test_a_mesh_of_any_size_anywhere",
    "test_a_mesh_of_light_years",
    "test_a_ball_from_one_side",
    "test_a_ray_passes_over_the_triangle_that_it_leaves",
    "test_a_soup",
    "test_a_table_behind_others",
    "test_an_empty_mesh_is_never_met",
    "test_directions_need_not_be_unit",
    "test_no_ray_leaves_a_closed_ball",
    "test_no_ray_passes_a_ball_from_far_away",
    "test_nothing_is_met_beyond_its_reach",
    "test_only_leaves_in_the_way_are_looked_at",
)
