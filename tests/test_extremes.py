"""Whole pictures at the ends of every range: sound, or infinite only where float32 has no value.

The one limit of a picture is the range of float32: a radiance above FLOAT_MAX is infinite in it,
counted and shown in its loud colour. It is never NaN, never negative, and nothing else is infinite.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import lightbench as lb
from lightbench.front_matter import Parameter
from lightbench.glsl import call
from lightbench.image import Image
from lightbench.scene import Scene
from lightbench.values import MAX_CANDELA
from tests.browser import browsing, render_in, serving
from tests.samples import Single, single
from tests.support import SHADERS, assert_sound, copy_of_shaders, library, presets

Settings = dict[str, Any]

SIZE = (40, 30)
FLOAT_MAX = float(np.finfo(np.float32).max)
# So much less light that no radiance of a scene is beyond float32.
DIMMER = 2.0**-100
INTENSITIES = (0.0, 1e-30, 1.0, 65504.0, 1e19, 1e30)
CONES = ((0, 0), (0, 90), (30, 30), (90, 90), (180, 180), (0, 180), (1e-4, 1e-4), (89.999, 90))
COLORS = ("0,0,0", "1,1,1", "1,0,1e-30")
EXPONENTS = (0.0, 1.0, 1e4, 1e6, "auto")


def assert_within_range(preset: str, given: Settings) -> None:
    """Sound, but for infinities whose true value a picture with less light shows to be too large.

    Radiance is linear in the light, so the dimmed picture times 1 / DIMMER is the true one. A pixel
    of several samples is infinite where one of them is: see passes/resolve.glsl.
    """
    image = lb.render(preset, SIZE, **given)
    counts = image.invalid()
    assert counts.nan == counts.negative == 0, (counts, given)
    # Nothing after it makes a NaN of a number either: every transfer shows that in magenta, which
    # light without green has by right.
    loud = (image.display == [255, 0, 255]).all(axis=2) & (image.linear[..., 1] > 0)
    assert not loud.any(), given
    if counts.inf:
        n = int(given.get("samples", 1))
        fine = (SIZE[0] * n, SIZE[1] * n)
        dim = lb.render(preset, fine, **{**given, "samples": 1, **dimmed(preset, given)})
        assert_sound(dim)
        true = dim.linear.astype(np.float64) / DIMMER
        true = true.reshape(SIZE[1], n, SIZE[0], n, 3).max(axis=(1, 3))
        assert (true[np.isinf(image.linear)] > 0.999 * FLOAT_MAX).all(), given


def dimmed(preset: str, given: Settings) -> Settings:
    """Every light of the scene, as set, DIMMER times as bright."""
    lights = {f"lights.{n}.intensity": v.intensity for n, v in lb.load(preset).lights.items()}
    return {name: given.get(name, default) * DIMMER for name, default in lights.items()}


# Settings at random

# What a hundred pictures should not pay for: the largest maps have a test of their own.
COSTLY = {"shadow_resolution": (256, 512)}


def values(name: str, parameter: Parameter) -> st.SearchStrategy[Any]:
    """Anything that a slider can give, its ends as often as what lies between."""
    if name in COSTLY:
        return st.sampled_from(COSTLY[name])
    if parameter.kind == "bool":
        return st.booleans()
    if parameter.kind == "color":
        return st.sampled_from(["0,0,0", "1,1,1", "1e30,0,1e-30"])
    low, high = parameter.range or (0.0, 1.0)
    if parameter.kind == "int":
        return st.integers(int(low), int(high))
    return between(low, high)


def between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.sampled_from([low, high]) | st.floats(low, high)


def menu() -> st.SearchStrategy[Settings]:
    """A choice of every folder, and any of the parameters.

    A textbook form is there to fail, which its own tests show.
    """
    found = library()
    choices = {f.setting: st.sampled_from(found.stable(n)) for n, f in found.folders.items()}
    parameters = {n: p for file in found.files.values() for n, p in file.meta.parameters.items()}
    return st.fixed_dictionaries(
        choices, optional={name: values(name, p) for name, p in parameters.items()}
    )


def materials(scene: Scene) -> st.SearchStrategy[Settings]:
    """One surface for all objects, some of its fields as the scene has them."""
    fields = {
        "roughness": between(0.0, 1.0),
        "metalness": between(0.0, 1.0),
        "shininess": st.sampled_from(EXPONENTS),
        "base_color": st.sampled_from(COLORS),
        "kd": st.sampled_from([*COLORS, "auto"]),
        "ks": st.sampled_from([*COLORS, "1e30,1,0", "auto"]),
    }
    drawn = st.fixed_dictionaries({}, optional=fields)
    return drawn.map(
        lambda one: {f"materials.{m}.{k}": v for m in scene.materials for k, v in one.items()}
    )


def places(scene: Scene) -> list[list[float]]:
    """The eye, what it looks at, and on, above, below and inside each object."""
    found = [list(scene.camera.eye), list(scene.camera.target)]
    for thing in scene.objects.values():
        for factor in (0.0, 1.0, -1.0, 1.0 + 1e-7, -1e-4):
            x, y, z = thing.position
            found.append([x, y + factor * thing.scale[1], z])
    return found


def lights(scene: Scene) -> st.SearchStrategy[Settings]:
    """Each light somewhere, as bright and as wide as it may be."""
    parameters = {
        name: values(name, parameter)
        for file in library().files.values()
        for name, parameter in file.meta.parameters.items()
        if parameter.per == "light"
    }
    drawn = []
    for name, light in scene.lights.items():
        fields = {"intensity": st.sampled_from(INTENSITIES)}
        optional = dict(parameters)
        if light.type != "directional":
            optional["position"] = st.sampled_from(places(scene))
            optional["unit"] = st.sampled_from(["candela", "lumen"])
        if light.type == "spot":
            fields["cone"] = st.sampled_from(CONES)
        one = st.fixed_dictionaries(fields, optional=optional)
        drawn.append(one.map(partial(light_settings, name)))
    return st.tuples(*drawn).map(lambda every: {k: v for one in every for k, v in one.items()})


def light_settings(name: str, given: Mapping[str, Any]) -> Settings:
    fields = {f"lights.{name}.{key}": value for key, value in given.items() if key != "cone"}
    if "cone" in given:
        inner, outer = given["cone"]
        fields |= {f"lights.{name}.inner": inner, f"lights.{name}.outer": outer}
    return fields


@pytest.mark.parametrize("preset", presets())
@settings(derandomize=True, database=None, deadline=None, max_examples=25)
@given(data=st.data())
def test_any_settings(preset: str, data: st.DataObject) -> None:
    scene = lb.load(preset)
    parts = st.tuples(
        menu(), materials(scene), lights(scene), st.sampled_from([{}, {"camera.fov": 170}])
    )
    assert_within_range(preset, {k: v for part in data.draw(parts) for k, v in part.items()})


# One extreme at a time, for every choice

POINTS = ("lamp", "spot")
ALL = {f"lights.{name}": name for name in ("lamp", "spot", "window")}
EDGES: dict[str, Settings] = {
    "no light": {f"{light}.intensity": 0.0 for light in ALL},
    "faintest": {f"{light}.intensity": 1e-30 for light in ALL},
    "brightest": {f"{light}.intensity": 1e30 for light in ALL},
    "mirrors": {f"materials.{m}.roughness": 0.0 for m in lb.load("box-room").materials},
    "exponent": {f"materials.{m}.shininess": 1e6 for m in lb.load("box-room").materials},
    "at the eye": {f"lights.{name}.position": "0,1.9,4.6" for name in POINTS},
    "on the floor": {f"lights.{name}.position": "0,0,0" for name in POINTS},
    "behind the wall": {f"lights.{name}.position": "0,1,-3.001" for name in POINTS},
    "equal cones": {"lights.spot.inner": 24.0, "lights.spot.outer": 24.0},
    "no cone": {"lights.spot.inner": 0.0, "lights.spot.outer": 0.0},
    "whole sphere": {"lights.spot.inner": 180.0, "lights.spot.outer": 180.0},
    "no constant": {"attenuation": "polynomial", "lights.lamp.c0": 0.0, "lights.spot.c0": 0.0},
    "white from black": {"tonemap": "reinhard_extended", "L_white": 0.0},
}


@pytest.mark.parametrize("edge", list(EDGES))
def test_every_choice_at_every_edge(edge: str) -> None:
    found = library()
    for folder, about in found.folders.items():
        for choice in found.stable(folder):
            assert_within_range("box-room", EDGES[edge] | {about.setting: choice})


def test_beyond_float32_is_infinite_and_loud() -> None:
    """A mirror's peak of 3e7 under 1e30 cd is a picture's value at 4 m and beyond float32 at 1 mm:
    infinite there, yellow in the view of invalid values, and nowhere NaN."""
    bright: Settings = {
        "lights.key.intensity": 1e30, "materials.surface.roughness": 0.0, "light_radius": 1e-4,
        "materials.surface.metalness": 1.0, "materials.surface.base_color": "1,1,1",
    }  # fmt: skip
    far = lb.render("single-sphere", (41, 31), **bright, **{"lights.key.position": "0,0,4.2"})
    assert_sound(far)
    assert far.linear.max() > 1e34
    near = {**bright, "lights.key.position": "0,0,1.001", "view": "invalid"}
    image = lb.render("single-sphere", (41, 31), **near)
    assert image.invalid().inf > 0
    assert image.invalid().nan == image.invalid().negative == 0
    assert (image.display[np.isinf(image.linear).any(axis=2)] == [255, 255, 0]).all()
    assert_within_range("single-sphere", near)


def test_the_mean_of_finite_samples_is_finite() -> None:
    """Of values whose sum is beyond float32 too."""
    surface: Settings = {"model": "phong", "materials.surface.shininess": 0.0, "ambient": "none"}
    surface["materials.surface.kd"] = "0,0,0"
    light: Settings = {"attenuation": "polynomial", "c0": 0.0, "c1": 0.0, "c2": 0.0}
    bright: Settings = surface | light | {"lights.key.intensity": 1e30}
    bright["materials.surface.ks"] = f"{3e4 * math.pi},0,{3e4 * math.pi}"
    for samples in (1, 2, 3, 8):
        image = lb.render("single-sphere", (41, 31), **bright, samples=samples)
        assert_sound(image)
        assert image.linear[15, 20] == pytest.approx([3e38, 0.0, 3e38], rel=1e-5)


def test_a_white_of_zero_makes_everything_white() -> None:
    """Everything but black: down to a millionth of a unit of radiance, at any intensity."""
    for intensity in (1e-3, 1.0, 1e30):
        given = {f"{light}.intensity": intensity for light in ALL}
        image = lb.render("box-room", SIZE, **given, tonemap="reinhard_extended", L_white=0.0)
        assert_sound(image)
        assert (image.display[(image.linear > 1e-6).all(axis=2)] == 255).all()


# Sizes and places

SCALES = {"1e-3": 1e-3, "1e3": 1e3, "2^10": 1024.0, "2^-10": 2.0**-10}
# Each light shrinks to its smallest radius; the polynomial's coefficients have units of their own.
# An outline's width is said at 1 m, and the lab's ambient light is that of lamps at any distance.
LAWFUL: Settings = {
    "attenuation": "inverse_square", "light_radius": 1e-4, "outline": "none", "ambient": "constant",
}  # fmt: skip
# Relative error of a pixel, of no less than a thousandth of a unit of radiance: what rounding the
# other numbers costs. A power of two rounds nothing. Two pixels of a hundred with maps or shadows
# may show how texels are filtered, and which side of a shadow's edge it is on.
SCALED, MOVED = 1e-4, 1e-6
EDGE_PIXELS = 0.02


def scaled(scene: Scene, factor: float) -> Scene:
    """The scene enlarged, its lights brighter by the square: the same picture."""
    data: Any = scene.data()
    for item in placed(data):
        for key in {"eye", "target", "position", "scale"} & set(item):
            item[key] = [c * factor for c in item[key]]
    for light in data["lights"].values():
        light["intensity"] *= 1.0 if light["type"] == "directional" else factor**2
    return Scene.parse(data)


def moved(scene: Scene, shift: float) -> Scene:
    """The scene with every place in it moved by `shift` along each axis."""
    data: Any = scene.data()
    for item in placed(data):
        for key in {"eye", "target", "position"} & set(item):
            item[key] = [c + shift for c in item[key]]
    return Scene.parse(data)


def placed(data: Any) -> list[Any]:
    return [data["camera"], *data["lights"].values(), *data["objects"].values()]


def worst(preset: str, change: Callable[[Scene], Scene], loose: float = 0.0, **more: Any) -> float:
    """Largest relative error of a pixel between a preset and the changed one, but for a share of
    the pixels where the preset has textures or shadows."""
    here = lb.load(preset)
    sizes = (160, 120)
    want = lb.render(here, sizes, **LAWFUL, **more)
    got = lb.render(change(here), sizes, **LAWFUL, **more)
    assert_sound(want)
    assert_sound(got)
    off = np.abs(got.linear.astype(np.float64) - want.linear)
    every = (off / np.maximum(want.linear, 1e-3)).max(axis=2)
    detailed = bool(here.textures) or here.settings.get("shadow", "none") != "none"
    return float(np.quantile(every, 1.0 - detailed * loose))


MODELS = library().choices("models")
# A model that jumps shows on which side of its edge a pixel was rounded.
SMOOTH = [m for m in MODELS if "continuity" not in library().files[f"models/{m}.glsl"].meta.breaks]


def error_of(change: Callable[[Scene], Scene], loose: float = 0.0) -> float:
    """That of the worst pixel of any preset under any smooth model; of the lab's, the fullest."""
    scenes = [p for p in presets() if not p.startswith("lab/")] + ["lab/reflectance2"]
    return max(worst(preset, change, loose, model=m) for preset in scenes for m in SMOOTH)


