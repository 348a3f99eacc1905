"""Ray tracing beside rasterisation, and where its formulas are strained."""

import io
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image as Pillow
from PIL.PngImagePlugin import PngInfo

import lightbench as lb
from lightbench import assets, glsl
from lightbench.image import Image
from lightbench.scene import Scene
from lightbench.settings import Setting
from lightbench.shapes import mesh
from tests.support import assert_sound, presets

Note = Callable[[str], None]
SIZE = (200, 150)
RAYS: dict[str, Setting] = {"technique": "whitted", "max_bounces": 0}
EXACT: dict[str, Setting] = {"shadow": "ray", "sphere_error": 0.01}


def level(image: Image) -> NDArray[np.float64]:
    """Luminance over 1 + itself: what is bright does not outweigh all else."""
    linear = image.linear.astype(np.float64).clip(0).mean(axis=2)
    return np.asarray(linear / (1 + linear))


def edges(image: Image, step: float) -> NDArray[np.bool_]:
    """Pixels beside which the level changes by more than a step."""
    around = windows(level(image), 3)
    return np.asarray(around.max(axis=(2, 3)) - around.min(axis=(2, 3)) > step)


def windows(values: NDArray[np.float64], side: int) -> NDArray[np.float64]:
    """(H, W, side, side): the neighbourhood of each pixel, the border's values going on."""
    padded = np.pad(values, side // 2, mode="edge")
    return np.lib.stride_tricks.sliding_window_view(padded, (side, side))


@pytest.mark.parametrize("preset", [p for p in presets() if not p.startswith("lab/")])
def test_a_ray_sees_what_rasterisation_draws(preset: str, note: Note) -> None:
    """Under exact shadows and without mirrors the two differ at outlines and shadow edges only.

    Images are filtered in two ways, so that scenes with textures are compared in the mean over
    5 pixels.
    """
    drawn = lb.render(preset, SIZE, **EXACT)
    traced = lb.render(preset, SIZE, **EXACT, **RAYS)
    assert_sound(traced)
    textured = bool(lb.load(preset).textures)
    a, b = level(drawn), level(traced)
    if textured:
        a, b = (windows(values, 5).mean(axis=(2, 3)) for values in (a, b))
    wrong = np.abs(a - b) > (0.02 if textured else 2e-3)
    beside = edges(drawn, 0.02) | edges(traced, 0.02)
    note(f"{preset}, traced: {wrong.mean():.2%} differ, {(wrong & ~beside).mean():.2%} off edges")
    assert wrong.mean() < 0.03
    assert (wrong & ~beside).mean() < 2e-3


# One for each way in which a view asks a surface.
VIEWS = ["final", "uv", "normal", "specular", "distribution", "shadow", "dir_x"]


@pytest.mark.parametrize("view", VIEWS)
def test_views_are_those_of_rasterisation(view: str) -> None:
    """What a view shows of a surface it shows of what a ray meets."""
    given: dict[str, Setting] = {**EXACT, "view": view}
    drawn = lb.render("box-room", (80, 60), **given)
    traced = lb.render("box-room", (80, 60), **given, **RAYS)
    difference = np.abs(drawn.linear - traced.linear).max(axis=2)
    wrong = difference > 2e-3 * (1 + np.abs(drawn.linear).max(axis=2))
    assert wrong.mean() < 0.02, wrong.mean()
    assert drawn.linear.std() > 0


def ball(**objects: object) -> dict[str, object]:
    """A ball of radius 1 under a lamp, with more objects or others in its place."""
    return {
        "camera": {"eye": [0, 0, 10], "target": [0, 0, 0], "fov": 20},
        "materials": {
            "white": {"kd": [0.8, 0.8, 0.8], "ks": [0, 0, 0], "ambient": [0.1, 0.1, 0.1]},
            "both": {
                "kd": [0.8, 0.8, 0.8], "ks": [0, 0, 0], "ambient": [0.1, 0.1, 0.1],
                "double_sided": True,
            },
        },
        "objects": {"ball": {"shape": "sphere", "material": "white"}, **objects},
        "lights": {"lamp": {"type": "point", "position": [3, 4, 10], "intensity": 2}},
        "settings": {
            "technique": "whitted", "shadow": "ray", "ambient": "lab", "attenuation": "none",
            "model": "blinn_phong",
        },
    }  # fmt: skip


def rendered(data: dict[str, object], size: tuple[int, int] = (120, 120), **more: Setting) -> Image:
    image = lb.render(Scene.parse(data), size, **more)
    assert_sound(image)
    return image


def icosphere(level: int) -> tuple[dict[str, object], dict[str, object]]:
    """(the scene's meshes, an object): a ball of triangles."""
    key = assets.add_mesh(mesh(f"icosphere-{level}"), keep=True)
    one = [1.0, 1.0, 1.0]
    asset = {"mesh": key, "low": [-1.0, -1.0, -1.0], "high": one}
    return {"ico": asset}, {"shape": "mesh", "mesh": "ico", "material": "white"}


def test_a_sphere_and_its_triangles(note: Note) -> None:
    """Five times subdivided, an icosphere differs from its sphere at the outline."""
    meshes, thing = icosphere(5)
    exact = rendered(ball(), (240, 240))
    made = rendered(ball(ball=thing) | {"meshes": meshes}, (240, 240))
    wrong = np.abs(level(made) - level(exact)) > 2e-3
    outline = edges(exact, 0.02) | edges(made, 0.02)
    off = wrong & ~outline
    note(f"icosphere-5 against its sphere: {wrong.mean():.2%} differ, {off.sum()} off edges")
    assert 0 < wrong.mean() < 0.02
    assert not off.any()


def test_a_closed_mesh_has_no_gap() -> None:
    """From within, in every direction: no ray slips between two triangles."""
    meshes, thing = icosphere(4)
    data = ball(ball=thing | {"material": "both"}) | {"meshes": meshes, "background": [5, 5, 5]}
    data["camera"] = {"eye": [0.1, 0.2, 0.05], "target": [1, 0.3, 0.2], "fov": 170}
    data["lights"] = {}
    assert rendered(data, (400, 300)).linear.max() < 1


@pytest.mark.parametrize("radius", [1e-3, 1.0, 50.0])
def test_a_ball_far_away(radius: float) -> None:
    """At 1e4 radii: the disk that similar triangles say, and its light."""
    data = ball(ball={"shape": "sphere", "material": "white", "scale": radius})
    data["camera"] = {
        "eye": [0, 0, 1e4 * radius], "target": [0, 0, 0], "projection": "orthographic",
        "height": 4 * radius,
    }  # fmt: skip
    data["lights"] = {"sun": {"type": "directional", "direction": [0, 0, -1], "intensity": 1}}
    image = rendered(data, (200, 200))
    found = image.linear[..., 0] > 0
    assert np.sqrt(found.sum() / np.pi) == pytest.approx(50, rel=5e-3)
    # Lambert's law over the disk: the cosine is the height of the ball.
    y, x = (np.mgrid[:200, :200] - 99.5) / 50
    cosine = np.sqrt(np.clip(1 - x * x - y * y, 0, None))
    inner = x * x + y * y < 0.9
    want = (0.1 + 0.8 * cosine) / np.pi
    np.testing.assert_allclose(image.linear[inner][:, 0], want[inner], atol=2e-3)


def test_a_ball_that_is_a_horizon() -> None:
    """Radius 1e5, seen from 2 above it: flat ground, with the horizon where it belongs."""
    data = ball(ball={
        "shape": "sphere", "material": "white", "scale": 1e5, "position": [0, -1e5, 0],
    })  # fmt: skip
    data["camera"] = {"eye": [0, 2, 0], "target": [0, 2, -1], "fov": 10}
    data["lights"] = {"sun": {"type": "directional", "direction": [0, -1, 0], "intensity": 1}}
    image = rendered(data, (64, 400))
    ground = image.linear[:, 32, 0] > 0
    dip = np.degrees(np.arccos(1e5 / (1e5 + 2)))
    row = 200 * (1 + np.tan(np.radians(dip)) / np.tan(np.radians(5)))
    assert not ground[: int(row) - 1].any()
    assert ground[int(row) + 2 :].all()
    np.testing.assert_allclose(image.linear[-100:, :, 0], 0.9 / np.pi, rtol=1e-4)


def test_from_within_a_ball() -> None:
    """A ray that starts inside meets the far side, in every direction, at its distance."""
    origin = np.zeros((500, 3))
    direction = np.random.default_rng(3).normal(size=(500, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    centre = np.tile([0.3, -0.2, 0.1], (500, 1))
    f = -centre
    along = -(f * direction).sum(axis=1)
    want = along + np.sqrt(along**2 - (f * f).sum(axis=1) + 4)
    for function in ("sphereHit", "sphereExit"):
        found = glsl.call("lib/sphere.glsl", function, origin, direction, centre, np.full(500, 2.0))
        np.testing.assert_allclose(found, want, rtol=2e-6)


def test_a_ray_that_touches_a_ball() -> None:
    """Beside a tangent by a millionth: met on one side, missed on the other, never NaN."""
    beside = np.array([1 - 1e-5, 1 - 1e-6, 1.0, 1 + 1e-6, 1 + 1e-5])
    origin = np.column_stack([beside, np.zeros(5), np.full(5, 3.0)])
    direction, centre = np.tile([0.0, 0, -1], (5, 1)), np.zeros((5, 3))
    found = glsl.call("lib/sphere.glsl", "sphereHit", origin, direction, centre, np.ones(5))
    assert np.isfinite(found).all()
    np.testing.assert_allclose(found[:2], 3.0, atol=5e-3)
    np.testing.assert_array_equal(found[-1], -1.0)


@pytest.mark.parametrize(
    "corners",
    [[[0, 0, 2]] * 3, [[-1, -1, 2], [0, 0, 2], [1, 1, 2]], [[0, 0, 2], [1e-30, 0, 2], [0, 1, 2]]],
)
def test_a_triangle_without_an_area(corners: list[list[float]]) -> None:
    """It is not there, for no ray and no shadow."""
    flat = {"shape": "triangle", "material": "white", "corners": corners}
    np.testing.assert_array_equal(rendered(ball(flat=flat)).linear, rendered(ball()).linear)


def test_a_light_within_a_ball() -> None:
    """What it lights is the inside: from outside the ball has its ambient light only."""
    floor = {"shape": "plane", "material": "white", "position": [0, -1.2, 0], "scale": [9, 1, 9]}
    data = ball(floor=floor)
    data["lights"] = {"lamp": {"type": "point", "position": [0, 0.2, 0], "intensity": 5}}
    image = rendered(data)
    want = 0.1 * 5 / np.pi
    np.testing.assert_allclose(np.unique(image.linear), [0, want], rtol=1e-6)


@pytest.mark.parametrize("factor", [1e-3, 1e4])
def test_a_scene_of_another_size(factor: float) -> None:
    """Mirrors, glass and shadows with all lengths times a factor: the same picture."""

    def scaled(s: float) -> dict[str, object]:
        data = ball(
            floor={"shape": "plane", "material": "mirror", "position": [0, -s, 0], "scale": 9 * s},
            ball={"shape": "sphere", "material": "glass", "scale": s},
            cube={"shape": "cube", "material": "white", "position": [2 * s, 0, -2 * s], "scale": s},
        )
        glass = {"kd": [0, 0, 0], "ks": [0, 0, 0], "transmittance": 0.9, "ior": 1.5}
        mirror = {"kd": [0.3, 0.3, 0.3], "ks": [0, 0, 0], "reflectance": 0.5}
        data["materials"] = {**data["materials"], "glass": glass, "mirror": mirror}  # type: ignore[dict-item]
        data["camera"] = {"eye": [0, 3 * s, 10 * s], "target": [0, 0, 0], "fov": 40}
        lamp = {"type": "point", "position": [3 * s, 8 * s, 5 * s], "intensity": 2}
        data["lights"] = {"lamp": lamp}
        data["settings"] = {**data["settings"], "max_bounces": 4}  # type: ignore[dict-item]
        return data

    base, other = rendered(scaled(1.0)), rendered(scaled(factor))
    wrong = np.abs(level(base) - level(other)) > 1e-3
    beside = edges(base, 0.01) | edges(other, 0.01)
    assert wrong.mean() < 5e-3
    assert not (wrong & ~beside).any()


def slab(ior: float, *, inside: bool = False) -> dict[str, object]:
    """A cube of glass before a wall of two halves, one black and one white."""
    glass = {"kd": [0, 0, 0], "ks": [0, 0, 0], "transmittance": 1, "ior": ior}
    wall = {"shape": "plane", "rotation": [90, 0, 0], "scale": [200, 1, 200]}
    return {
        "camera": {
            "eye": [0, 0, 0 if inside else 5], "target": [0, 0, -1],
            "fov": 60, "fov_of": "width",
        },
        "materials": {
            "glass": glass,
            "white": {"emissive": [1, 1, 1], "base_color": [0, 0, 0]},
        },
        "objects": {
            "slab": {"shape": "cube", "material": "glass", "scale": [100, 100, 2]},
            "wall": {**wall, "material": "white", "position": [100, 0, -9]},
        },
        "settings": {"technique": "whitted", "max_bounces": 3, "ambient": "none"},
    }  # fmt: skip


@pytest.mark.parametrize("ior", [1.0, 1.33, 1.5, 2.4])
def test_a_slab_moves_what_is_behind_it(ior: float) -> None:
    """Snell's law on the way in and out: every ray hits the wall where it should."""
    data = slab(ior)
    # The wall's edge at x = 2, so that it is seen at a slant.
    data["objects"]["wall"]["position"] = [102, 0, -9]  # type: ignore[index]
    image = rendered(data, (400, 4))
    lit = np.flatnonzero(image.linear[2, :, 0] > 0.5)[0]
    slope = np.tan(np.radians(30)) * (2 * (np.arange(400) + 0.5) / 400 - 1)
    sine = slope / np.hypot(1, slope)
    within = sine / ior / np.sqrt(1 - (sine / ior) ** 2)
    # 4 before the slab, 2 within, 8 behind it.
    across = 12 * slope + 2 * within
    assert abs(int(lit) - int(np.flatnonzero(across > 2)[0])) <= 1


def test_total_internal_reflection() -> None:
    """From within glass, beyond the critical angle nothing of the outside is seen."""
    data = slab(1.5, inside=True)
    data["objects"]["wall"]["position"] = [0, 0, -9]  # type: ignore[index]
    data["objects"]["wall"]["scale"] = [1e4, 1, 1e4]  # type: ignore[index]
    data["camera"]["fov"] = 150  # type: ignore[index]
    image = rendered(data, (401, 401), max_bounces=1)
    y, x = np.tan(np.radians(75)) * (np.mgrid[:401, :401] - 200) / 200.5
    sine = np.sqrt((x * x + y * y) / (1 + x * x + y * y))
    seen = image.linear[..., 0] > 0.5
    assert seen[sine < 1 / 1.5 - 0.01].all()
    assert not seen[sine > 1 / 1.5 + 0.01].any()


def lens(x: NDArray[np.float64], ior: float, wall: float) -> NDArray[np.float64]:
    """Where parallel rays at x, that meet a ball of glass of radius 1, arrive at z = wall."""
    enters = np.arcsin(x)
    within = np.arcsin(x / ior)
    # Twice the angle by which it is bent at a side, and the place where it leaves.
    bend = 2 * (enters - within)
    leaves = 2 * within - enters
    across, depth = np.sin(-leaves), np.cos(leaves)
    return np.asarray(-across - np.tan(bend) * (-wall - depth))


@pytest.mark.parametrize("others", [0, 20])
def test_a_ball_of_glass_is_a_lens(others: int) -> None:
    """Every ray through a ball arrives where Snell's law says; by name, and of a list."""
    glass = {"kd": [0, 0, 0], "ks": [0, 0, 0], "transmittance": 1, "ior": 1.5}
    wall = {"shape": "plane", "material": "white", "rotation": [90, 0, 0], "scale": [20, 1, 20]}
    far = {"shape": "cube", "material": "glass", "position": [0, 90, 0]}
    data: dict[str, object] = {
        "camera": {"eye": [0, 0, 5], "projection": "orthographic", "height": 0.01},
        "materials": {"glass": glass, "white": {"emissive": [1, 1, 1], "base_color": [0, 0, 0]}},
        "objects": {
            "ball": {"shape": "sphere", "material": "glass"},
            "wall": {**wall, "position": [10.1, 0, -1.5]},
            **{f"other{i}": far for i in range(others)},
        },
        "settings": {"technique": "whitted", "max_bounces": 4, "ambient": "none"},
    }
    image = rendered(data, (801, 5))
    x = (np.arange(801) - 400) * 0.002
    inside = np.abs(x) < 0.8
    arrives = lens(x[inside], 1.5, -1.5)
    seen = image.linear[2, inside, 0] > 0.5
    clear = np.abs(arrives - 0.1) > 5e-3
    np.testing.assert_array_equal(seen[clear], (arrives > 0.1)[clear])
    assert 0.1 < seen.mean() < 0.9


def test_glass_dims_a_shadow() -> None:
    """What lets half of the light through throws half a shadow."""
    glass = {"kd": [0, 0, 0], "ks": [0, 0, 0], "transmittance": 0.5}
    data = ball(
        floor={"shape": "plane", "material": "white", "position": [0, -2, 0], "scale": [9, 1, 9]},
        ball={"shape": "cube", "material": "glass"},
    )
    data["materials"] = {**data["materials"], "glass": glass}  # type: ignore[dict-item]
    data["camera"] = {"eye": [3, -1.9, 0.01], "target": [0, -2, 0], "fov": 60}
    data["lights"] = {"sun": {"type": "directional", "direction": [0, -1, 0], "intensity": 1}}
    found = np.unique(rendered(data, ambient="none").linear.round(4))
    want = np.round(np.array([0, 0.4, 0.8]) / np.pi, 4)
    np.testing.assert_allclose(found, want, atol=2e-4)


def test_the_scripts_numbers() -> None:
    """Directions (1.17), the distance to a sphere and a mirrored ray, in GLSL."""
    scene = lb.load("lab/ray-direction")
    half = np.tan(np.radians(25))
    x, y = 2 * (0.5 / 500) - 1, 1 - 2 * (0.5 / 400)
    found = glsl.call(
        "lib/ray.glsl", "throughPicture", [[x, y]], [[-half, 0, 0]], [[0, half * 0.8, 0]],
        [[0, 0, -1]],
    )  # fmt: skip
    unit = found[0] / np.linalg.norm(found[0])
    np.testing.assert_allclose(unit, [0.40, 0.32, -0.86], atol=5e-3)
    shown = [lb.render(scene, (500, 400), view=f"dir_{axis}").linear[0, 0].sum() for axis in "xyz"]
    np.testing.assert_allclose(shown, unit, atol=2e-6)
    direction = np.array([[0.3, 0.3, -1]])
    length = np.linalg.norm(direction)
    hit = glsl.call(
        "lib/sphere.glsl", "sphereHit", [[0, 0, 10]], direction / length, [[0, 0, 0]], [5.0]
    )
    assert hit[0] / length == pytest.approx(5.6007, abs=5e-5)
    incoming = np.array([[0.5, 0.5, 0]]) / np.hypot(0.5, 0.5)
    mirrored = glsl.call("lib/ray.glsl", "mirrored", incoming, [[0, 1, 0]])
    np.testing.assert_allclose(mirrored, [[0.71, -0.71, 0]], atol=5e-3)


def test_more_images_of_a_size_than_an_array_has_layers() -> None:
    """300 of them: two arrays, and each object still has its own."""
    names = [f"t{i}" for i in range(300)]
    images = {name: image(index) for index, name in enumerate(names)}
    data = ball()
    data["textures"] = {name: {"image": images[name], "filter": "nearest"} for name in names}
    data["materials"] = {
        name: {"emissive": [1, 1, 1], "maps": {"emissive": {"texture": name}}} for name in names
    }
    data["objects"] = {
        name: {
            "shape": "plane", "material": name, "position": [index % 20 - 9.5, 7 - index // 20, 0],
            "rotation": [90, 0, 0],
        }
        for index, name in enumerate(names)
    }  # fmt: skip
    data["camera"] = {"eye": [0, 0, 10], "projection": "orthographic", "height": 15}
    data["lights"] = {}
    seen = rendered(data, (20, 15), ambient="none").linear[..., 0] * 255
    np.testing.assert_allclose(seen.ravel(), np.arange(300) % 256, atol=1e-3)


def image(code: int) -> str:
    """The key of an image of one grey."""
    made = io.BytesIO()
    Pillow.new("L", (1, 1), code % 256).save(made, "PNG", pnginfo=chunk(str(code)))
    return assets.add_image(made.getvalue(), keep=True)


def chunk(text: str) -> PngInfo:
    """Text that makes the file another one."""
    info = PngInfo()
    info.add_text("Comment", text)
    return info
