"""Flat parts: the matrices of a lab script, their order, and the lines that are drawn by them."""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import lightbench as lb
from lightbench.errors import SceneError
from lightbench.exact.outlines import circle_distance, segment_distance, stroke_coverage
from lightbench.parts import multiply, part_matrices, rotation, scaling, translation
from lightbench.scene import Scene
from lightbench.scene_parts import MOST_PARTS
from lightbench.settings import resolve
from tests.part_cases import flat_scenes
from tests.support import assert_sound, library, planned

Array = NDArray[np.float64]
Parts = dict[str, dict[str, Any]]
SIZES = [(160, 160), (200, 120), (90, 150)]
CORNERS = ((1, 1), (-1, 1), (-1, -1), (1, -1))


def matrix(columns: Any) -> Array:
    """The 3x3 matrix of nine numbers, column by column."""
    return np.array(columns, dtype=np.float64).reshape(3, 3).T


def moved(columns: Any, x: float, y: float) -> tuple[float, float]:
    """Where a matrix takes a point."""
    at = matrix(columns) @ [x, y, 1.0]
    assert at[2] == 1.0
    return at[0], at[1]


def flat(parts: dict[str, Any], **more: Any) -> Scene:
    """A scene of nothing but parts."""
    return Scene.parse({"materials": {}, "objects": {}, "parts": parts, **more})


def matrices(scene: Scene, settings: dict[str, Any] | None = None) -> dict[str, Array]:
    edited = resolve(library(), scene, settings or {}).scene
    return {name: matrix(m) for name, m in part_matrices(edited.parts).items()}


# Matrices


def test_a_translation_moves() -> None:
    """The lab script on ray tracing, eq. 1.3."""
    assert matrix(translation((2, 3))).tolist() == [[1, 0, 2], [0, 1, 3], [0, 0, 1]]
    assert moved(translation((0.2, 0.1)), 0.4, 0.3) == pytest.approx((0.6, 0.4))


def test_a_scaling_stretches() -> None:
    """Eq. 1.4 there."""
    assert matrix(scaling((2, 3))).tolist() == [[2, 0, 0], [0, 3, 0], [0, 0, 1]]
    assert moved(scaling((2, 3)), 0.5, -1) == (1, -3)


