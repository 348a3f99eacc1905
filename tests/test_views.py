"""Every view shows what it says: against directions, distances and terms in float64."""
# ruff: noqa: E741  (l is the direction to the light)

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lightbench as lb
from lightbench.exact import views
from lightbench.exact.directions import Array, unit
from lightbench.scene import Scene
from lightbench.settings import Setting
from tests.cards import SIDE, attachment, card, card_mesh, centres, mapped, shown, texture
from tests.rays import plane, rays, sphere
from tests.samples import evaluate, single
from tests.support import SHADERS, copy_of_shaders, library

SIZE = (96, 72)
METAL: dict[str, Any] = {"base_color": [0.9, 0.6, 0.3], "metalness": 0.7, "roughness": 0.4}
LAMPS: dict[str, Any] = {
    "near": {"type": "point", "position": [1, 1.5, 0.5], "intensity": 20},
    "sun": {"type": "directional", "direction": [0.5, -1, 0.4], "intensity": 2},
    "beam": {
        "type": "spot", "position": [-1, 2, 1], "direction": [0.4, -1, -0.5], "inner": 20,
        "outer": 40, "intensity": 30,
    },
    "under": {"type": "point", "position": [0, -1, 0], "intensity": 50},
}  # fmt: skip


def table(camera: dict[str, Any] | None = None, **more: Any) -> Scene:
    """A floor that fills the picture, under three lights that it faces and one that it does not."""
    eye = {"eye": [0.5, 2, 3], "target": [0, 0, 0], "fov": 40}
    data: dict[str, Any] = {
        "camera": camera or eye,
        "materials": {"own": METAL},
        "objects": {"floor": {"shape": "plane", "material": "own", "scale": [40, 1, 40]}},
        "lights": LAMPS,
    }
    return Scene.parse(data | more)


def view(scene: Scene, name: str, size: tuple[int, int] = SIZE, /, **settings: Setting) -> Array:
    """(H, W, 3) of a view's linear picture."""
    image = lb.render(scene, size, **{"view": name, **settings})
    assert image.invalid().total == 0
    return image.linear.astype(np.float64)


PARALLEL = {"eye": [0.5, 2, 3], "target": [0, 0, 0], "projection": "orthographic", "height": 2}
CAMERAS: dict[str, dict[str, Any] | None] = {"perspective": None, "parallel": PARALLEL}


# Of the surface


@pytest.mark.parametrize("camera", CAMERAS)
def test_normals_of_a_tilted_plane_and_a_ball(camera: str) -> None:
    tilted = {"shape": "plane", "material": "own", "scale": [40, 1, 40], "rotation": [30, 0, -20]}
    scene = table(CAMERAS[camera], objects={"floor": tilted})
    a, b = math.radians(30), math.radians(-20)
    # Rx then Ry then Rz of +y.
    about_x = np.array([0.0, math.cos(a), math.sin(a)])
    n = [about_x[0] * math.cos(b) - about_x[1] * math.sin(b),
         about_x[0] * math.sin(b) + about_x[1] * math.cos(b), about_x[2]]  # fmt: skip
    got = view(scene, "normal")
    np.testing.assert_allclose(got, np.broadcast_to(n, got.shape), atol=1e-6)
    ball: dict[str, Any] = {
        "shape": "sphere", "material": "own", "scale": 0.7, "position": [0.2, 0.1, 0],
    }  # fmt: skip
    scene = table(CAMERAS[camera], objects={"ball": ball})
    seen = rays(scene, SIZE)
    t = sphere(seen, ball["position"], 0.7)
    hit = np.isfinite(t)
    want = unit((seen[0] + np.where(hit, t, 0.0)[..., None] * seen[1])[hit] - ball["position"])
    got = view(scene, "normal", subdivision=7)[hit]
    inner = (want * -seen[1][hit]).sum(axis=1) > 0.2
    assert inner.sum() > 500
    np.testing.assert_allclose(got[inner], want[inner], atol=1e-3)


@pytest.mark.parametrize("camera", CAMERAS)
def test_depth_is_the_ray_s_length(camera: str) -> None:
    """From the eye, in metres; 0 where nothing is."""
    scene = table(CAMERAS[camera])
    seen = rays(scene, SIZE)
    t = plane(seen, [0, 0, 0], [0, 1, 0])
    at = seen[0] + t[..., None] * seen[1]
    want = np.linalg.norm(at - scene.camera.eye, axis=-1)
    got = view(scene, "depth")
    np.testing.assert_allclose(got[..., 0], want, rtol=1e-5)
    assert not view(table(objects={}), "depth").any()


