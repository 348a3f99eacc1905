"""Outlines against Sobel in float64 on the same normals and distances, and where they must be."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import lightbench as lb
from lightbench.exact import outlines
from lightbench.exact.directions import Array
from lightbench.scene import Scene
from lightbench.settings import Setting
from tests.cards import attachment, mapped, texture
from tests.support import assert_sound

SIZE = (160, 120)
KINDS = ("sobel", "sobel_depth")
WHITE = {"base_color": [1, 1, 1], "unlit": True}
CAMERA = {"eye": [0, 1.5, 4], "target": [0, 0.3, 0], "fov": 45}


def scene(camera: dict[str, Any] | None = None, **things: dict[str, Any]) -> Scene:
    """White unlit things on a white background: a black pixel is an outline."""
    return Scene.parse({
        "camera": camera or CAMERA,
        "background": [1, 1, 1],
        "materials": {"white": WHITE},
        "objects": {name: {"material": "white", **thing} for name, thing in things.items()},
    })  # fmt: skip


ROOM = scene(
    floor={"shape": "plane", "scale": [6, 1, 6]},
    box={"shape": "cube", "position": [-0.8, 0.3, 0], "rotation": [0, 30, 0], "scale": 0.6},
    ball={"shape": "sphere", "position": [0.7, 0.5, 0.3], "scale": 0.5},
)


def covered(made: Scene, kind: str, size: tuple[int, int] = SIZE, /, **more: Setting) -> Array:
    """(H, W) share of each pixel that an outline covers."""
    image = lb.render(made, size, **{"outline": kind, "ambient": "none", **more})
    assert_sound(image)
    red = image.linear[..., 0].astype(np.float64)
    assert np.isin(red, (0.0, 1.0)).all()
    return 1.0 - red


def held(made: Scene, size: tuple[int, int] = SIZE) -> Array:
    """(H, W, 4) normals and distances as the pass writes them, 0 where nothing is."""
    normal = attachment(made, "normal_distance", size, outline="sobel")
    distance = lb.render(made, size, view="depth").linear[..., :1]
    return np.concatenate([normal, distance], axis=-1).astype(np.float64)


def expected(
    made: Scene, kind: str, size: tuple[int, int] = SIZE, /, *,
    outline_threshold: float = 0.6, outline_width: float = 6.0, outline_jump: float = 0.3,
) -> tuple[Array, NDArray[np.bool_]]:  # fmt: skip
    """(H, W) the outlines in float64, and where no comparison is as good as a tie."""
    values = held(made, size)
    rows, columns = np.indices(values.shape[:2])
    d = values[..., 3]
    there = d > 0.0
    exact = outline_width * size[1] / 1000.0 / np.where(there, d, 1.0) + 0.5
    step = np.where(there, np.maximum(1, np.floor(exact)), 1).astype(int)
    sure = np.abs(exact - np.round(exact)) > 1e-4

    def at(down: int, right: int) -> Array:
        row = np.clip(rows + down * step, 0, size[1] - 1)
        return values[row, np.clip(columns + right * step, 0, size[0] - 1)]

    around = [(-1, -1), (-1, 0), (-1, 1), (0, -1), (0, 1), (1, -1), (1, 0), (1, 1)]
    g = outlines.sobel(*(at(*place) for place in around))
    turn, jump = g[..., :3].max(axis=-1), g[..., 3]
    sure &= np.abs(turn - outline_threshold) > 1e-4
    lined = turn > outline_threshold
    if kind == "sobel_depth":
        sure &= ~there | (np.abs(jump - outline_jump * d) > 1e-4)
        lined |= there & (jump > outline_jump * d)
    return np.asarray(lined, np.float64), sure


PARALLEL = {**CAMERA, "projection": "orthographic", "height": 3}
GIVEN: list[dict[str, float]] = [
    {}, {"outline_threshold": 0.05}, {"outline_threshold": 3.0}, {"outline_width": 40.0},
    {"outline_width": 1.0}, {"outline_jump": 0.01}, {"outline_jump": 4.0},
]  # fmt: skip


@pytest.mark.parametrize("given", GIVEN, ids=str)
@pytest.mark.parametrize("kind", KINDS)
def test_outlines_are_those_of_float64(kind: str, given: dict[str, float]) -> None:
    """Under any threshold, step and jump that the kind has, to the picture's very border."""
    known = {name: x for name, x in given.items() if kind == "sobel_depth" or "jump" not in name}
    for camera in (CAMERA, PARALLEL):
        made = Scene.parse(ROOM.data() | {"camera": camera})
        want, sure = expected(made, kind, **known)
        got = covered(made, kind, SIZE, **known)
        assert sure.mean() > 0.97
        assert np.array_equal(got[sure], want[sure])
        assert 0.0 < want.mean() < 0.9