@pytest.mark.parametrize("degrees", [0, 30, 90, -45, 213.7, 360])
def test_a_rotation_turns_about_the_middle(degrees: float) -> None:
    """Eq. 1.5 there: from x towards y."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    want = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    np.testing.assert_allclose(matrix(rotation(degrees)), want, atol=2e-10)
    assert moved(rotation(degrees), 0, 0) == (0, 0)


def test_right_angles_are_exact() -> None:
    assert moved(rotation(90), 1, 0) == (0, 1)
    assert moved(rotation(-180), 1, 0) == (-1, 0)


def test_a_product_does_first_what_stands_last() -> None:
    """Products do not commute: moved and then turned is elsewhere than turned and then moved."""
    move, turn = translation((1, 0)), rotation(90)
    assert moved(multiply(move, turn), 1, 0) == (1, 1)
    assert moved(multiply(turn, move), 1, 0) == (0, 2)
    numbers = np.random.default_rng(3).normal(size=(20, 2, 9)).tolist()
    for a, b in numbers:
        want: Array = matrix(a) @ matrix(b)
        np.testing.assert_allclose(matrix(multiply(a, b)), want, rtol=1e-14, atol=1e-14)


def test_a_part_is_stretched_then_turned_then_moved() -> None:
    part = {"shape": "square", "position": [0.5, -0.25], "rotation": 30, "scale": [0.4, 0.1]}
    want = matrix(translation((0.5, -0.25))) @ matrix(rotation(30)) @ matrix(scaling((0.4, 0.1)))
    np.testing.assert_allclose(matrices(flat({"arm": part}))["arm"], want, rtol=1e-15)


def test_a_child_is_in_its_parent_s_frame_which_no_scale_stretches() -> None:
    parent = {"shape": "square", "position": [0.5, 0], "rotation": 90, "scale": [7, 0.1]}
    child = {"shape": "line", "parent": "arm", "position": [0.25, 0], "scale": 0.5}
    found = matrices(flat({"hand": child, "arm": parent}))
    np.testing.assert_allclose(found["hand"] @ [0, 0, 1], [0.5, 0.25, 1], atol=1e-15)
    np.testing.assert_allclose(found["hand"] @ [1, 0, 1], [0.5, 0.75, 1], atol=1e-15)


@pytest.mark.parametrize("name", list(flat_scenes()))
def test_the_order_in_the_file_is_not_that_of_the_tree(name: str) -> None:
    """Each part is its own chain of products, however the table is sorted."""
    parts = flat_scenes()[name].parts
    for key, found in matrices(flat_scenes()[name]).items():
        want, at = matrix(scaling(parts[key].scale)), key
        while True:
            own = matrix(translation(parts[at].position)) @ matrix(rotation(parts[at].rotation))
            want = own @ want
            if (parent := parts[at].parent) is None:
                break
            at = parent
        np.testing.assert_allclose(found, want, rtol=1e-12, atol=1e-12)


def test_what_hangs_on_a_shoulder_turns_with_it() -> None:
    """About the shoulder, by the angle given; nothing else moves."""
    robot = lb.load("lab/robot")
    before, degrees = matrices(robot), robot.parts["right_shoulder"].rotation + 50
    after = matrices(robot, {"parts.right_shoulder.rotation": degrees})
    shoulder = before["right_shoulder"][:, 2]
    there, back = translation(list(shoulder[:2])), translation(list(-shoulder[:2]))
    about: Array = matrix(there) @ matrix(rotation(50)) @ matrix(back)
    arm = {n for n in robot.parts if n.startswith("right_") and n.split("_", 1)[1] in
           ("shoulder", "upper_arm", "elbow", "forearm", "hand")}  # fmt: skip
    assert len(arm) == 5
    for name in robot.parts:
        want = about @ before[name] if name in arm else before[name]
        np.testing.assert_allclose(after[name], want, atol=1e-9)
    assert np.abs(after["right_forearm"] - before["right_forearm"]).max() > 0.1


# Pictures


def distance(points: Array, shape: str, m: Array) -> Array:
    """Distances in pixels of `points` (N, 2) to an outline, by its corners taken by the matrix."""

    def taken(x: float, y: float) -> Array:
        return np.asarray((m @ [x, y, 1.0])[:2])

    def edge(a: Array, b: Array) -> Array:
        half = np.broadcast_to((b - a) / 2, points.shape)
        return segment_distance(points - (a + b) / 2, half)

    if shape == "circle":
        middle = taken(0, 0)
        radius = np.broadcast_to(taken(1, 0) - middle, points.shape)
        return circle_distance(points - middle, radius)
    if shape == "line":
        return edge(taken(-1, 0), taken(1, 0))
    corners = [taken(*corner) for corner in CORNERS]
    edges = zip(corners, [*corners[1:], corners[0]], strict=True)
    return np.asarray(np.minimum.reduce([edge(a, b) for a, b in edges]))


def drawn(scene: Scene, size: tuple[int, int]) -> Array:
    """The picture in float64: (H, W, 3), row 0 at the top."""
    width, height = size
    unit = min(size) / 2
    y, x = np.mgrid[height - 0.5 : -0.5 : -1, 0.5:width]
    points = np.stack([x - width / 2, y - height / 2], axis=-1).reshape(-1, 2)
    shown = np.broadcast_to(np.array(scene.background), (len(points), 3))
    to_pixels = matrix(scaling((unit, unit)))
    for (_, part), m in zip(scene.parts.items(), matrices(scene).values(), strict=True):
        away = distance(points, part.shape, to_pixels @ m)
        share = stroke_coverage(away, np.array(part.width))[:, None]
        shown = shown * (1 - share) + np.array(part.color) * share
    return np.asarray(shown.reshape(height, width, 3))


def assert_drawn(scene: Scene, size: tuple[int, int], **settings: Any) -> None:
    """At most 1e-4 off for 99.9 % of pixels: here for all."""
    image = lb.render(scene, size, **settings)
    assert_sound(image)
    want = drawn(resolve(library(), scene, settings).scene, size)
    assert np.abs(image.linear - want).max() <= 1e-4
    assert (image.linear != image.linear[0, 0]).any()


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_robot_is_that_of_float64(size: tuple[int, int]) -> None:
    assert_drawn(lb.load("lab/robot"), size)
    assert_drawn(lb.load("lab/robot"), size, **{"parts.head.rotation": 17, "samples": 3})


@pytest.mark.parametrize("name", list(flat_scenes()))
def test_parts_are_those_of_float64(name: str) -> None:
    assert_drawn(flat_scenes()[name], SIZES[1])


def test_the_shorter_side_runs_from_minus_one_to_one() -> None:
    """Figure 1.1 there: of a square picture both sides do; (0, 0) is the middle, y points up."""
    dot = {"shape": "circle", "scale": 0.01, "width": 8}
    corner = lb.render(flat({"dot": {**dot, "position": [0.99, 0.99]}}), (100, 100)).linear
    assert corner[0, -1].min() == 1.0
    assert corner[-1, 0].max() == corner[0, 0].max() == corner[-1, -1].max() == 0.0
    wide = lb.render(flat({"dot": {**dot, "position": [0, 0.99]}}), (300, 100)).linear
    assert wide[0, 149:151].min() == 1.0
    assert wide[:, :140].max() == 0.0


def test_a_later_part_lies_over_an_earlier_one() -> None:
    line = {"shape": "line", "width": 4}
    red, blue = {**line, "color": [1, 0, 0]}, {**line, "color": [0, 0, 1], "rotation": 90}
    every: list[Parts] = [{"a": red, "b": blue}, {"a": blue, "b": red}]
    for parts in every:
        middle = lb.render(flat(parts), (21, 21)).linear[10, 10]
        assert middle.tolist() == list(parts["b"]["color"])


def test_a_line_is_as_wide_as_it_says() -> None:
    """However far it is stretched: in pixels of the picture, of which several samples are one."""
    for width, samples in ((1, 1), (3, 1), (3, 4), (8, 1)):
        part = {"shape": "line", "scale": [0.7, 5], "width": width}
        image = lb.render(flat({"line": part}), (61, 61), samples=samples).linear
        assert image[:, 30, 0].sum() == pytest.approx(width, abs=1e-5)


def test_parts_lie_over_objects() -> None:
    data: Any = lb.load("single-sphere").data()
    alone = lb.render("single-sphere", (60, 40)).linear
    data["parts"] = {"ring": {"shape": "circle", "scale": 0.5, "color": [2, 0, 0], "width": 4}}
    both = lb.render(Scene.parse(data), (60, 40)).linear
    assert both[20, 40].tolist() == [2, 0, 0]
    assert np.array_equal(both[0], alone[0])
    assert np.array_equal(both[20, 30], alone[20, 30])


# Those that draw
PICTURES = (
    "test_the_robot_is_that_of_float64",
    "test_parts_are_those_of_float64",
    "test_the_shorter_side_runs_from_minus_one_to_one",
    "test_a_later_part_lies_over_an_earlier_one",
    "test_a_line_is_as_wide_as_it_says",
    "test_parts_lie_over_objects",
)


# Plans


def test_a_scene_of_parts_needs_nothing_else() -> None:
    made = planned("lab/robot", {})
    assert [p["name"] for p in made["passes"]] == ["forward", "parts", "display"]
    assert made["passes"][0]["batches"] == []
    assert made["settings"] == ["view", "tonemap", "transfer", "quantisation"]
    assert "parts" not in [p["name"] for p in planned("box-room", {})["passes"]]


def test_a_joint_that_turns_compiles_nothing() -> None:
    """Whatever moves or changes its colour is a uniform."""
    settings: dict[str, Any] = {
        "parts.head.rotation": 20,
        "parts.neck.position": "0,0.4",
        "parts.dial.scale": 0.1,
        "parts.lamp.color": "#00ff00",
        "parts.torso.width": 7,
    }
    assert planned("lab/robot", {})["programs"] == planned("lab/robot", settings)["programs"]


def test_as_many_parts_as_there_may_be() -> None:
    parts = {f"p{n}": {"shape": "square", "scale": (n + 1) / 60} for n in range(MOST_PARTS)}
    assert_drawn(flat(parts), (150, 150))
    with pytest.raises(SceneError, match=r"^scene: parts: .* at most 48 items"):
        flat({**parts, "more": {"shape": "square"}})


# Mistakes

WRONG: list[tuple[dict[str, Any], str]] = [
    ({"a": {}}, "parts.a.shape: Field required"),
    ({"a": {"shape": "star"}}, "parts.a.shape: Input should be 'square', 'circle' or 'line'"),
    ({"a": {"shape": "line", "angle": 3}}, "parts.a.angle: no such field"),
    ({"a": {"shape": "line", "parent": "b"}}, "parts.a.parent: no part 'b'; there is: a"),
    ({"a": {"shape": "line", "parent": "a"}}, "parts.a.parent: goes in a circle: a -> a"),
    (
        {n: {"shape": "line", "parent": p} for n, p in (("a", "b"), ("b", "c"), ("c", "b"))},
        "parts.a.parent: goes in a circle: a -> b -> c -> b",
    ),
    ({"a": {"shape": "circle", "scale": [1, 2]}}, "parts.a: scale: a circle has one factor"),
    ({"a": {"shape": "line", "scale": 0}}, "parts.a: scale: each factor must be at least 1e-6"),
    ({"a": {"shape": "line", "position": "1,2,3"}}, "does not parse: write x,y"),
    ({"a": {"shape": "line", "rotation": 400}}, "parts.a.rotation: Input should be less than"),
    ({"a": {"shape": "line", "width": 0}}, "parts.a.width: Input should be greater than"),
    ({"A": {"shape": "line"}}, "parts.A: String should match pattern"),
]


@pytest.mark.parametrize(("parts", "message"), WRONG, ids=[message for _, message in WRONG])
def test_wrong_parts(parts: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError) as caught:
        flat(parts)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
