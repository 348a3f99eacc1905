"""Shadow maps against rays in float64: where a light reaches, and what is drawn again."""

from collections.abc import Mapping

import numpy as np
import pytest
from numpy.typing import NDArray

import lightbench as lb
from lightbench.plan import plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from lightbench.settings import Setting
from lightbench.viewpoint import light_map
from tests.rays import rays
from tests.support import library

SIZE = (200, 150)
KINDS = ("hard", "pcf", "pcss")
BIASES = ("constant", "slope", "normal_offset")
LIGHTS: dict[str, dict[str, object]] = {
    "point": {"type": "point", "position": [1.5, 3.0, 1.0], "intensity": 20},
    "spot": {
        "type": "spot", "position": [1.5, 3.0, 1.0], "direction": [-1.5, -3.0, -1.0],
        "inner": 40, "outer": 60, "intensity": 20,
    },
    "wide spot": {
        "type": "spot", "position": [1.5, 3.0, 1.0], "direction": [-1.5, -3.0, -1.0],
        "inner": 80, "outer": 89, "intensity": 20,
    },
    "directional": {"type": "directional", "direction": [-0.5, -1.0, -0.3], "intensity": 3},
}  # fmt: skip
BALL = np.array([0.0, 0.7, 0.0])
RADIUS = 0.5


def scene(*lights: str) -> Scene:
    """A ball that floats over a floor."""
    return Scene.parse({
        "camera": {"eye": [0, 3, 5], "target": [0, 0.2, 0], "fov": 50},
        "materials": {"grey": {}},
        "objects": {
            "floor": {"shape": "plane", "material": "grey", "scale": [8, 1, 8]},
            "ball": {
                "shape": "sphere", "material": "grey", "position": BALL.tolist(),
                "scale": [RADIUS] * 3,
            },
        },
        "lights": {f"light{i}": LIGHTS[name] for i, name in enumerate(lights)},
    })  # fmt: skip


def reached(made: Scene, **settings: Setting) -> NDArray[np.float32]:
    """(H, W) share of the light that reaches each pixel."""
    image = lb.render(made, SIZE, view="shadow", samples=1, **settings)
    assert image.invalid().total == 0
    return image.linear[..., 0]


def positions(made: Scene) -> NDArray[np.float64]:
    """(H, W, 3) points that the pixels show, from the depth view."""
    away = lb.render(made, SIZE, view="depth").linear[..., :1].astype(float)
    origin, direction = rays(made, SIZE)
    at: NDArray[np.float64] = origin + away * direction
    return at


def clearance(made: Scene) -> NDArray[np.float64]:
    """(H, W) metres from the ball's surface to the line from a floor point to the first light."""
    at = positions(made)
    light = next(iter(made.lights.values()))
    if light.type == "directional":
        line = np.broadcast_to(-np.array(light.direction), at.shape)
    else:
        line = np.array(light.position) - at
    line = line / np.linalg.norm(line, axis=2, keepdims=True)
    to_ball = BALL - at
    along = (to_ball * line).sum(axis=2, keepdims=True)
    gap: NDArray[np.float64] = np.linalg.norm(to_ball - along * line, axis=2) - RADIUS
    return gap


def on_floor(made: Scene) -> NDArray[np.bool_]:
    """(H, W) whether a pixel shows the floor, inside of any cone of light."""
    at = positions(made)
    return (np.abs(at[..., 1]) < 1e-3) & (np.abs(at[..., 0]) < 3) & (np.abs(at[..., 2]) < 3)


def needed_bias(made: Scene, side: int, texels: float) -> NDArray[np.float64]:
    """(H, W) how much farther from the first light, squared over far squared, the floor is within
    so many texels to the side."""
    light = next(iter(made.lights.values()))
    kept = light_map(made, light, side)
    if light.type == "directional":
        line = np.array(light.direction)
        distance = np.asarray((positions(made) - kept.origin) @ kept.axis)
        texel = np.full(distance.shape, kept.texel)
    else:
        line = positions(made) - light.position
        distance = np.linalg.norm(line, axis=2)
        # Of a face that looks along the axis; a cube's faces are never as far aside.
        axial = line @ kept.axis if kept.to_clip else np.abs(line).max(axis=2)
        texel = kept.texel * axial
    cosine = np.maximum(np.abs(line[..., 1]) / np.linalg.norm(line, axis=-1), 1e-6)
    slope = np.sqrt(1.0 - cosine**2) / cosine
    farther = distance + np.sqrt(2.0) * texels * texel * slope
    return np.asarray((farther**2 - distance**2) / kept.far**2)


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("bias", BIASES)
@pytest.mark.parametrize("shadow", ["hard", "pcf"])
def test_the_shadow_of_a_ball(shadow: str, bias: str, light: str) -> None:
    """As rays in float64 have it, but for a border as wide as the filter and the bias make it.

    One number cannot be enough bias at every angle: where the floor's own slope needs more than
    5e-3, in the corners that a wide cone grazes, it is striped, and is not looked at.
    """
    made = scene(light)
    share = reached(made, shadow=shadow, bias=bias, shadow_resolution=2048, bias_constant=5e-3)
    floor, gap = on_floor(made), clearance(made)
    held = needed_bias(made, 2048, {"hard": 0.5, "pcf": 2.0}[shadow]) < 5e-3
    assert (floor & held).sum() > 0.9 * floor.sum()
    lit = floor & (gap > 0.05) & (held | (bias != "constant"))
    assert (share[lit] == 1).all()
    assert (share[floor & (gap < -0.05)] < 1e-6).all()
    assert (floor & (gap < -0.05)).sum() > 200


