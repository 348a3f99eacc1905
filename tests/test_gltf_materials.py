"""Materials, textures and images of glTF files, as a scene has them."""

import base64
import io
import math
import zlib
from typing import Any

import numpy as np
import pytest
from PIL import Image

import lightbench as lb
from lightbench import assets
from lightbench.errors import ModelError
from lightbench.scene import Scene
from lightbench.texels import as_png, open_image
from tests.gltf_files import UPRIGHT, Model, png, read, square
from tests.support import assert_sound

Data = dict[str, Any]


def with_material(material: Data) -> Model:
    model = square(material=0)
    model.add("materials", material)
    return model


def material_of(model: Model) -> Data:
    data = read(model)
    Scene.parse(data)
    (material,) = data["materials"].values()
    return dict(material)


def texels_of(data: Data, name: str) -> np.ndarray[Any, Any]:
    """The texels (H, W, k) of a texture's image."""
    return np.asarray(Image.open(io.BytesIO(assets.image(data["textures"][name]["image"]))))


def test_the_default_material_is_the_specifications() -> None:
    """Section 3.9.2: white, metallic and rough."""
    expected = {
        "base_color": [1, 1, 1], "metalness": 1, "roughness": 1, "emissive": [0, 0, 0],
        "opacity": 1, "alpha_mode": "opaque", "alpha_cutoff": 0.5, "double_sided": False,
        "unlit": False, "maps": {},
    }  # fmt: skip
    assert material_of(square()) == expected
    assert material_of(with_material({})) == expected


def test_factors() -> None:
    metallic = {
        "baseColorFactor": [0.1, 0.2, 0.3, 0.4],
        "metallicFactor": 0.5,
        "roughnessFactor": 0.25,
    }
    made = material_of(
        with_material(
            {"pbrMetallicRoughness": metallic, "emissiveFactor": [0.5, 0, 1], "alphaMode": "MASK",
             "alphaCutoff": 0.75, "doubleSided": True,
             "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4},
                            "KHR_materials_ior": {"ior": 1.33}, "KHR_materials_unlit": {}}}
        )
    )  # fmt: skip
    assert made == {
        "base_color": [0.1, 0.2, 0.3], "metalness": 0.5, "roughness": 0.25, "opacity": 0.4,
        "emissive": [2, 0, 4], "alpha_mode": "mask", "alpha_cutoff": 0.75, "double_sided": True,
        "unlit": True, "ior": 1.33, "maps": {},
    }  # fmt: skip


def test_blend() -> None:
    assert material_of(with_material({"alphaMode": "BLEND"}))["alpha_mode"] == "blend"


def with_ior(ior: float) -> Model:
    return with_material({"extensions": {"KHR_materials_ior": {"ior": ior}}})


def test_an_ior_of_zero_reflects_everything() -> None:
    made = material_of(with_ior(0))
    assert made["f0"] == [1, 1, 1]
    assert "ior" not in made


def test_what_a_scene_cannot_have_is_moved_with_a_note() -> None:
    data = read(with_ior(9))
    assert next(iter(data["materials"].values()))["ior"] == 5
    assert "KHR_materials_ior.ior: 9 was taken as 5" in data["about"]
    with pytest.raises(ModelError, match=r"KHR_materials_ior\.ior: 0\.5 is not allowed; allowed"):
        read(with_ior(0.5))


def textured(**transform: object) -> Model:
    """A material with a texture of its own in each place."""
    model = square(material=0)
    extensions = {"KHR_texture_transform": transform} if transform else {}
    info = [
        {"index": model.texture((i, 0, 0), name=f"Map {i}"), "extensions": extensions}
        for i in range(5)
    ]
    metallic = {"baseColorTexture": info[0], "metallicRoughnessTexture": info[1]}
    model.add("materials", {
        "pbrMetallicRoughness": metallic, "normalTexture": info[2] | {"scale": 0.5},
        "occlusionTexture": info[3] | {"strength": 0.25}, "emissiveTexture": info[4],
    })  # fmt: skip
    return model


def test_maps() -> None:
    data = read(textured())
    (made,) = data["materials"].values()
    found = {slot: (m["texture"], m["channels"]) for slot, m in made["maps"].items()}
    assert found == {
        "base_color": ("map_0", "rgba"), "roughness": ("map_1", "g"), "metalness": ("map_1", "b"),
        "normal": ("map_2", "rgba"), "occlusion": ("map_3", "r"), "emissive": ("map_4", "rgba"),
    }  # fmt: skip
    assert (made["normal_scale"], made["occlusion_strength"]) == (0.5, 0.25)
    encodings = {name: texture["encoding"] for name, texture in data["textures"].items()}
    assert encodings == {
        "map_0": "srgb", "map_1": "linear", "map_2": "linear", "map_3": "linear", "map_4": "srgb",
    }  # fmt: skip
    for i in range(5):
        np.testing.assert_array_equal(texels_of(data, f"map_{i}"), np.full((2, 2, 3), (i, 0, 0)))
    Scene.parse(data)


