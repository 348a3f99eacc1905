"""Shadows and maps at the ends of what a scene may say: sound, and as they must be there."""

import itertools
from typing import Any

import numpy as np
import pytest

import lightbench as lb
from lightbench.exact.directions import Array
from lightbench.scene import Scene
from lightbench.settings import Setting
from tests.cards import FACTORS, card, card_mesh, mapped, shown, texture
from tests.support import assert_sound, library

SIZE = (64, 48)
BIASES = library().choices("biases")
SHADOWS = [name for name in library().choices("shadows") if name != "none"]
POINT: dict[str, Any] = {"type": "point", "position": [1, 3, 1], "intensity": 20}
SPOT = POINT | {"type": "spot", "direction": [-0.3, -1, -0.3], "inner": 10, "outer": 40}
SUN: dict[str, Any] = {"type": "directional", "direction": [-0.4, -1, -0.3], "intensity": 3}
LIGHTS = {"point": POINT, "spot": SPOT, "sun": SUN}


def stage(light: dict[str, Any], factor: float = 1.0, shift: float = 0.0, **more: Any) -> Scene:
    """A ball over a floor under one light, of a size and in a place."""

    def put(*at: float) -> list[float]:
        return [c * factor + shift for c in at]

    lamp = dict(light)
    if "position" in lamp:
        lamp |= {"position": put(*lamp["position"]), "intensity": lamp["intensity"] * factor**2}
    floor = {
        "shape": "plane",
        "material": "grey",
        "scale": [8 * factor] * 3,
        "position": put(0, 0, 0),
    }
    ball = {
        "shape": "sphere",
        "material": "grey",
        "scale": 0.5 * factor,
        "position": put(0, 0.8, 0),
    }
    data: dict[str, Any] = {
        "camera": {"eye": put(0, 3, 5), "target": put(0, 0.3, 0), "fov": 50},
        "materials": {"grey": {}},
        "objects": {
            "floor": floor | {"material": "grey"},
            "ball": ball | {"material": "grey"},
        },
        "lights": {"lamp": lamp},
    }
    return Scene.parse(data | more)


def share(scene: Scene, **settings: Setting) -> Array:
    """(H, W) of the shadow view, which is sound, from 0 to 1."""
    given: dict[str, Setting] = {"shadow": "pcf", "shadow_resolution": 512, **settings}
    image = lb.render(scene, SIZE, **given, view="shadow")
    assert_sound(image)
    found = image.linear[..., 0].astype(np.float64)
    assert found.max() <= 1.0
    return found


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("shadow", SHADOWS)
def test_shadows_keep_with_size_and_place(shadow: str, light: str) -> None:
    """To the last bit for a power of two; else but for pixels at an edge. The sizes of PCSS's
    lights are in metres or degrees, and its penumbra with them."""
    for bias in BIASES:
        given: dict[str, Setting] = {"shadow": shadow, "bias": bias}
        want = share(stage(LIGHTS[light]), **given)
        assert 0.0 < (want < 0.5).mean() < 0.5
        for factor, shift in ((2.0**10, 0.0), (2.0**-10, 0.0), (1e3, 0.0), (1e-3, 0.0), (1.0, 1e5)):
            if shadow == "pcss":
                given["light_size"] = min(0.3 * factor, 3.0)
                if 0.3 * factor > 3.0 and light != "sun":
                    continue
            got = share(stage(LIGHTS[light], factor, shift), **given)
            off = np.abs(got - want) > 1e-3
            exact = factor != 1.0 and np.log2(factor) % 1.0 == 0.0
            assert off.mean() <= (0.0 if exact else 0.01), (bias, factor, shift)