def test_uv_of_a_plane() -> None:
    """u to the right and v down, each from 0 to 1, over and over."""
    want = np.concatenate([centres(), np.zeros((SIDE, SIDE, 1))], axis=-1)
    np.testing.assert_allclose(shown(card({}), view="uv"), want, atol=1e-6)
    twice = [[0, 2], [2, 2], [2, 0], [0, 0]]
    made = {"own": card_mesh(uvs=twice)}
    scene = card({}, {}, {"shape": "mesh", "mesh": "own"}, meshes=made)
    np.testing.assert_allclose(shown(scene, view="uv"), 2 * want % 1, atol=1e-5)


def test_tangents_run_along_u() -> None:
    """Unit, in the world, turned with the object and stretched as it is."""
    long = [[2, 0, 0, 1]] * 4
    made = {"own": card_mesh(tangents=long)}
    for turn in (0, 30, -90):
        shape = {"shape": "mesh", "mesh": "own", "rotation": [0, turn, 0], "scale": [3, 1, 3]}
        image = lb.render(card({}, {}, shape, meshes=made), (8, 8), view="tangent")
        a = math.radians(turn)
        want = [math.cos(a), 0.0, -math.sin(a)]
        np.testing.assert_allclose(image.linear, np.broadcast_to(want, (8, 8, 3)), atol=1e-6)
        assert image.invalid().total == 0


def test_values_of_the_material() -> None:
    scene = table()
    for name in ("base_color", "metalness", "roughness"):
        got = view(scene, name)
        np.testing.assert_allclose(got, np.broadcast_to(METAL[name], got.shape), rtol=1e-6)
    got = view(scene, "ambient", ambient_level=0.3)
    np.testing.assert_allclose(
        got, np.broadcast_to(np.array(METAL["base_color"]) * 0.3, got.shape), rtol=1e-6
    )