@pytest.mark.parametrize("name", list(SCALES))
def test_a_scene_of_another_size(name: str, note: Callable[[str], None]) -> None:
    power = name.startswith("2^")
    off = error_of(lambda scene: scaled(scene, SCALES[name]), 0.0 if power else EDGE_PIXELS)
    note(f"every preset scaled by {name}: each pixel within {off:.1e}")
    assert off <= (0.0 if power else SCALED)


def test_a_scene_in_another_place(note: Callable[[str], None]) -> None:
    off = error_of(lambda scene: moved(scene, 1e5))
    note(f"every preset moved by 1e5: each pixel within {off:.1e}")
    assert off <= MOVED


# Lights at their limits


def floor(light: Settings, **more: Any) -> Image:
    """A white matt floor from 4 m above, with one light; pixel (20, 20) of 41 sees its middle."""
    scene = {
        "camera": {"eye": [0, 4, 0], "up": [0, 0, -1]},
        "materials": {"white": {"base_color": [1, 1, 1]}},
        "objects": {"floor": {"shape": "plane", "material": "white", "scale": [4, 1, 4]}},
        "lights": {"one": {"position": [0, 1, 0], **light}},
    }
    return lb.render(Scene.parse(scene), (41, 41), **{"model": "lambert", "ambient": "none"} | more)