PLACES = {
    "on the floor": [0.3, 0, 0.2], "just above it": [0.3, 1e-6, 0.2], "below it": [0.3, -1, 0.2],
    "in the ball": [0, 0.8, 0], "on the ball": [0, 1.3, 0], "at the eye": [0, 3, 5],
    "far": [1e5, 1e5, 1e5],
}  # fmt: skip


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("shadow", SHADOWS)
def test_a_light_anywhere_casts_sound_shadows(shadow: str, place: str) -> None:
    for light, bias in itertools.product((POINT, SPOT), BIASES):
        scene = stage(light | {"position": PLACES[place]})
        for view in ("shadow", "final"):
            given: dict[str, Setting] = {"shadow": shadow, "bias": bias, "shadow_resolution": 256}
            assert_sound(lb.render(scene, SIZE, **given, view=view))


@pytest.mark.parametrize("outer", [0.0, 1e-4, 1.0, 74.9, 75.1, 89.0, 90.0, 135.0, 180.0])
def test_a_cone_of_any_width_casts_shadows(outer: float) -> None:
    """Inside of it as the point light does, at an edge of texels between."""
    ball = share(stage(POINT), shadow="hard", shadow_resolution=1024)
    lit = shown_light(stage(SPOT | {"inner": outer, "outer": outer})) > 0.0
    for shadow in SHADOWS:
        cone = stage(SPOT | {"inner": outer, "outer": outer})
        got = share(cone, shadow=shadow, shadow_resolution=1024, light_size=0.0)
        off = np.abs(got - ball)[lit] > 0.5
        assert off.mean() < 0.03 if lit.any() else outer < 1.0, shadow


def shown_light(scene: Scene) -> Array:
    image = lb.render(scene, SIZE, ambient="none", model="lambert")
    assert_sound(image)
    return np.asarray(image.linear.max(axis=2), np.float64)


@pytest.mark.parametrize("light", LIGHTS)
def test_light_on_nothing(light: str) -> None:
    """A scene without objects, and one whose only object casts none: sound, with a map."""
    for objects in ({}, {"sheet": {"shape": "plane", "material": "clear", "scale": 8}}):
        materials = {"grey": {}, "clear": {"alpha_mode": "blend", "opacity": 0.5}}
        scene = stage(LIGHTS[light], objects=objects, materials=materials)
        for view in ("shadow", "final", "light_depth"):
            for shadow in SHADOWS:
                given: dict[str, Setting] = {"shadow": shadow, "shadow_resolution": 256}
                assert_sound(lb.render(scene, SIZE, view=view, **given))


@pytest.mark.parametrize("light", LIGHTS)
def test_any_far(light: str) -> None:
    """Beyond it all is lit; far beyond the scene, shadows stay where they are."""
    for shadow in ("hard", "pcf"):
        plain = share(stage(LIGHTS[light]), shadow=shadow)
        near = share(stage(LIGHTS[light] | {"far": 1e-6}), shadow=shadow)
        assert (near[plain == 1.0] == 1.0).all()
        assert near.mean() >= plain.mean()
        wide = share(stage(LIGHTS[light] | {"far": 100.0}), shadow=shadow)
        assert (np.abs(wide - plain) > 0.5).mean() < 0.02
        for bias in BIASES:
            share(stage(LIGHTS[light] | {"far": 1e6}), shadow=shadow, bias=bias)


@pytest.mark.parametrize("light", ["spot", "sun"])
def test_the_largest_map(light: str) -> None:
    """4096 texels a side: the same shadow with a finer edge."""
    coarse, fine = (share(stage(LIGHTS[light]), shadow_resolution=n) for n in (1024, 4096))
    assert (np.abs(coarse - fine) > 0.5).mean() < 0.01
    assert ((fine > 0) & (fine < 1)).mean() <= ((coarse > 0) & (coarse < 1)).mean()


# Maps

