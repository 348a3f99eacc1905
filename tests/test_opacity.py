"""Masked and blended surfaces, both sides of a card, and images that materials share."""

import itertools
from typing import Any

import numpy as np
import pytest

import lightbench as lb
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from tests.cards import (
    FACTORS,
    SIDE,
    attachment,
    card,
    card_mesh,
    mapped,
    shown,
    texture,
)
from tests.support import assert_sound

# Opacity


CHECKER = np.kron((np.indices((4, 4)).sum(axis=0) % 2), np.ones((2, 2), int))


def clear(below: int, above: int) -> dict[str, Any]:
    """A white image whose alpha is a checkerboard of two codes."""
    alpha = np.where(CHECKER, above, below)
    return texture(np.dstack([np.full((8, 8, 3), 255), alpha]), filter="nearest")


@pytest.mark.parametrize(
    ("cutoff", "opacity", "kept"), [(0.5, 1.0, 128), (0.5, 0.5, 255), (0.2, 1.0, 51)]
)
def test_a_mask_is_cut_out(cutoff: float, opacity: float, kept: int) -> None:
    """Below the cutoff nothing is there, in the picture and in a light's map; the rest is whole."""
    material = {
        **mapped("base_color"), "metalness": 0, "alpha_mode": "mask", "alpha_cutoff": cutoff,
        "opacity": opacity, "double_sided": True,
    }  # fmt: skip
    textures = {"t": clear(kept - 2, kept)}
    background = [0.1, 0.2, 0.3]
    scene = card({**material, "unlit": True}, textures, background=background)
    there = np.kron(CHECKER, np.ones((SIDE // 8, SIDE // 8), int))[..., None]
    want = np.where(there, [1.0, 1.0, 1.0], background)
    np.testing.assert_allclose(shown(scene), want, rtol=1e-6)
    scene = over_floor(material, textures)
    held = attachment(scene, "shadow_map.0", shadow="hard", shadow_resolution=256)[4:-4, 4:-4, 0]
    assert len(np.unique(held.round(3))) == 2
    assert (held < held.max() - 0.1).mean() == pytest.approx(0.5 / 4, abs=0.02)


def over_floor(material: dict[str, Any], textures: dict[str, Any]) -> Scene:
    """The card 1 m above an opaque floor of four times its area, the sun straight above."""
    data = card(material, textures, lights={"sun": {"type": "directional"}}).data()
    floor = {"shape": "plane", "material": "solid", "scale": [2, 1, 2], "position": [0, -1, 0]}
    for table, entry in (("materials", {"solid": {}}), ("objects", {"floor": floor})):
        data[table] = {**data[table], **entry}  # type: ignore[dict-item]
    return Scene.parse(data)


SHEETS = [([0.9, 0.1, 0.2], 0.25), ([0.2, 0.8, 0.1], 0.5), ([0.1, 0.3, 0.7], 0.75)]


@pytest.mark.parametrize("order", list(itertools.permutations(range(3))))
def test_blended_sheets_lie_over_each_other(order: tuple[int, ...]) -> None:
    """Back to front in whatever order the scene names them: c a + (1 - a) below, in float64."""
    background = np.array([0.4, 0.3, 0.2])
    sheets = {
        f"sheet{i}": {"shape": "plane", "material": f"own{i}", "position": [0, 0.2 * i, 0]}
        for i in order
    }
    materials = {
        f"own{i}": {"base_color": color, "opacity": alpha, "alpha_mode": "blend", "unlit": True}
        for i, (color, alpha) in enumerate(SHEETS)
    }
    data = card({}).data() | {
        "materials": materials,
        "objects": sheets,
        "background": background.tolist(),
    }
    want = background
    for color, alpha in SHEETS:
        want = np.array(color) * alpha + want * (1.0 - alpha)
    got = shown(Scene.parse(data))
    np.testing.assert_allclose(got, np.broadcast_to(want, got.shape), rtol=1e-6)


def test_opacity_is_the_product_of_its_sources() -> None:
    """The value, the map's alpha and the vertices' alpha."""
    colors = [[1, 1, 1, 0.5]] * 4
    material = {**mapped("base_color"), "opacity": 0.8, "alpha_mode": "blend", "unlit": True}
    shape, made = {"shape": "mesh", "mesh": "own"}, {"own": card_mesh(colors=colors)}
    scene = card(material, {"t": texture([255, 255, 255, 128])}, shape, meshes=made)
    np.testing.assert_allclose(shown(scene), 0.8 * 0.5 * 128 / 255, rtol=1e-5)


def test_what_is_behind_a_blended_sheet_is_hidden_from_none() -> None:
    """A sheet keeps no depth: what is opaque behind it shows through, what is in front hides it."""
    material = {"base_color": [1, 1, 1], "opacity": 0.5, "alpha_mode": "blend", "unlit": True}
    data = card(material).data()
    plain = {"base_color": [0, 0.6, 0], "unlit": True}
    data["materials"]["plain"] = plain  # type: ignore[index]
    for height, want in ((-0.5, [0.5, 0.8, 0.5]), (0.5, [0.0, 0.6, 0.0])):
        other = {"shape": "plane", "material": "plain", "position": [0, height, 0]}
        objects = {**data["objects"], "other": other}  # type: ignore[dict-item]
        got = shown(Scene.parse({**data, "objects": objects}))
        np.testing.assert_allclose(got, np.broadcast_to(want, got.shape), rtol=1e-6)


def test_a_blended_sheet_casts_no_shadow() -> None:
    scene = over_floor({"opacity": 0.5, "alpha_mode": "blend"}, {})
    held = attachment(scene, "shadow_map.0", shadow="hard", shadow_resolution=256)
    assert np.ptp(held[4:-4, 4:-4]) < 1e-6


# Both sides, one image, a seam


def test_both_sides_of_a_double_sided_card() -> None:
    """From below it is what a card turned over is from above; a single-sided one is not there."""
    below = {"lamp": {"type": "point", "position": [0.2, -1, 0.1], "intensity": 5}}
    camera = {"eye": [0, -2, 0], "up": [0, 0, 1], "projection": "orthographic", "height": 1}
    back: dict[str, Any] = {"camera": camera, "lights": below, "background": [0, 0, 0]}
    one = shown(card({**FACTORS, "double_sided": True}, **back))
    turned = shown(card(FACTORS, {}, {"rotation": [180, 0, 0]}, **back))
    np.testing.assert_allclose(one, turned, rtol=1e-5, atol=1e-6)
    assert one.min() > 0.01
    assert not shown(card(FACTORS, **back)).any()
    above = {"lamp": {"type": "point", "position": [0.2, 1, 0.1], "intensity": 5}}
    assert not shown(card({**FACTORS, "double_sided": True}, camera=camera, lights=above)).any()


def uploads() -> int:
    """Images that the renderer has sent to the GPU so far."""
    return on_gl_thread(lambda: renderer()._textures.uploads)


def test_an_image_is_uploaded_once() -> None:
    """However many materials, slots, textures of a scene and pictures share it."""
    codes = np.random.default_rng(77).integers(0, 256, (4, 4, 3))
    every = {name: texture(codes, wrap=[name, "repeat"]) for name in ("repeat", "clamp", "mirror")}
    materials = {
        f"own{i}": {
            "maps": {slot: {"texture": name} for slot in ("base_color", "roughness", "emissive")}
        }
        for i, name in enumerate(every)
    }
    objects = {f"card{i}": {"shape": "plane", "material": f"own{i % 3}"} for i in range(6)}
    data = card({}, every).data() | {"materials": materials, "objects": objects}
    before = uploads()
    for _ in range(2):
        shown(Scene.parse(data), ambient="constant")
    assert uploads() - before == 1


def test_a_ball_shows_no_seam() -> None:
    """Where u comes round to 0 a picture that repeats looks as it does at the other side."""
    x = np.arange(64) / 64.0
    wave = np.round(127.5 + 100.0 * np.sin(2 * np.pi * x * 4)).astype(int)
    codes = np.repeat(wave[None], 64, axis=0)
    pictures = []
    for turn in (0, 180):
        how: dict[str, Any] = {"offset": [turn / 360.0, 0]}
        shape = {"shape": "sphere", "scale": 0.5, "rotation": [0, turn, 0]}
        camera = {"camera": {"eye": [0, 0, 3], "fov": 22}}
        made = card(mapped("base_color", **how), {"t": texture(codes)}, shape, **camera)
        image = lb.render(made, (128, 128), view="base_color")
        assert_sound(image)
        pictures.append(image.linear[..., 0].astype(float))
    middle = np.s_[32:96, 32:96]
    assert np.ptp(pictures[0][middle]) > 0.7
    assert np.abs(pictures[0] - pictures[1])[middle].max() < 0.03