def test_texture_transform() -> None:
    model = textured(offset=[0.25, -2], rotation=math.pi / 2, scale=[2, 0.5], texCoord=1)
    attributes = model.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"]
    data = read(model)
    (made,) = data["materials"].values()
    for used in made["maps"].values():
        assert (used["uv"], used["offset"], used["scale"]) == (1, [0.25, -2], [2, 0.5])
        assert used["rotation"] == pytest.approx(90)
    (asset,) = data["meshes"].values()
    assert asset["uv1"]
    Scene.parse(data)


def test_a_second_texture_set_comes_only_where_it_is_read() -> None:
    model = textured()
    attributes = model.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"]
    (asset,) = read(model)["meshes"].values()
    assert not asset["uv1"]


def test_a_missing_texture_set_is_noted() -> None:
    data = read(textured(texCoord=1))
    assert "has no TEXCOORD_1 for a texture" in data["about"]
    (asset,) = data["meshes"].values()
    np.testing.assert_array_equal(assets.mesh(asset["mesh"]).uvs1, np.zeros((4, 2)))


@pytest.mark.parametrize(
    ("sampler", "wrap", "filtering"),
    [
        ({}, ["repeat", "repeat"], "linear"),
        ({"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}, ["clamp", "mirror"], "nearest"),
        ({"wrapS": 10497, "magFilter": 9729, "minFilter": 9984}, ["repeat", "repeat"], "linear"),
    ],
)
def test_samplers(sampler: Data, wrap: list[str], filtering: str) -> None:
    model = square(material=0)
    info = {"index": model.texture(sampler=model.add("samplers", sampler))}
    model.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": info}})
    (texture,) = read(model)["textures"].values()
    assert (texture["wrap"], texture["filter"]) == (wrap, filtering)


def test_equal_images_and_equal_uses_are_one() -> None:
    model = square(material=0)
    first, second = (model.texture((9, 9, 9)) for _ in range(2))
    other = model.texture((9, 9, 9), sampler=model.add("samplers", {"wrapS": 33071}))
    metallic = {"baseColorTexture": {"index": first}, "metallicRoughnessTexture": {"index": other}}
    model.add("materials", {
        "pbrMetallicRoughness": metallic, "emissiveTexture": {"index": second},
        "normalTexture": {"index": first},
    })  # fmt: skip
    data = read(model)
    assert len({texture["image"] for texture in data["textures"].values()}) == 1
    assert sorted(texture["encoding"] for texture in data["textures"].values()) == [
        "linear", "linear", "srgb",
    ]  # fmt: skip


def test_only_textures_in_use_are_decoded() -> None:
    model = square()
    model.textured(b"no image at all")
    assert read(model)["textures"] == {}


def test_a_texture_without_an_image_is_noted() -> None:
    model = with_material({"normalTexture": {"index": 0}})
    model.add("textures", {"extensions": {"KHR_texture_basisu": {"source": 0}}})
    data = read(model)
    assert "materials[0].normalTexture: the texture has no image" in data["about"]
    assert next(iter(data["materials"].values()))["maps"] == {}


def encoded(image: Image.Image, kind: str, **more: Any) -> bytes:
    file = io.BytesIO()
    image.save(file, kind, **more)
    return file.getvalue()


def red_dot(mode: str) -> Image.Image:
    return Image.new("RGB", (4, 3), (255, 0, 0)).convert(mode)


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (encoded(red_dot("RGB"), "PNG"), (255, 0, 0)),
        (encoded(red_dot("P"), "PNG"), (255, 0, 0)),
        (encoded(Image.new("L", (4, 3), 77), "PNG"), (77, 77, 77)),
        (encoded(Image.new("LA", (4, 3), (77, 128)), "PNG"), (77, 77, 77, 128)),
        (encoded(Image.new("I;16", (4, 3), 257 * 99), "PNG"), (99, 99, 99)),
        (encoded(Image.new("1", (4, 3), 1), "PNG"), (255, 255, 255)),
        (encoded(red_dot("RGB"), "PNG", transparency=(255, 0, 0)), (255, 0, 0, 0)),
        (encoded(Image.new("L", (4, 3), 128), "JPEG", quality=100), (128, 128, 128)),
        (encoded(Image.new("CMYK", (4, 3), (0, 0, 0, 0)), "JPEG"), (255, 255, 255)),
        (encoded(red_dot("RGB"), "WEBP", lossless=True), (255, 0, 0)),
        (encoded(red_dot("RGB"), "PNG", icc_profile=b"odd"), (255, 0, 0)),
    ],
)
def test_images_become_plain_pngs(content: bytes, expected: tuple[int, ...]) -> None:
    """8 bit RGB or RGBA, with no profile, gamma or other chunk that decoders differ in."""
    made = as_png(open_image(content))
    texels = np.asarray(Image.open(io.BytesIO(made)))
    np.testing.assert_array_equal(texels, np.full((3, 4, len(expected)), expected))
    assert made[12:16] == b"IHDR"
    assert made[24:26] == bytes([8, 2 if len(expected) == 3 else 6])
    for chunk in (b"iCCP", b"gAMA", b"sRGB", b"tRNS", b"eXIf", b"cHRM"):
        assert chunk not in made


