"""The tree of spheres: no object that a ray meets is lost, and most others are passed over."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import lightbench as lb
from lightbench import traced
from lightbench.errors import SceneError
from lightbench.exact.directions import Array, unit
from lightbench.library import read_library
from lightbench.plan import plan
from lightbench.render import on_gl_thread, renderer
from lightbench.settings import Setting
from lightbench.sphere_tree import MOST_OBJECTS, NUMBER_BITS, ROOM, sphere_tree
from tests.crowds import COLORS, CROWDS, crowd_scene
from tests.rays import rays, sphere
from tests.support import SHADERS, assert_sound, copy_of_shaders, library

SIZE = (160, 120)
LIST = "stages/listed.glsl"
FLAT = [{"unlit": True, "base_color": color} for color in COLORS.tolist()]
# What float32 may lose, as a share of the size and of the distance of a ball.
LOST = 3e-6


class Tree:
    """A tree's nodes: spheres (N, 4), the object of a leaf, or -1, and how many nodes it has."""

    def __init__(self, texels: list[float]) -> None:
        nodes = np.array(texels, np.float32).reshape(-1, 4)
        assert nodes.astype(float).ravel().tolist() == texels
        number = nodes[:, 3].copy().view(np.int32) & ((1 << NUMBER_BITS) - 1)
        leaf = nodes[:, 3] < 0
        nodes[leaf, 3] *= -1
        self.spheres = nodes.astype(np.float64)
        self.object = np.where(leaf, number, -1)
        self.below = np.where(leaf, 1, number)

    def __len__(self) -> int:
        return len(self.object)


def about(balls: Array) -> Array:
    """In float32, with room, as the plan has them."""
    return (balls * [1, 1, 1, ROOM]).astype(np.float32).astype(np.float64)


def tree_of(balls: Array) -> Tree:
    return Tree(sphere_tree(about(balls).tolist()))


@pytest.mark.parametrize("name", CROWDS)
def test_every_sphere_is_within_those_above(name: str) -> None:
    balls = about(CROWDS[name])
    tree = tree_of(CROWDS[name])
    assert len(tree) == 2 * len(balls) - 1
    assert tree.below[0] == len(tree)
    assert sorted(tree.object[tree.object >= 0]) == list(range(len(balls)))
    for node, (own, end) in enumerate(zip(tree.spheres, tree.below, strict=True)):
        inside = tree.object[node : node + end]
        held = balls[inside[inside >= 0]]
        assert (np.linalg.norm(held[:, :3] - own[:3], axis=1) + held[:, 3] <= own[3]).all()
        if end > 1:
            second = node + 1 + tree.below[node + 1]
            assert second + tree.below[second] == node + end


@pytest.mark.parametrize("name", CROWDS)
def test_what_begins_nearer_comes_first(name: str) -> None:
    tree = tree_of(CROWDS[name])
    begins = np.linalg.norm(tree.spheres[:, :3], axis=1) - tree.spheres[:, 3]
    inner = np.flatnonzero(tree.below > 1)
    assert (begins[inner + 1] <= begins[inner + 1 + tree.below[inner + 1]]).all()


def looked_at(tree: Tree, origin: Array, direction: Array) -> tuple[int, NDArray[np.int64]]:
    """How many nodes a ray looks at, and the objects that it is led to."""
    f = origin - tree.spheres[:, :3]
    along = -f @ direction
    near = np.linalg.norm(f + along[:, None] * direction, axis=1)
    met = (near <= tree.spheres[:, 3]) & (along >= -tree.spheres[:, 3])
    at, count, found = 0, 0, list[int]()
    while at < len(tree):
        count += 1
        if met[at] and tree.object[at] >= 0:
            found.append(tree.object[at])
        at += 1 if met[at] else int(tree.below[at])
    return count, np.array(sorted(found), np.int64)


@pytest.mark.parametrize("name", CROWDS)
def test_a_ray_is_led_to_every_object_that_it_meets(name: str) -> None:
    """From everywhere, to everywhere; of a thousand alike it looks at few."""
    balls = CROWDS[name]
    tree, random = tree_of(balls), np.random.default_rng(7)
    counts = []
    for _ in range(200):
        middle = balls[random.integers(len(balls)), :3]
        origin = middle + random.normal(size=3) * 10 ** random.uniform(-3, 2)
        direction = unit(middle + random.normal(size=3) * 0.1 - origin)
        hit = [i for i, b in enumerate(balls) if meets(origin, direction, b)]
        count, found = looked_at(tree, origin, direction)
        assert set(hit) <= set(found.tolist())
        counts.append(count)
    if name in ("alike", "sizes"):
        assert np.mean(counts) < 0.15 * len(balls)


def meets(origin: Array, direction: Array, ball: Array) -> bool:
    """Whether a ray meets a ball before or around its origin."""
    f = ball[:3] - origin
    along = f @ direction
    aside = np.linalg.norm(f - along * direction)
    return bool(aside <= ball[3] and along >= -np.sqrt(ball[3] ** 2 - aside**2))


def test_a_large_one_stands_apart() -> None:
    """A floor is a child of the root: what lies on it has spheres of its own size."""
    tree = tree_of(CROWDS["dust"])
    floor = 1 + int(tree.below[1]) if tree.object[1] != 0 else 1
    assert tree.object[floor] == 0
    rest = np.delete(tree.spheres[1:, 3], floor - 1)
    assert rest.max() < 2


def test_a_point_has_a_radius() -> None:
    """Of a float whose bits survive: a triangle without an extent."""
    tree = tree_of(np.zeros((3, 4)))
    assert (tree.spheres[:, 3] > 2.0**-126).all()
    assert sorted(tree.object) == [-1, -1, 0, 1, 2]