def test_a_light_on_the_surface_or_behind_it_adds_nothing() -> None:
    for height in (0.0, -1e-6, -1.0, -1e5):
        for attenuation in library().choices("attenuations"):
            given = {"type": "point", "intensity": 1e30, "position": [0, height, 0]}
            assert not floor(given, attenuation=attenuation).linear.any(), height


def test_a_light_just_above_the_surface() -> None:
    """Straight below it rho / pi I / d^2, and no more than at the light's radius."""
    for height in (1e-3, 0.01, 1.0, 100.0):
        for intensity in (1e-30, 1.0, 65504.0, 1e19, 1e30):
            given = {"type": "point", "intensity": intensity, "position": [0, height, 0]}
            image = floor(given, attenuation="inverse_square", light_radius=0.01)
            assert_sound(image)
            want = intensity / math.pi / max(height, 0.01) ** 2
            # At 1 mm a pixel's own rounding of its place, 1e-7 m, is not yet seen.
            assert image.linear[20, 20] == pytest.approx(want, rel=1e-5), (height, intensity)


def test_a_spot_of_equal_cones_has_a_hard_edge() -> None:
    """Lit as by a point light inside the cone, black outside, nothing between."""
    plain = floor({"type": "point"}).linear
    for angle, lit in ((0.0, 0), (20.0, None), (50.0, None), (90.0, 41), (180.0, 41)):
        image = floor({"type": "spot", "inner": angle, "outer": angle})
        assert_sound(image)
        on = np.asarray((image.linear > 0.0).all(axis=2))
        assert np.array_equal(image.linear[on], plain[on])
        across = int(on[20].sum())
        pixel = 4.0 * math.tan(math.radians(22.5)) * 2.0 / 41
        expected = 2.0 * math.tan(math.radians(angle)) / pixel if lit is None else lit
        assert abs(across - expected) <= 1.5, angle