@pytest.mark.parametrize("kind", ["data", "webp"])
def test_images_from_other_places(kind: str) -> None:
    model = with_material({"emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1]})
    if kind == "data":
        uri = "data:image/png;base64," + base64.b64encode(png((1, 2, 3))).decode()
        model.add("images", {"uri": uri, "name": "Glow.png"})
        model.add("textures", {"source": 0})
    else:
        file = encoded(Image.new("RGB", (2, 2), (1, 2, 3)), "WEBP", lossless=True)
        model.json["extensionsRequired"] = ["EXT_texture_webp"]
        model.add("images", {"bufferView": model.view(file), "name": "Glow"})
        model.add("textures", {"extensions": {"EXT_texture_webp": {"source": 0}}})
    data = read(model)
    np.testing.assert_array_equal(texels_of(data, "glow"), np.full((2, 2, 3), (1, 2, 3)))


@pytest.mark.parametrize(
    "content",
    [b"", b"GIF89a", png((1, 2, 3))[:40], png((1, 2, 3), (64, 64))[:-30], b"\x89PNG\r\n\x1a\n" * 9,
     encoded(red_dot("RGB"), "GIF"), encoded(red_dot("RGB"), "JPEG")[:200]],
)  # fmt: skip
def test_broken_images_are_refused(content: bytes) -> None:
    model = with_material({"emissiveTexture": {"index": 0}})
    model.textured(content or b"0")
    with pytest.raises(ModelError, match=r"images\[0\]: ") as refused:
        read(model)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("size", "limits", "words"),
    [
        ((65, 2), {"image_side": 64}, r"images\[0\]: 65 x 2 texels; allowed are 64 a side"),
        ((32, 32), {"image_pixels": 1000}, r"images\[0\]: 1024 image pixels; allowed are 1000"),
        ((16000, 16000), {}, r"images\[0\]: "),
        ((9000, 1), {}, "9000 x 1 texels; allowed are 8192"),
    ],
)
def test_large_images_are_refused(size: tuple[int, int], limits: Any, words: str) -> None:
    """From their headers: the texels of a bomb are never made."""
    header = png((0, 0, 0), (1, 1))
    whole = header[:16] + size[0].to_bytes(4, "big") + size[1].to_bytes(4, "big") + header[24:]
    crc = zlib.crc32(whole[12:29]).to_bytes(4, "big")
    model = with_material({"emissiveTexture": {"index": 0}})
    model.textured(whole[:29] + crc + whole[33:])
    with pytest.raises(ModelError, match=words):
        read(model, **limits)


def test_textures_are_limited() -> None:
    with pytest.raises(ModelError, match=r"textures\[4\]: 5 textures; allowed are 4"):
        read(textured(), textures=4)
    assert len(read(textured(), textures=5)["textures"]) == 5


def test_an_image_stands_upright_in_a_picture() -> None:
    """Red above, green below; glTF's v grows down the image."""
    file = io.BytesIO()
    halves = np.zeros((8, 8, 3), np.uint8)
    halves[:4, :, 0] = halves[4:, :, 1] = 255
    Image.fromarray(halves).save(file, "PNG")
    color = {"baseColorFactor": [1, 1, 1, 1], "baseColorTexture": {"index": 0}}
    unlit: Data = {"KHR_materials_unlit": {}}
    model = with_material({"pbrMetallicRoughness": color, "extensions": unlit})
    model.textured(file.getvalue())
    camera = {"eye": [0.5, 0.5, 2], "target": [0.5, 0.5, 0], "fov": 20}
    image = lb.render(Scene.parse(read(model) | {"camera": camera}), (16, 16))
    assert_sound(image)
    np.testing.assert_allclose(image.linear[4, 8], (1, 0, 0), atol=1e-3)
    np.testing.assert_allclose(image.linear[12, 8], (0, 1, 0), atol=1e-3)
    assert UPRIGHT[0] == (0, 1)