def test_the_last_number_fits() -> None:
    """Of the most objects, all in one place: the largest numbers, whole, which shaders read."""
    assert f"NUMBER = (1 << {NUMBER_BITS}) - 1;" in (SHADERS / LIST).read_text()
    tree = Tree(sphere_tree([[1.0, 2.0, 3.0, 0.5]] * MOST_OBJECTS))
    assert tree.below[0] == len(tree) == 2 * MOST_OBJECTS - 1
    assert tree.object.max() == MOST_OBJECTS - 1
    assert (tree.spheres[:, 3] < 0.5 * 1.033).all()
    with pytest.raises(SceneError, match=r"^rays find 65536 objects at most: there are 65537$"):
        sphere_tree([[0.0, 0.0, 0.0, 1.0]] * (MOST_OBJECTS + 1))


# Pictures


def seen(balls: Array, origin: Array, direction: Array, larger: float) -> tuple[Array, Array]:
    """The ball that each ray meets, or -1, and how far away; radii differ by what float32 loses."""
    nearest, object_ = np.full(origin.shape[:-1], np.inf), np.full(origin.shape[:-1], -1)
    for i, (*center, radius) in enumerate(balls):
        lost = LOST * (radius + np.linalg.norm(np.array(center) - origin.reshape(-1, 3)[0]))
        distance = sphere((origin, direction), center, max(radius + larger * lost, 0.0))
        closer = distance < nearest
        nearest, object_ = np.where(closer, distance, nearest), np.where(closer, i, object_)
    return object_, nearest


@pytest.mark.parametrize("name", CROWDS)
def test_pictures_show_the_nearest(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Against every ball in float64, wherever a rounding does not decide."""
    monkeypatch.setattr(traced, "LONG", 1)
    offset = 1e3
    scene = crowd_scene(CROWDS[name], FLAT, offset)
    image = lb.render(scene, SIZE)
    assert_sound(image)
    eye = rays(scene, SIZE)
    placed = CROWDS[name] + np.array([offset, 0, 0, 0])
    object_, smaller, larger = (seen(placed, *eye, by)[0] for by in (0.0, -1.0, 1.0))
    want = np.where((object_ < 0)[..., None], 0.0, COLORS[object_ % len(COLORS)])
    certain = (object_ == smaller) & (object_ == larger)
    wrong = (np.abs(image.linear - want).max(axis=-1) > 1e-4) & certain
    assert certain.mean() > 0.9
    assert (object_ >= 0).mean() > 0.05
    assert wrong.sum() == 0


# The tests that a broken shader fails.
TRACED = ("test_pictures_show_the_nearest", "test_shadows_of_all")
PASSED = "passesBy(ray, vec4(node.xyz, abs(node.w)), reach)"
# Objects of a list, among them meshes, mirrors and glass.
LISTED = ["model-room", "normal-maps", "lab/reflectance2"]


@pytest.mark.parametrize("name", [*CROWDS, *LISTED])
def test_no_picture_is_another(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As where nothing is passed over: bit for bit, mirrors and shadows too."""
    monkeypatch.setattr(traced, "LONG", 1)
    code = (SHADERS / LIST).read_text()
    assert code.count(PASSED) == 1
    every = read_library(copy_of_shaders(tmp_path, {LIST: code.replace(PASSED, "false")}))
    mirror = {"kd": [0.8, 0.5, 0.3], "ks": [0, 0, 0], "reflectance": 0.5}
    scene = lb.load(name) if name in LISTED else crowd_scene(CROWDS[name], [mirror])
    settings: dict[str, Setting] = {"technique": "whitted", "max_bounces": 2, "shadow": "ray"}
    one, other = (
        on_gl_thread(lambda plan: renderer().run(plan), plan(menu, scene, settings, (80, 60)))
        for menu in (library(), every)
    )
    assert_sound(one)
    assert np.array_equal(one.linear, other.linear)


@pytest.mark.parametrize("name", CROWDS)
def test_shadows_of_all(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A pixel is lit where no ball at all is before the sun."""
    monkeypatch.setattr(traced, "LONG", 1)
    balls = CROWDS[name]
    scene = crowd_scene(balls, [{"kd": [1, 1, 1], "ks": [0, 0, 0]}])
    image = lb.render(scene, SIZE)
    assert_sound(image)
    origin, direction = rays(scene, SIZE)
    object_, distance = seen(balls, origin, direction, 0.0)
    same = [seen(balls, origin, direction, by)[0] == object_ for by in (-1.0, 1.0)]
    hit = (object_ >= 0) & same[0] & same[1]
    point = origin[hit] + distance[hit, None] * direction[hit]
    n = unit(point - balls[object_[hit], :3])
    sun = unit(np.array([0.3, 1, 0.4]))
    facing = n @ sun
    dark, clear = (blocked(balls, point, sun, object_[hit], by) for by in (-10.0, 10.0))
    lit = image.linear[hit][:, 0] > 0
    certain = (np.abs(facing) > 1e-2) & ((dark == clear) | (facing < 0))
    assert certain.mean() > 0.8
    # A ray starts a little off its surface: 4e-6 of the way to the eye.
    assert (lit == ((facing > 0) & ~dark))[certain].mean() > 0.998
    if len(balls) > 2:
        assert 0.01 < lit[certain].mean() < 0.99


def blocked(balls: Array, point: Array, sun: Array, own: Array, larger: float) -> NDArray[np.bool_]:
    """Whether a ball other than a point's own is between it and the sun; from within, none is."""
    found = np.zeros(len(point), bool)
    for i, (*center, radius) in enumerate(balls):
        size = max(radius + larger * LOST * (radius + 3), 0.0)
        distance = sphere((point, np.broadcast_to(sun, point.shape)), center, size)
        found |= np.isfinite(distance) & (own != i)
    return found
