"""Maps of a material: each texel where it belongs, meaning what its slot says."""

import itertools
from typing import Any

import numpy as np
import pytest

import lightbench as lb
from lightbench.errors import GraphicsError
from lightbench.exact.directions import Array, unit
from lightbench.exact.display import srgb_code
from lightbench.scene import Scene
from lightbench.settings import Setting
from tests.cards import FACTORS, SIDE, WHITE, card, card_mesh, centres, mapped, shown, texture
from tests.support import library

LAMPS = {
    "near": {"type": "point", "position": [0.6, 1.1, 0.4], "intensity": 3},
    "sun": {"type": "directional", "direction": [0.5, -1, 0.2], "intensity": 2},
}


# Texels


def test_srgb_texels_are_decoded() -> None:
    """Linear ones are code / 255; sRGB is right to half a code: drivers approximate it."""
    codes = np.arange(256).reshape(16, 16)
    for encoding in ("srgb", "linear"):
        scene = card(
            mapped("base_color"), {"t": texture(codes, encoding=encoding, filter="nearest")}
        )
        got = shown(scene, view="base_color")[2::4, 2::4, 0]
        if encoding == "linear":
            np.testing.assert_allclose(got, codes / 255.0, rtol=1e-6)
        else:
            assert np.abs(srgb_code(got) * 255.0 - codes).max() < 0.5