@pytest.mark.parametrize("kind", KINDS)
def test_silhouettes_and_creases_are_lined_and_faces_are_not(kind: str) -> None:
    """A cube from a corner: its nine visible edges, and nothing inside of its faces."""
    made = scene({"eye": [2, 2, 2], "fov": 40}, box={"shape": "cube"})
    lined = covered(made, kind, (200, 200), outline_width=1.0)
    normal = held(made, (200, 200))[..., :3]
    turns = np.zeros((200, 200), bool)
    for axis in (0, 1):
        turned = np.abs(np.diff(normal, axis=axis)).max(axis=-1) > 0.1
        turns |= np.pad(turned, [(0, 1) if a == axis else (0, 0) for a in (0, 1)])
        turns |= np.pad(turned, [(1, 0) if a == axis else (0, 0) for a in (0, 1)])
    assert turns.sum() > 500
    assert lined[turns].all()
    away = ~turns
    for axis in (0, 1):
        for by in (-1, 1):
            away &= ~np.roll(turns, by, axis)
    assert not lined[away].any()


def test_nothing_is_lined_on_a_flat_surface() -> None:
    """Seen at a slant up to the horizon, and mapped with bumps: the geometry counts."""
    bumps = np.random.default_rng(3).integers(0, 256, (16, 16, 3))
    made = scene(floor={"shape": "plane", "scale": [400, 1, 400]}).data()
    rough = {**WHITE, "maps": mapped("normal")["maps"]}
    for material in (WHITE, rough):
        data = made | {"textures": {"t": texture(bumps)}, "materials": {"white": material}}
        data["camera"] = {"eye": [0, 1, 0], "target": [0, 0.2, -1], "fov": 40}
        for camera in ({}, {"projection": "orthographic", "height": 2}):
            data["camera"] = {**data["camera"], **camera}  # type: ignore[dict-item]
            assert not covered(Scene.parse(data), "sobel", outline_threshold=0.05).any()


def test_a_jump_between_equal_normals_is_seen_by_distance() -> None:
    """Of two cards, one behind the other, both facing the eye."""
    made = scene(
        {"eye": [0, 3, 0], "up": [0, 0, -1]},
        near={"shape": "plane", "scale": 0.6, "position": [0, 1.5, 0]},
        far={"shape": "plane", "scale": 4},
    )
    assert not covered(made, "sobel").any()
    lined = covered(made, "sobel_depth")
    assert lined.any()
    distance = held(made)[..., 3]
    edge = np.abs(np.diff(distance, axis=1)) > 0.5
    assert lined[:, 1:][edge].all()
    assert lined[:, :-1][edge].all()
    assert not lined[distance > 2.0].all()


def width_of_line(distance: float, height: int, width: float) -> int:
    """Pixels of the outline across the upper border of a card so far away."""
    made = scene(
        {"eye": [0, 0, distance], "fov": 60},
        card={"shape": "cube", "scale": [distance * 4, distance * 0.5, 1e-3]},
    )
    lined = covered(made, "sobel", (9, height), outline_width=width)
    return int(lined[: height // 2, 4].sum())


def test_the_step_shrinks_with_distance_and_grows_with_the_picture() -> None:
    """As wide as said at 1 m in a picture of 1000 rows, inside of the thing; never less than one,
    and a pixel of the background beside it."""
    for distance, height, width in (
        (1.0, 1000, 6.0), (1.0, 500, 12.0), (2.0, 1000, 12.0), (3.0, 250, 24.0), (1.0, 2000, 6.0),
        (50.0, 1000, 6.0), (4.0, 100, 1.0),
    ):  # fmt: skip
        step = max(1, int(width * height / 1000.0 / distance + 0.5))
        assert width_of_line(distance, height, width) == step + 1, (distance, height, width)


def test_a_line_has_its_colour_over_the_picture() -> None:
    """Only where it is: the rest is the picture without lines, to the last bit."""
    plain = lb.render("box-room", SIZE).linear
    image = lb.render("box-room", SIZE, outline="sobel", outline_color="1,0.5,0.25")
    lined = (image.linear == [1.0, 0.5, 0.25]).all(axis=2)
    assert 0.01 < lined.mean() < 0.3
    assert np.array_equal(image.linear[~lined], plain[~lined])


def test_normals_face_the_viewer_in_a_parallel_view() -> None:
    """A wall that the parallel view grazes has its own normal, wherever in the picture it is."""
    camera = {"eye": [0, 0, 5], "projection": "orthographic", "height": 3}
    slant = {
        "shape": "cube", "rotation": [0, 80, 0], "scale": [8, 2, 1e-3], "position": [1.5, 0, 0],
    }  # fmt: skip
    made = scene(camera, wall=slant)
    found = held(made)
    there = found[..., 3] > 0
    assert there.sum() > 500
    want = np.array([np.sin(np.radians(80)), 0.0, np.cos(np.radians(80))])
    off = np.abs(found[there][:, :3] - want).max(axis=1)
    assert (off < 1e-5).mean() > 0.95