def test_signed_views_count_no_negatives(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A normal points anywhere; what is no number is counted all the same, and shown."""
    scene = Scene.parse({
        "materials": {"own": {}},
        "objects": {"ball": {"shape": "sphere", "material": "own"}},
    })  # fmt: skip
    for samples_ in (1, 2):
        image = lb.render(scene, SIZE, view="normal", samples=samples_)
        assert image.linear.min() < -0.5
        assert image.invalid().total == 0
    text = (
        (SHADERS / "views" / "normal.glsl")
        .read_text()
        .replace("return n;", "return sqrt(n - 2.0);")
    )
    shaders = copy_of_shaders(tmp_path, {"views/normal.glsl": text})
    monkeypatch.setenv("LIGHTBENCH_SHADERS", str(shaders))
    for samples_ in (1, 2):
        image = lb.render(scene, SIZE, view="normal", samples=samples_)
        assert image.invalid().nan > 500
        assert (image.display[np.isnan(image.linear).any(axis=2)] == [255, 0, 255]).all()


# Of the light


MODELS = [
    m
    for m in library().choices("models")
    if "toneLevel" not in library().files[f"models/{m}.glsl"].functions
]


@pytest.mark.parametrize("shadow", ["none", "pcf"])
@pytest.mark.parametrize("model", MODELS)
def test_the_parts_add_up_to_the_whole(model: str, shadow: str) -> None:
    """Diffuse, specular and ambient light and what is emitted are the radiance; of an unlit thing
    nothing is but what it emits."""
    data: Any = lb.load("box-room").data()
    data["materials"]["gold"] = {**METAL, "emissive": [0.5, 0.25, 0.0]}
    some = next(iter(data["objects"].values()))
    some["material"] = "gold"
    given: dict[str, Setting] = {"model": model, "shadow": shadow, "shadow_resolution": 256}
    scene = Scene.parse(data)
    parts = [view(scene, name, **given) for name in ("diffuse", "specular", "ambient")]
    dark: dict[str, Setting] = {f"lights.{name}.intensity": 0.0 for name in scene.lights}
    shining = view(scene, "final", **given, **dark, ambient="none")
    assert shining.max() == pytest.approx(0.5)
    np.testing.assert_allclose(
        np.sum(parts, axis=0) + shining, view(scene, "final", **given), rtol=1e-5, atol=1e-6
    )
    unlit = card({"unlit": True}, lights=LAMPS)
    for name in ("diffuse", "specular", "distribution", "fresnel", "masking", "shadow"):
        assert not shown(unlit, view=name).any(), name


def lit_floor(scene: Scene) -> tuple[Array, list[Array], Array]:
    """Points of the floor (N, 3), directions to each light that it faces, and to the viewer, in
    the floor's frame, z up."""
    seen = rays(scene, SIZE)
    t = plane(seen, [0, 0, 0], [0, 1, 0])
    at = (seen[0] + t[..., None] * seen[1]).reshape(-1, 3)
    frame = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    lights = []
    for light in list(scene.lights.values())[:3]:
        toward = -np.array(light.direction) if light.type == "directional" else light.position - at
        lights.append(unit(np.broadcast_to(toward, at.shape)) @ frame.T)
    return at, lights, -seen[1].reshape(-1, 3) @ frame.T


TERMS = [
    (term, library().folders[folder].setting, choice)
    for term, folder in (
        ("distribution", "distributions"), ("masking", "maskings"), ("fresnel", "fresnels"),
    )
    for choice in library().stable(folder)
]  # fmt: skip


@pytest.mark.parametrize("camera", CAMERAS)
@pytest.mark.parametrize(("term", "setting", "choice"), TERMS)
def test_a_term_is_the_mean_over_the_lights(
    term: str, setting: str, choice: str, camera: str
) -> None:
    """What the function is in float64 for the directions of each light that the floor faces."""
    scene = table(CAMERAS[camera])
    _, lights, v = lit_floor(scene)
    f0 = 0.04 * 0.3 + 0.7 * np.array(METAL["base_color"])
    m = {"roughness": np.array([0.4]), "f0": f0[None]}
    m |= {k: x[None].astype(np.float64) for k, x in complex_index(f0).items()}
    form = {
        "distribution": views.distribution_term,
        "masking": views.masking_term,
        "fresnel": views.fresnel_term,
    }[term]
    want = np.mean([form(m, l, v, **{setting: choice}) for l in lights], axis=0)
    got = view(scene, term, **{setting: choice}).reshape(-1, 3)
    # The place of a pixel is rounded, and a lobe as steep as 6 to the width turns that into more.
    np.testing.assert_allclose(got, np.broadcast_to(want, got.shape), rtol=1e-4)


def complex_index(f0: Array) -> dict[str, Array]:
    """eta and k that a material of that reflectance and metalness 0.7 has."""
    row, share = single(f0[None]), single([0.7])
    return {
        name: evaluate("lib/conductor.glsl", f"{name}Of", (row, share), {})[0]
        for name in ("eta", "k")
    }


@pytest.mark.parametrize("shadow", ["hard", "pcf", "pcss"])
def test_the_shadow_factor_is_the_visibility(shadow: str) -> None:
    """Of one light: what is left of a matt surface's light. Of more, the mean over those faced."""
    ball = {"shape": "sphere", "material": "own", "scale": 0.4, "position": [0, 0.5, 0]}
    floor = {"shape": "plane", "material": "own", "scale": [40, 1, 40]}
    given: dict[str, Setting] = {
        "shadow": shadow,
        "shadow_resolution": 512,
        "model": "lambert",
        "ambient": "none",
    }
    singles = []
    for name in ("near", "sun"):
        scene = table(lights={name: LAMPS[name]}, objects={"ball": ball, "floor": floor})
        lit, plain = (view(scene, "final", **{**given, "shadow": s}) for s in (shadow, "none"))
        share = view(scene, "shadow", **given)
        np.testing.assert_allclose(lit, share * plain, rtol=1e-5, atol=1e-7)
        assert 0.0 < share[plain > 0].mean() < 1.0
        singles.append(share[..., 0])
    both = {name: LAMPS[name] for name in ("near", "sun")}
    scene = table(lights=both, objects={"ball": ball, "floor": floor})
    on_floor = view(scene, "normal")[..., 1] > 1.0 - 1e-6
    mean = view(scene, "shadow", **given)[..., 0]
    np.testing.assert_allclose(mean[on_floor], np.mean(singles, axis=0)[on_floor], atol=1e-6)


def test_overdraw_counts_every_layer() -> None:
    """Hidden or not, blended too, but for what a mask cuts out."""
    layers = {
        f"card{i}": {"shape": "plane", "material": "own", "position": [0, 0.1 * i, 0]}
        for i in range(5)
    }
    for mode in ("opaque", "blend"):
        scene = Scene.parse(card({"alpha_mode": mode, "opacity": 0.5}).data() | {"objects": layers})
        for samples_ in (1, 2):
            assert (shown(scene, view="overdraw", samples=samples_) == 5.0).all()
    half = texture(np.array([[[255, 255, 255, 0], [255, 255, 255, 255]]]), filter="nearest")
    masked = {**mapped("base_color"), "alpha_mode": "mask"}
    scene = Scene.parse(card(masked, {"t": half}).data() | {"objects": layers})
    row = shown(scene, view="overdraw")[SIDE // 2, :, 0]
    assert (row[: SIDE // 2] == 0.0).all()
    assert (row[SIDE // 2 :] == 5.0).all()


def test_a_light_s_depth_is_its_map() -> None:
    """Texel for texel where the picture is as large as the map, grey beside it; and for a light
    without a map."""
    scene = table()
    for index, (width, height) in ((0, (768, 512)), (1, (256, 256)), (2, (256, 256))):
        given: dict[str, Setting] = {"shadow": "hard", "shadow_resolution": 256}
        held = attachment(scene, f"shadow_map.{index}", (64, 64), **given)
        assert held.shape == (height, width, 3)
        got = view(scene, "light_depth", (width, height), **given, depth_light=index)
        assert np.array_equal(got, held)
    wide = view(scene, "light_depth", (512, 256), **given, depth_light=1)
    assert (wide[:, :128] == np.float32(0.18)).all()
    assert np.ptp(wide[:, 128:384]) > 0.01
    dark = view(scene, "light_depth", (32, 32), depth_light=7)
    assert (dark == np.float32(0.18)).all()


# A parallel camera


def highlight(scene: Scene, size: tuple[int, int]) -> tuple[float, float]:
    """Column and row of the brightest pixel."""
    image = view(scene, "specular", size, model="blinn_phong", subdivision=7).sum(axis=2)
    row, column = np.unravel_index(np.argmax(image), image.shape)
    return float(column) + 0.5, float(row) + 0.5


@pytest.mark.parametrize("light", [[1, -1, -1], [-1, -0.2, -1], [0.3, 1, -0.5]])
def test_a_parallel_camera_has_one_direction_to_the_eye(light: list[float]) -> None:
    """A ball's highlight is where the normal lies between light and eye, wherever the ball is."""
    for place in ([0, 0, 0], [1.2, -0.8, 0.5]):
        scene = Scene.parse({
            "camera": {"eye": [0, 0, 5], "projection": "orthographic", "height": 4},
            "materials": {"own": {"shininess": 200, "ks": [0.5, 0.5, 0.5], "kd": [0, 0, 0]}},
            "objects": {"ball": {"shape": "sphere", "material": "own", "position": place}},
            "lights": {"sun": {"type": "directional", "direction": light, "intensity": 3}},
        })  # fmt: skip
        h = unit(unit(-np.array(light, float)) + np.array([0.0, 0.0, 1.0]))
        want = 100 + (place[0] + h[0]) * 50, 100 - (place[1] + h[1]) * 50
        assert highlight(scene, (200, 200)) == pytest.approx(want, abs=1.0)


def test_a_parallel_camera_is_one_far_away() -> None:
    """A perspective picture comes nearer by half for half the angle of view."""
    parallel = Scene.parse({
        "camera": {"eye": [0, 1, 4], "projection": "orthographic", "height": 3},
        "materials": {"own": METAL},
        "objects": {
            "ball": {"shape": "sphere", "material": "own"},
            "wall": {"shape": "plane", "material": "own", "rotation": [90, 0, 0], "scale": 20,
                     "position": [0, 0, -1]},
        },
        "lights": {"sun": LAMPS["sun"], "near": {**LAMPS["near"], "position": [1, 2, 3]}},
    })  # fmt: skip
    want = view(parallel, "final", subdivision=6)
    off = []
    for fov in (4.0, 2.0, 1.0):
        away = 1.5 / math.tan(math.radians(fov) / 2)
        eye = unit(np.array([0.0, 1.0, 4.0])) * away
        camera: dict[str, Setting] = {"camera.projection": "perspective", "camera.fov": fov}
        camera["camera.eye"] = ",".join(map(str, eye))
        got = view(parallel, "final", subdivision=6, **camera)
        near = np.abs(got - want) < 0.5
        assert near.mean() > 0.98
        off.append(np.abs(got - want)[near].mean())
    assert off[2] < 0.015 * want.mean()
    assert off[1] < 0.7 * off[0]
    assert off[2] < 0.7 * off[1]
