"""The lab's scenes, traced on the GPU and by the float64 tracer of its script."""

import json

import numpy as np
import pytest

import lightbench as lb
from lightbench.plan import plan
from lightbench.scene import Scene
from lightbench.settings import Setting
from tests.lab.tables import SCENES
from tests.lab.tracer import trace
from tests.support import library

SIZE = (500, 400)
TOLERANCE, SHARE = 1e-4, 0.999


@pytest.mark.parametrize("name", SCENES)
def test_as_the_script_has_it(name: str) -> None:
    """Within 1e-4 of float64, but for pixels within one of an edge, and few of those."""
    image = lb.render(f"lab/{name}")
    assert image.linear.shape == (400, 500, 3)
    assert image.invalid().total == 0
    truth = trace(SCENES[name])
    wrong = np.abs(image.linear - truth.linear).max(axis=2) > TOLERANCE
    assert 1 - wrong.mean() >= SHARE
    assert not (wrong & ~truth.ids.edges()).any()


def test_nothing_more_than_two_spheres() -> None:
    """The plan of the first scene knows no light, texture, shadow, bounce or hierarchy."""
    made = json.dumps(plan(library(), lb.load("lab/sphere-intersection"), {}, SIZE))
    for word in ("light", "texture", "shadow", "bounce", "energy", "brdf", "triangle"):
        assert word not in made.replace("u_textures", "").replace('"textures": {}', ""), word


def one_ball(**ball: object) -> Scene:
    return Scene.parse({
        "camera": {"eye": [0, 0, 10], "target": [0, 0, 0], "fov": 50},
        "materials": {"white": {"kd": [1, 1, 1], "ks": [0, 0, 0], "ambient": [0.1, 0.1, 0.1]}},
        "objects": {"ball": {"shape": "sphere", "material": "white", **ball}},
        "lights": {"lamp": {"type": "point", "position": [3, 4, 10], "intensity": 100}},
        "settings": {"technique": "whitted", "shadow": "ray", "ambient": "lab"},
    })  # fmt: skip


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_a_scene_may_be_of_any_size(scale: float) -> None:
    """Lengths times a factor, under a light that does not fall off: the same picture."""
    given: dict[str, Setting] = {"attenuation": "none", "lights.lamp.intensity": 2.0}
    data = one_ball().data()
    data["camera"]["eye"] = [0, 0, 10 * scale]  # type: ignore[index]
    data["objects"]["ball"]["scale"] = [scale] * 3  # type: ignore[index]
    lamp = data["lights"]["lamp"]  # type: ignore[index]
    lamp["position"] = [3 * scale, 4 * scale, 10 * scale]
    lamp["intensity"] = 100 * scale * scale
    larger = lb.render(Scene.parse(data), (80, 60), **given)
    base = lb.render(one_ball(), (80, 60), **given)
    assert larger.invalid().total == 0
    np.testing.assert_allclose(larger.linear, base.linear, rtol=2e-4, atol=1e-6)


def test_a_sphere_far_away_keeps_its_outline() -> None:
    """At 1e4 radii, through a lens of 0.02 degrees: the disk that similar triangles say."""
    scene = one_ball(position=[0, 0, -9990], scale=1)
    found = lb.render(scene, (64, 64), **{"camera.fov": 1}).linear[..., 0] > 0
    assert found.sum() in range(4)
    near = one_ball(position=[0, 0, 0], scale=1e-3)
    zoomed = near.model_copy(
        update={"camera": near.camera.model_copy(update={"eye": (0, 0, 0.05)})}
    )
    disk = lb.render(zoomed, (200, 200), **{"camera.fov": 3}).linear[..., 0] > 0
    radius = np.sqrt(disk.sum() / np.pi)
    want = 100 * np.tan(np.arcsin(1e-3 / 0.05)) / np.tan(np.radians(1.5))
    assert radius == pytest.approx(want, rel=0.01)


def test_mirrors_that_face_each_other() -> None:
    """Eight bounces between two walls: each adds its ambient light, times the mirrors' shares."""
    wall = {"shape": "plane", "material": "mirror", "scale": [10, 1, 10]}
    scene = Scene.parse({
        "units": "classic",
        "camera": {"eye": [0, 0, 0], "target": [0, 0, -1], "fov": 20},
        "materials": {"mirror": {
            "kd": [0, 0, 0], "ks": [0, 0, 0], "ambient": [0.1, 0.1, 0.1], "reflectance": 0.5,
        }},
        "objects": {
            "front": {**wall, "position": [0, 0, -1], "rotation": [90, 0, 0]},
            "back": {**wall, "position": [0, 0, 1], "rotation": [-90, 0, 0]},
        },
        "lights": {"lamp": {"type": "point", "position": [0, 0.5, 0]}},
        "settings": {
            "technique": "whitted", "model": "lab", "ambient": "lab", "max_bounces": 8,
            "min_energy": 0.0,
        },
    })  # fmt: skip
    image = lb.render(scene, (9, 9))
    want = 0.1 * sum(0.5**k for k in range(9))
    np.testing.assert_allclose(image.linear[4, 4], want, rtol=1e-5)
    short = lb.render(scene, (9, 9), min_energy=0.2).linear[4, 4]
    np.testing.assert_allclose(short, 0.1 * (1 + 0.5 + 0.25), rtol=1e-5)