def test_texels_are_decoded_before_they_are_mixed() -> None:
    """Half way from black to white is half the light, not code 128."""
    scene = card(
        mapped("base_color"), {"t": texture([[[0], [255]]], encoding="srgb", wrap=["clamp"] * 2)}
    )
    row = shown(scene, view="base_color", anisotropy=1)[SIDE // 2, :, 0]
    want = np.clip(2.0 * centres()[0, :, 0] - 0.5, 0.0, 1.0)
    np.testing.assert_allclose(row, want, atol=0.006)


@pytest.mark.parametrize(
    ("wrap", "axis"), list(itertools.product(["repeat", "clamp", "mirror"], (0, 1)))
)
def test_texels_repeat_end_or_turn_back(wrap: str, axis: int) -> None:
    """Four texels over three widths, from -1 to 2, along one axis; along the other one repeats."""
    codes = np.array([10, 90, 170, 250]).reshape((1, 4) if axis == 0 else (4, 1))
    wraps = ["repeat", "repeat"]
    wraps[axis] = wrap
    how: dict[str, Any] = (
        {"scale": [3, 1], "offset": [-1, 0]} if axis == 0 else {"scale": [1, 3], "offset": [0, -1]}
    )
    textures = {"t": texture(codes, filter="nearest", wrap=wraps)}
    got = shown(card(mapped("base_color", **how), textures), 48, view="base_color")[..., 0]
    line = got[20] if axis == 0 else got[:, 20]
    texel = np.floor((-1.0 + 3.0 * (np.arange(48) + 0.5) / 48.0) * 4.0).astype(int)
    index = {
        "repeat": texel % 4,
        "clamp": np.clip(texel, 0, 3),
        "mirror": np.where(texel % 8 < 4, texel % 8, 7 - texel % 8),
    }[wrap]
    np.testing.assert_allclose(line, codes.ravel()[index] / 255.0, rtol=1e-6)


TRANSFORMS: list[tuple[tuple[float, float], float, tuple[float, float]]] = [
    ((0.3, 0.0), 0, (1, 1)), ((0.0, 0.2), 0, (1, 1)), ((0, 0), 0, (3, 2)), ((0, 0), 30, (1, 1)),
    ((0, 0), -90, (1, 1)), ((0.1, -0.4), 200, (2.5, 0.7)), ((0, 1), 0, (1, -1)),
]  # fmt: skip


@pytest.mark.parametrize(("offset", "rotation", "scale"), TRANSFORMS)
def test_a_transform_is_that_of_float64(
    offset: tuple[float, float], rotation: float, scale: tuple[float, float]
) -> None:
    """KHR_texture_transform: scaled, turned so that u leans towards where v is less, moved."""
    codes = np.random.default_rng(1).integers(0, 256, (8, 8))
    how: dict[str, Any] = {"offset": offset, "rotation": rotation, "scale": scale}
    scene = card(mapped("base_color", **how), {"t": texture(codes, filter="nearest")})
    got = shown(scene, view="base_color")[..., 0]
    u, v = np.moveaxis(centres() * scale, -1, 0)
    c, s = np.cos(np.radians(rotation)), np.sin(np.radians(rotation))
    at = np.stack([c * u + s * v + offset[0], c * v - s * u + offset[1]], axis=-1) * 8.0
    texel = np.floor(at).astype(int) % 8
    inside = np.abs(at - np.round(at)).min(axis=-1) > 1e-3
    assert inside.mean() > 0.8
    want = codes[texel[..., 1], texel[..., 0]] / 255.0
    np.testing.assert_allclose(got[inside], want[inside], rtol=1e-6)


def test_a_map_reads_the_second_coordinates() -> None:
    """u and v exchanged there: the transposed image."""
    codes = np.random.default_rng(2).integers(0, 256, (8, 8))
    uv1 = np.array([[1, 0], [1, 1], [0, 1], [0, 0]])
    shape = {"shape": "mesh", "mesh": "turned"}
    made = {"turned": card_mesh(uvs1=uv1)}
    textures = {"t": texture(codes, filter="nearest")}
    for uv, want in ((0, codes), (1, codes.T)):
        scene = card(mapped("base_color", uv=uv), textures, shape, meshes=made)
        got = shown(scene, view="base_color")[4::8, 4::8, 0]
        np.testing.assert_allclose(got, want / 255.0, rtol=1e-6)


def test_two_maps_of_a_texture_are_read_each_its_own_way() -> None:
    """The same image as base colour, and moved by half its width as roughness."""
    codes = np.array([[[0, 0, 0], [255, 200, 100]]])
    material = {
        **WHITE,
        "maps": {
            "base_color": {"texture": "t"},
            "roughness": {"texture": "t", "channels": "g", "offset": [0.5, 0]},
        },
    }
    scene = card(material, {"t": texture(codes, filter="nearest")})
    color, rough = (shown(scene, view=view)[5, [16, 48]] for view in ("base_color", "roughness"))
    np.testing.assert_allclose(color, codes[0] / 255.0, atol=1e-7)
    np.testing.assert_allclose(rough[:, 0], [200 / 255, 0], atol=1e-7)


# Slots


@pytest.mark.parametrize("channel", "rgba")
@pytest.mark.parametrize("slot", ["roughness", "metalness", "occlusion"])
def test_a_scalar_slot_reads_its_channel(slot: str, channel: str) -> None:
    codes = [40, 90, 140, 190]
    scene = card(mapped(slot, channels=channel), {"t": texture(codes)})
    want = codes["rgba".index(channel)] / 255.0
    if slot == "occlusion":
        got = shown(scene, ambient="constant", ambient_level=1.0)
    else:
        got = shown(scene, view=slot)
    np.testing.assert_allclose(got, want, rtol=1e-5)


def variants() -> list[dict[str, Setting]]:
    """Every model, and under the microfacet model every choice of its terms.

    But one under which an image is no factor of the surface's colours: test_lab_scenes.py.
    """
    menu = library()
    found: list[dict[str, Setting]] = [
        {"model": name}
        for name in menu.choices("models")
        if "modulated" not in menu.files[f"models/{name}.glsl"].functions
    ]
    for folder in ("distributions", "maskings", "fresnels"):
        found += [{menu.folders[folder].setting: name} for name in menu.stable(folder)]
    return found


BASE = (180, 90, 40)
GIVEN: dict[str, dict[str, Any]] = {
    "derived": {},
    "index": {"ior": 2.0},
    "reflectance": {"f0": [0.1, 0.2, 0.3]},
    "classic": {"kd": [0.5, 0.4, 0.3], "ks": [0.6, 0.5, 0.4], "shininess": 20},
    "shininess": {"shininess": 12},
    "complex": {"eta": [0.2, 0.9, 1.2], "k": [3.9, 2.4, 2.2]},
}


@pytest.mark.parametrize("given", GIVEN)
def test_a_map_of_one_texel_is_a_factor(given: str) -> None:
    """Under every model and term: what follows from a mapped value follows as from a plain one."""
    maps = {
        "base_color": {"texture": "base"},
        "roughness": {"texture": "orm", "channels": "g"},
        "metalness": {"texture": "orm", "channels": "b"},
    }
    textures = {"base": texture(BASE), "orm": texture([10, 150, 200])}
    base = np.multiply(FACTORS["base_color"], np.array(BASE) / 255.0)
    plain = {
        "base_color": base.tolist(),
        "metalness": FACTORS["metalness"] * 200 / 255,
        "roughness": FACTORS["roughness"] * 150 / 255,
    }
    more = dict(GIVEN[given])
    if "kd" in more:
        more["kd"] = np.multiply(more["kd"], np.array(BASE) / 255.0).tolist()
    shape, lights = {"shape": "sphere", "scale": 0.5}, {"lights": LAMPS}
    one = card({**FACTORS, **GIVEN[given], "maps": maps}, textures, shape, **lights)
    two = card({**plain, **more}, {}, shape, **lights)
    for settings in variants():
        got, want = (shown(scene, ambient="constant", **settings) for scene in (one, two))
        assert want.max() > 0.1
        assert_close(got, want, settings)


def assert_close(got: Array, want: Array, settings: dict[str, Setting]) -> None:
    """Within 1e-5 but for pixels at an edge between two tones, which the smallest error moves."""
    off = np.abs(got - want) > 1e-6 + 2e-5 * want
    assert off.mean() < (1e-3 if settings.get("model") == "toon" else 1e-9), (settings, got[off])


def test_vertex_colours_are_factors() -> None:
    """Linear ones, mixed over a triangle; with a map both count, as does their alpha."""
    u, v = np.moveaxis(centres(), -1, 0)
    colors = [[0, 1, 0.5, 1], [1, 1, 0.5, 1], [1, 0, 0.5, 1], [0, 0, 0.5, 1]]
    want = np.stack([u, v, 0.0 * u + 0.5], axis=-1)
    shape, made = {"shape": "mesh", "mesh": "own"}, {"own": card_mesh(colors=colors)}
    plain = {"base_color": [0.8, 0.6, 0.4]}
    got = shown(card(plain, {}, shape, meshes=made), view="base_color")
    np.testing.assert_allclose(got, want * [0.8, 0.6, 0.4], atol=1e-6)
    both = card(
        {**plain, "maps": {"base_color": {"texture": "t"}}},
        {"t": texture(BASE)},
        shape,
        meshes=made,
    )
    want = want * [0.8, 0.6, 0.4] * np.array(BASE) / 255.0
    np.testing.assert_allclose(shown(both, view="base_color"), want, atol=1e-6)


# Normal maps


def test_a_flat_normal_map_changes_nothing() -> None:
    """To the last bit, on a card and on a ball."""
    flat, lights = {"t": texture([128, 128, 255])}, {"lights": LAMPS}
    for shape in ({}, {"shape": "sphere", "scale": 0.5}):
        plain = shown(card(FACTORS, {}, shape, **lights))
        bumpy = {**FACTORS, "maps": {"normal": {"texture": "t"}}, "normal_scale": 3.0}
        assert np.array_equal(shown(card(bumpy, flat, shape, **lights)), plain)


@pytest.mark.parametrize("scale", [0.0, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_normal_map_tilts_the_normal(scale: float, sign: float) -> None:
    """Red towards where u grows, green up the image, or down it for a mirrored tangent; the same on
    a card that is stretched."""
    rgb = (200, 170, 220)
    material = {**mapped("normal"), "normal_scale": scale}
    made = {"own": card_mesh(tangents=[[1, 0, 0, sign]] * 4)}
    x, y, z = (np.array(rgb) - 128.0) / 127.0
    want = unit(np.array([scale * x, z, -sign * scale * y]))
    for stretch in ([1, 1, 1], [3, 1, 2], [50, 50, 50], [1000, 1, 1000]):
        shape = {"shape": "mesh", "mesh": "own", "scale": stretch}
        scene = card(material, {"t": texture(rgb)}, shape, meshes=made)
        got = shown_signed(scene, "normal")
        np.testing.assert_allclose(got, np.broadcast_to(want, got.shape), atol=1e-6)


def shown_signed(scene: Scene, view: str, side: int = SIDE) -> Array:
    """A view of vectors."""
    image = lb.render(scene, (side, side), view=view)
    assert image.invalid().total == 0
    return image.linear.astype(np.float64)


def test_a_tilted_normal_is_lit_as_a_tilted_card() -> None:
    """Lambert's cosine with the mapped normal."""
    rgb = (210, 100, 230)
    sun = {"sun": {"type": "directional", "direction": [-0.4, -1, 0.3], "intensity": np.pi}}
    scene = card({**mapped("normal"), "metalness": 0}, {"t": texture(rgb)}, lights=sun)
    x, y, z = (np.array(rgb) - 128.0) / 127.0
    cosine = unit(np.array([x, z, -y])) @ unit(np.array([0.4, 1.0, -0.3]))
    np.testing.assert_allclose(shown(scene, model="lambert"), cosine, rtol=1e-5)


# Occlusion, emission


def test_occlusion_dims_ambient_light_alone() -> None:
    strength = 0.7
    material = {**FACTORS, "emissive": [0.5, 0.25, 0.125], "occlusion_strength": strength}
    hollow = {**material, "maps": {"occlusion": {"texture": "t", "channels": "r"}}}
    textures = {"t": texture([51, 0, 0])}
    plain, dim = card(material, lights=LAMPS), card(hollow, textures, lights=LAMPS)
    assert np.array_equal(shown(plain), shown(dim))
    lost = shown(plain, ambient="constant") - shown(dim, ambient="constant")
    ambient = 0.05 * np.array(FACTORS["base_color"]) * strength * (1 - 51 / 255)
    np.testing.assert_allclose(lost, np.broadcast_to(ambient, lost.shape), atol=1e-6)


def test_emission_is_added() -> None:
    """The factor times the map, whatever the light; what is unlit shows its base colour only."""
    rgb = np.array([200, 100, 50]) / 255.0
    shining = {**FACTORS, "emissive": [2, 1, 0.5]}
    maps = {"maps": {"emissive": {"texture": "t"}}}
    textures = {"t": texture([200, 100, 50])}
    for model in library().choices("models"):
        dark = shown(card(FACTORS, lights=LAMPS), model=model)
        lit = shown(card({**shining, **maps}, textures, lights=LAMPS), model=model)
        np.testing.assert_allclose(
            lit - dark, np.broadcast_to([2, 1, 0.5] * rgb, dark.shape), atol=2e-5
        )
    alone = shown(card(shining, lights=LAMPS)) - shown(card(FACTORS, lights=LAMPS))
    np.testing.assert_allclose(alone, np.broadcast_to([2, 1, 0.5], alone.shape), atol=2e-5)


def test_unlit_is_the_base_colour() -> None:
    material = {
        **mapped("base_color"),
        "base_color": [0.9, 0.8, 0.7],
        "unlit": True,
        "emissive": [9, 9, 9],
    }
    want = np.array(BASE) / 255.0 * [0.9, 0.8, 0.7]
    for lights in ({}, LAMPS):
        scene = card(material, {"t": texture(BASE)}, lights=lights)
        for settings in ({}, {"ambient": "constant"}, {"shadow": "hard"}, {"model": "toon"}):
            got = shown(scene, **settings)
            np.testing.assert_allclose(got, np.broadcast_to(want, got.shape), rtol=1e-6)


def test_coordinates_that_a_mesh_lacks() -> None:
    """A map by the second coordinates, on a shape that has only the first."""
    scene: dict[str, Any] = lb.load("texture-compare").data()
    material = next(m for m in scene["materials"].values() if m["maps"])
    for used in material["maps"].values():
        used["uv"] = 1
    with pytest.raises(GraphicsError, match="has no uvs1 for a_uv1"):
        lb.render(Scene.parse(scene), (32, 24))