def test_flux_through_hardly_any_cone_is_finite() -> None:
    """As candela the flux over the cone's solid angle, at most MAX_CANDELA; no cone, no light."""
    for angle, intensity in itertools.product((0.0, 1e-12, 1e-7, 1e-5, 1.0), (1.0, 1e30)):
        light = {"type": "spot", "inner": angle, "outer": angle, "unit": "lumen"}
        image = floor(light | {"intensity": intensity})
        assert_sound(image)
        solid = 4.0 * math.pi * math.sin(math.radians(angle) / 2.0) ** 2
        candela = min(intensity / solid, MAX_CANDELA) if solid else 0.0
        assert image.linear[20, 20] == pytest.approx(candela / math.pi, rel=1e-5), angle


# Normals without a length

NORMALS = (0.0, 1e-40, 1e-30, 1e-12)


def no_normals(folder: Path, factor: str) -> Path:
    """A shader folder whose meshes have normals as short as that."""
    text = (SHADERS / "stages" / "object.glsl").read_text()
    old, new = "u_normal_matrix * a_normal;", f"u_normal_matrix * a_normal * {factor};"
    assert text.count(old) == 1
    return copy_of_shaders(folder, {"stages/object.glsl": text.replace(old, new)})


def test_zero_length_normals_of_a_function(tmp_path: Path) -> None:
    """They become the direction to the eye, whose frame is as good as any."""
    code = """#include "lib/frame.glsl"
vec3 column(vec3 n, vec3 v, float i) {
    return basis(facingNormal(unitNormal(n, v), v))[int(i)];
}
"""
    shaders = copy_of_shaders(tmp_path, {"lib/column.glsl": code})
    v: Single = single(list(np.eye(3)) + list(-np.eye(3)) + [[0.6, 0.0, -0.8]])
    for length in NORMALS:
        n = single(np.full(3, length))
        columns = [
            call("lib/column.glsl", "column", n, v, single([i]), shaders=shaders) for i in range(3)
        ]
        assert np.array_equal(columns[2], v)
        assert np.abs(np.linalg.norm(columns, axis=2) - 1.0).max() < 1e-6


