"""Scenes: read, completed, refused with the path of the offending field."""

import copy
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lightbench as lb
from lightbench.errors import NotFoundError, SceneError, SettingError
from lightbench.plan import plan
from lightbench.scene import Scene
from lightbench.settings import resolve
from tests.support import SCENES, assert_sound, library, planned, presets

BASE: dict[str, Any] = {
    "materials": {"white": {}},
    "objects": {"ball": {"shape": "sphere", "material": "white"}},
    "lights": {
        "lamp": {"type": "point", "position": [2, 2, 2]},
        "torch": {"type": "spot", "position": [0, 3, 0], "inner": 10, "outer": 20},
        "sun": {"type": "directional"},
    },
}


def changed(path: str, value: object) -> dict[str, Any]:
    data = copy.deepcopy(BASE)
    at = data
    *parents, last = path.split(".")
    for key in parents:
        at = at.setdefault(key, {})
    at[last] = value
    return data


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("camera.fov", 0),
        ("camera.fov", float("nan")),
        ("camera.eye", [0, 0]),
        ("camera.zoom", 2),
        ("objects.ball.shape", "torus"),
        ("objects.ball.material", "gold"),
        ("objects.ball.scale", [1, 0, 1]),
        ("objects.ball.sectors", 2),
        ("materials.white.base_color", "#12345"),
        ("materials.white.base_color", [0.5, 2, 0]),
        ("materials.white.roughness", -0.1),
        ("materials.white.metalness", "much"),
        ("materials.White", {}),
        ("lights.lamp.type", "area"),
        ("lights.lamp.intensity", float("inf")),
        ("lights.lamp.unit", "watt"),
        ("lights.torch.inner", 30),
        ("lights.torch.direction", [0, 0, 0]),
        ("lights.sun.direction", "down"),
        ("background", "red"),
        ("lens", {}),
    ],
)
def test_a_wrong_field_is_named(path: str, value: object) -> None:
    with pytest.raises(SceneError) as caught:
        Scene.parse(changed(path, value), "test")
    message = str(caught.value)
    parent = path.rsplit(".", 1)[0]
    assert path in message or parent in message, message
    assert "\n" not in message


def test_f0_and_ior_exclude_each_other() -> None:
    data = changed("materials.white", {"f0": [0.1, 0.1, 0.1], "ior": 1.5})
    with pytest.raises(SceneError, match=r"materials\.white: give f0 or ior"):
        Scene.parse(data)


def test_an_eye_on_its_target_is_refused() -> None:
    with pytest.raises(SceneError, match="camera: eye, target and up"):
        Scene.parse(changed("camera", {"eye": [0, 0, 0]}))
    with pytest.raises(SceneError, match="camera: eye, target and up"):
        Scene.parse(changed("camera", {"eye": [0, 4, 0]}))


def test_a_light_keeps_only_parameters_that_a_choice_has() -> None:
    scene = Scene.parse(changed("lights.lamp.c3", 1.0))
    with pytest.raises(SceneError, match=r"lights\.lamp\.c3: no such field; allowed are: color"):
        resolve(library(), scene, {})
    scene = Scene.parse(changed("lights.lamp.c1", 0.25))
    made = plan(library(), scene, {"attenuation": "polynomial", "c1": 0.5}, (8, 8))
    uniforms = made["passes"][0]["batches"][0]["uniforms"]
    assert uniforms["u_light0_c1"] == [0.25]
    assert uniforms["u_light1_c1"] == [0.5]


def test_what_is_no_scene(tmp_path: Path) -> None:
    with pytest.raises(NotFoundError, match="box-room"):
        lb.load("ballroom")
    with pytest.raises(NotFoundError):
        lb.load(str(tmp_path / "none.json"))
    (tmp_path / "bad.json").write_text("{")
    with pytest.raises(SceneError, match="not a JSON file"):
        lb.load(str(tmp_path / "bad.json"))
    (tmp_path / "list.json").write_text("[]")
    with pytest.raises(SceneError):
        lb.load(str(tmp_path / "list.json"))
    (tmp_path / "good.json").write_text(json.dumps(BASE))
    assert lb.load(str(tmp_path / "good.json")).objects["ball"].shape == "sphere"


def test_the_presets_are_whole() -> None:
    assert {"box-room", "spheres", "metals", "single-sphere"} <= set(presets())
    for name in presets():
        scene = lb.load(name)
        assert scene.title
        assert scene.about
        assert Scene.parse(scene.data()) == scene
        assert json.loads((SCENES / f"{name}.json").read_text())["title"] == scene.title


def test_classic_units_light_a_white_surface_to_one() -> None:
    """[T]: a light of intensity 1 facing a white Lambert surface lights it to 1."""
    data = {
        "units": "classic",
        "camera": {"eye": [0, 1, 0], "up": [0, 0, 1]},
        "materials": {"white": {"base_color": [1, 1, 1]}},
        "objects": {"floor": {"shape": "plane", "material": "white", "scale": [9, 1, 9]}},
        "lights": {"sun": {"type": "directional", "direction": [0, -1, 0]}},
    }
    scene = Scene.parse(data)
    assert scene.lights["sun"].intensity == pytest.approx(math.pi)
    image = lb.render(scene, (8, 8), model="lambert", ambient="none")
    np.testing.assert_allclose(image.linear, 1.0, rtol=1e-6)