ODD: dict[str, dict[str, Any]] = {
    "no normal": {"maps": {"normal": {"texture": "grey"}}},
    "normal from below": {"maps": {"normal": {"texture": "black"}}, "normal_scale": 4.0},
    "normal across": {"maps": {"normal": {"texture": "red"}}, "normal_scale": 4.0},
    "mirror": {"maps": {"roughness": {"texture": "black"}}, "metalness": 1},
    "black metal": {"maps": {"base_color": {"texture": "black"}}, "metalness": 1},
    "all maps": {
        "maps": {
            slot: {"texture": "noise"}
            for slot in ("base_color", "roughness", "metalness", "normal", "occlusion")
        },
    },
    "brightest": {"emissive": [1e30, 1e30, 1e30], "maps": {"emissive": {"texture": "noise"}}},
    "tiny texels": {"maps": {"base_color": {"texture": "noise", "scale": [300, -300]}}},
    "one texel": {"maps": {"base_color": {"texture": "noise", "scale": [1e-4, 1e-4]}}},
    "moved": {"maps": {"base_color": {"texture": "noise", "offset": [1e4, -1e4], "rotation": 360}}},
    "no opacity": {"alpha_mode": "blend", "opacity": 0.0},
    "cut away": {"alpha_mode": "mask", "opacity": 0.0},
    "never cut": {"alpha_mode": "mask", "opacity": 0.0, "alpha_cutoff": 0.0},
    "always cut": {"alpha_mode": "mask", "opacity": 0.999, "alpha_cutoff": 1.0},
}  # fmt: skip
IMAGES = {
    "black": texture([0, 0, 0]), "grey": texture([128, 128, 128]), "red": texture([255, 128, 128]),
    "noise": texture(np.random.default_rng(5).integers(0, 256, (16, 16, 3))),
}  # fmt: skip


@pytest.mark.parametrize("odd", ODD)
def test_any_map_gives_a_sound_picture(odd: str) -> None:
    """Under every model and term and seen from both sides, on a card and a ball."""
    menu = library()
    choices: list[dict[str, Setting]] = [{"model": name} for name in menu.choices("models")]
    choices += [{"fresnel": name} for name in menu.stable("fresnels")]
    lights = {"lights": {"near": {**POINT, "position": [0.3, 0.8, 0.2]}}}
    for shape in ({}, {"shape": "sphere", "scale": 0.5}):
        scene = card({**FACTORS, **ODD[odd], "double_sided": True}, IMAGES, shape, **lights)
        for settings in choices:
            shown(scene, 24, ambient="constant", **settings)
        for view in menu.choices("views"):
            image = lb.render(scene, (24, 24), view=view, shadow="hard", shadow_resolution=256)
            assert image.invalid().total == 0, view


def test_what_is_wholly_clear_is_not_there() -> None:
    background: dict[str, Any] = {"background": [0.25, 0.5, 0.75]}
    for name in ("no opacity", "cut away", "always cut"):
        got = shown(card({**FACTORS, **ODD[name]}, IMAGES, **background))
        assert np.array_equal(got, np.broadcast_to(background["background"], got.shape)), name
    assert not np.array_equal(
        shown(card({**FACTORS, **ODD["never cut"]}, IMAGES, **background)), got
    )


def test_a_mesh_without_tangents() -> None:
    """Of length 0: the map's height counts, its slopes do not."""
    made = {"own": card_mesh(tangents=[[0, 0, 0, 1]] * 4)}
    scene = card(
        mapped("normal"),
        {"t": texture([250, 20, 220])},
        {"shape": "mesh", "mesh": "own"},
        meshes=made,
    )
    image = lb.render(scene, (8, 8), view="normal")
    np.testing.assert_allclose(image.linear, np.broadcast_to([0, 1, 0], (8, 8, 3)), atol=1e-6)


def test_outlines_at_any_distance() -> None:
    """A step wider than the picture, or a thousand times less than a pixel."""
    for factor in (1e-3, 1.0, 1e3):
        for kind in ("sobel", "sobel_depth"):
            for width in (1.0, 40.0):
                given: dict[str, Setting] = {"outline": kind, "outline_width": width}
                image = lb.render(stage(SUN, factor), SIZE, **given)
                assert_sound(image)
                assert (image.linear == 0.0).all(axis=2).any()