def test_a_filter_is_a_square_of_texels() -> None:
    """Across a straight edge PCF's share is the part of 2 r + 1 texels beyond it, exactly."""
    wall = Scene.parse({
        "camera": {"eye": [0, 4, 0], "up": [0, 0, -1], "fov": 30},
        "materials": {"grey": {}},
        "objects": {
            "floor": {"shape": "plane", "material": "grey", "scale": [4, 1, 4]},
            "roof": {
                "shape": "plane", "material": "grey", "scale": [2, 1, 4], "position": [-1, 5, 0],
            },
        },
        "lights": {"sun": {"type": "directional"}},
    })  # fmt: skip
    side = 256
    texel = light_map(wall, wall.lights["sun"], side).texel
    x = (np.arange(801) + 0.5 - 400.5) / 801 * 2 * 4 * np.tan(np.radians(15))
    for radius in (0, 1, 4):
        image = lb.render(
            wall, (801, 801), view="shadow", shadow="pcf", pcf_radius=radius,
            shadow_resolution=side,
        )  # fmt: skip
        share = image.linear[400, :, 0]
        width = (2 * radius + 1) * texel
        border = (share > 1e-6) & (share < 1.0)
        # The edge is where a texel's middle was drawn: at most half a texel off.
        want = np.clip(x / width + 0.5, 0.0, 1.0)
        assert np.abs(share - want).max() <= 0.51 * texel / width
        steps = np.diff(share[border]) / (np.diff(x)[0] / width)
        assert steps == pytest.approx(1.0, abs=0.05)
        assert border.sum() * np.diff(x)[0] == pytest.approx(width, abs=2 * np.diff(x)[0])


def noisy_share(share: NDArray[np.float32], made: Scene) -> float:
    """The share of floor far from any shadow that is not fully lit."""
    return float((share[on_floor(made) & (clearance(made) > 0.1)] < 1).mean())


@pytest.mark.parametrize("light", LIGHTS)
def test_without_bias_there_is_acne(light: str) -> None:
    """Figure 4.16 of the thesis: bias 0 stripes what is lit, 0.001 does not."""
    made = scene(light)
    fine: dict[str, Setting] = {"shadow": "hard", "bias": "constant", "shadow_resolution": 2048}
    striped = reached(made, **fine, bias_constant=0.0)
    clean = reached(made, **fine, bias_constant=0.001)
    assert noisy_share(striped, made) > 0.1
    assert noisy_share(clean, made) < 0.01


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("resolution", [256, 2048])
@pytest.mark.parametrize("bias", ["slope", "normal_offset"])
@pytest.mark.parametrize("shadow", KINDS)
def test_no_acne_at_any_resolution(shadow: str, bias: str, resolution: int, light: str) -> None:
    """What the light meets at up to 80 degrees is lit, on the floor and on the ball."""
    made = scene(light)
    share = reached(
        made, shadow=shadow, bias=bias, shadow_resolution=resolution, light_size=0.1, light_angle=1
    )
    at, floor = positions(made), on_floor(made)
    assert (share[floor & (clearance(made) > 0.4)] == 1).all()
    normal = (at - BALL) / RADIUS
    lamp = made.lights["light0"]
    to_light = -np.array(lamp.direction) if lamp.type == "directional" else lamp.position - at
    cosine = (normal * to_light).sum(axis=2) / np.linalg.norm(to_light, axis=-1)
    ball = np.abs(np.linalg.norm(normal, axis=2) - 1) < 0.02
    lit = ball & (cosine > np.cos(np.radians(75)))
    assert lit.sum() > 200
    assert (share[lit] == 1).all()