def test_lumen_are_spread_over_the_cone() -> None:
    """The flux of a spot, integrated over its profile, is what the scene says."""
    scene = Scene.parse(changed("lights.torch.unit", "lumen"))
    made = plan(library(), scene, {}, (8, 8))
    candela = made["passes"][0]["batches"][0]["uniforms"]["u_light1_intensity"][0]
    angle = np.linspace(0, math.radians(20), 200001)
    ramp = (np.cos(angle) - math.cos(math.radians(20))) / (
        math.cos(math.radians(10)) - math.cos(math.radians(20))
    )
    flux = np.trapezoid(np.clip(ramp, 0, 1) ** 2 * 2 * math.pi * np.sin(angle), angle) * candela
    assert flux == pytest.approx(1.0, rel=1e-5)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"modle": "phong"}, "no setting 'modle'"),
        ({"model": "fong"}, "allowed are: blinn_phong"),
        ({"samples": 2.5}, "whole number from 1 to 8"),
        ({"samples": 99}, "from 1 to 8"),
        ({"exposure": "bright"}, "is not a number"),
        ({"exposure": float("nan")}, "is not a number"),
        ({"camera.zoom": 2}, "allowed here are: eye"),
        ({"lights.moon.intensity": 2}, "lamp"),
        ({"materials.floor": 2}, "materials.floor"),
        ({"camera.eye": "1,2"}, "camera.eye"),
        ({"camera.eye": "a,b,c"}, "camera.eye"),
        ({"ambient_color": "blue"}, "ambient_color"),
    ],
)
def test_a_wrong_setting_is_named(settings: dict[str, Any], words: str) -> None:
    with pytest.raises((SettingError, SceneError)) as caught:
        planned("box-room", settings)
    assert words in str(caught.value)


def test_sphere_detail_follows_its_size_on_screen() -> None:
    def level(**settings: float) -> str:
        made = planned("single-sphere", settings, (640, 480))
        return str(made["passes"][0]["batches"][0]["draws"][0]["mesh"])

    assert level() < level(sphere_error=0.01)
    assert level(**{"camera.fov": 150.0}) < level()
    assert level(subdivision=6) == "icosphere-6"


def test_power_of_two_and_superposition() -> None:
    """2^k light gives the 2^k image bit by bit; lights add up."""
    off: dict[str, Any] = {f"lights.{name}.intensity": 0.0 for name in lb.load("box-room").lights}
    common: dict[str, Any] = {"ambient": "none"}
    one = lb.render("box-room", (64, 48), **{**common, **off, "lights.lamp.intensity": 3.0})
    eight = lb.render("box-room", (64, 48), **{**common, **off, "lights.lamp.intensity": 24.0})
    assert_sound(one)
    assert np.array_equal(one.linear * 8, eight.linear)
    parts = [
        lb.render("box-room", (64, 48), **{**common, **off, f"lights.{name}.intensity": 3.0})
        for name in lb.load("box-room").lights
    ]
    every = {f"lights.{name}.intensity": 3.0 for name in lb.load("box-room").lights}
    total = lb.render("box-room", (64, 48), **{**common, **every})
    np.testing.assert_allclose(sum(p.linear for p in parts), total.linear, rtol=1e-6, atol=1e-6)


def test_same_inputs_same_bytes() -> None:
    first, second = (lb.render("box-room", (96, 64)) for _ in range(2))
    assert first.png() == second.png()
    assert np.array_equal(first.linear, second.linear)


def test_supersampling_is_the_mean() -> None:
    fine = lb.render("spheres", (128, 96)).linear
    mean = fine.reshape(48, 2, 64, 2, 3).mean(axis=(1, 3))
    resolved = lb.render("spheres", (64, 48), samples=2).linear
    np.testing.assert_allclose(resolved, mean, rtol=1e-5, atol=1e-6)


def moved(scene: Scene, shift: float) -> Scene:
    """The scene with every place in it moved by `shift` along each axis."""
    data: Any = scene.data()
    for item in (data["camera"], *data["lights"].values(), *data["objects"].values()):
        for key in {"eye", "target", "position"} & set(item):
            item[key] = [c + shift for c in item[key]]
    return Scene.parse(data)


def test_far_from_the_origin_nothing_is_lost() -> None:
    """Positions are taken relative to the eye in float64: 1e5 away the picture is the same."""
    here = lb.load("single-sphere")
    there = lb.render(moved(here, 1e5), (64, 48)).linear
    np.testing.assert_allclose(there, lb.render(here, (64, 48)).linear, rtol=2e-5, atol=1e-6)