@pytest.mark.parametrize("factor", ["0.0", "1e-30", "1e-12"])
def test_zero_length_normals_of_a_mesh(
    factor: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LIGHTBENCH_SHADERS", str(no_normals(tmp_path, factor)))
    for preset, chosen in [
        *((p, {}) for p in presets()),
        *(("box-room", {"model": m}) for m in MODELS),
    ]:
        image = lb.render(preset, SIZE, **chosen)
        assert_sound(image)
        assert image.linear.max() > 0.01


# In the browser

CASES: list[tuple[str, Settings]] = [
    *(("box-room", edge) for edge in EDGES.values()),
    ("box-room", EDGES["brightest"] | EDGES["mirrors"]),
    ("box-room", EDGES["exponent"] | {"model": "phong"}),
    ("box-room", EDGES["at the eye"] | EDGES["mirrors"] | {"masking": "none"}),
    ("single-sphere", {"lights.key.position": "0,0,1", "materials.surface.roughness": 0.0}),
]


def test_the_same_in_the_browser(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Bit by bit what the offline renderer makes, finite and not negative."""
    with browsing("llvmpipe") as browser:
        for shaders, cases in ((SHADERS, CASES), (no_normals(tmp_path, "1e-30"), CASES[:1])):
            monkeypatch.setenv("LIGHTBENCH_SHADERS", str(shaders))
            with serving() as address:
                page = browser.new_page()
                page.goto(address)
                page.evaluate("window.lightbench.ready")
                for preset, given in cases:
                    linear, display, name = render_in(page, preset, given, SIZE)
                    assert np.isfinite(linear).all(), given
                    assert (linear >= 0.0).all(), given
                    offline = lb.render(preset, SIZE, **given)
                    if "llvmpipe" in name and "llvmpipe" in offline.renderer:
                        assert np.array_equal(linear, offline.linear), given
                        assert np.array_equal(display, offline.display), given


# What tells a broken pass from a whole one, of test_scene.py and of this file: see
# mutation_checks.py.
SCENE_LAWS = ["test_power_of_two_and_superposition", "test_supersampling_is_the_mean"]
IMAGE_LAWS = [
    "test_a_light_on_the_surface_or_behind_it_adds_nothing",
    "test_a_light_just_above_the_surface",
    "test_a_spot_of_equal_cones_has_a_hard_edge",
    "test_flux_through_hardly_any_cone_is_finite",
    "test_a_scene_of_another_size",
    "test_every_choice_at_every_edge",
]