def test_softness_follows_the_light_s_size() -> None:
    """A penumbra as wide as similar triangles say, within a third: Fernando's estimate."""
    made = scene("point")
    for width in (0.2, 0.4):
        share = reached(made, shadow="pcss", light_size=width, shadow_resolution=1024, pcss_taps=64)
        soft = on_floor(made) & (share > 0.02) & (share < 0.98)
        spread = float(np.ptp(clearance(made)[soft]))
        light, ball = np.linalg.norm([1.5, 3.0, 1.0]), np.linalg.norm(BALL)
        assert spread == pytest.approx(width * ball / (light - ball), rel=0.5)


def test_beyond_far_is_lit() -> None:
    made = scene("point")
    near = {"lights.light0.far": 2.9}
    share = reached(made, shadow="hard", **near)
    assert (share[on_floor(made)] == 1).all()
    assert (reached(made, shadow="hard")[on_floor(made)] == 0).any()


def test_a_light_that_casts_none_has_no_map() -> None:
    made = scene("point", "directional")
    planned = plan(library(), made, {"shadow": "pcf", "lights.light0.casts": False}, SIZE)
    assert [p["target"] for p in planned["passes"]][:1] == ["shadow_map.1"]
    assert "u_shadow_map0" not in str(planned["programs"])
    off: dict[str, Setting] = {
        "shadow": "pcf",
        "lights.light0.casts": False,
        "lights.light1.casts": False,
    }
    planned = plan(library(), made, off, SIZE)
    assert [p["name"] for p in planned["passes"]] == ["forward", "display"]
    assert "shadow" not in planned["programs"][0]["fragment"]


def maps_drawn(made: Scene, settings: Mapping[str, Setting]) -> int:
    """How many light's maps a picture draws."""

    def count() -> int:
        before = renderer().runs["shadow_map"]
        renderer().run(plan(library(), made, settings, SIZE))
        return renderer().runs["shadow_map"] - before

    return on_gl_thread(count)


def test_a_map_is_drawn_when_its_light_or_a_caster_changes() -> None:
    made = scene("point", "spot", "directional", "wide spot")
    base: dict[str, Setting] = {"shadow": "hard", "shadow_resolution": 256}
    maps_drawn(made, base)
    assert maps_drawn(made, base) == 0
    assert maps_drawn(made, {**base, "camera.eye": "1,4,5"}) == 0
    assert maps_drawn(made, {**base, "model": "lambert", "lights.light0.intensity": 3}) == 0
    assert maps_drawn(made, {**base, "lights.light1.position": "1.4,3,1"}) == 1
    assert maps_drawn(made, base) == 1
    assert maps_drawn(made, {**base, "objects.ball.position": "0,0.8,0"}) == 4


def test_a_map_stays_when_only_a_table_that_others_read_changes() -> None:
    """Rays find the objects in a list about the eye."""
    made = lb.load("shadow-lab")
    # A size of its own, of which no test before has left a map.
    base: dict[str, Setting] = {
        "technique": "whitted", "shadow": "hard", "shadow_resolution": 300,
    }  # fmt: skip
    assert plan(library(), made, base, SIZE)["tables"]
    assert maps_drawn(made, base) > 0
    assert maps_drawn(made, {**base, "camera.eye": "1,4,5"}) == 0


@pytest.mark.parametrize("light", LIGHTS)
def test_seen_from_the_light_nothing_is_in_shadow(light: str) -> None:
    """The picture from the light shows what it reaches and nothing else."""
    made = scene(light)
    given: dict[str, Setting] = {"camera.light": "light0"}
    drawn = lb.render(made, SIZE, view="depth", **given).linear[..., 0] > 0
    share = reached(made, shadow="hard", **given)
    assert drawn.sum() > 500
    assert (share[drawn] == 0).sum() < 0.005 * drawn.sum()


def test_a_map_is_an_attachment() -> None:
    made = scene("point")
    planned = plan(library(), made, {"shadow": "hard"}, SIZE, "shadow_map.0")
    image = on_gl_thread(lambda: renderer().run(planned))
    assert image.linear.shape == (2048, 3072, 3)
    nearest = np.sqrt(image.linear[..., 0].min()) * 3.1
    assert nearest < np.linalg.norm(np.array([1.5, 3, 1]) - BALL)
    with pytest.raises(lb.LightbenchError, match=r"there is: shadow_map\.0"):
        plan(library(), made, {"shadow": "hard"}, SIZE, "shadow_map.1")
