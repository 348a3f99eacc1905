"""Broken glTF files: one line with the file, the place and the reason; no crash, no wait."""

import json
import math
import os
import struct
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lightbench.answers import STATUS
from lightbench.errors import LightbenchError, ModelError
from lightbench.gltf import Limits, read_gltf
from tests.gltf_files import Model, read, square

Data = dict[str, Any]


# How a document begins.
HEAD = b'{"asset":{"version":"2.0"},'


def refusal(source: Model | bytes | Path, **limits: int) -> str:
    """Why a file is refused, without its name; it takes no second of work to say so."""
    began = time.process_time()
    with pytest.raises(ModelError) as refused:
        read(source, **limits)
    assert time.process_time() - began < 1
    message = str(refused.value)
    assert message.startswith("test.glb: ")
    assert "\n" not in message
    assert len(message) < 500
    return message.removeprefix("test.glb: ")


def put(data: Any, path: str, value: object) -> None:
    """Set `a.0.b` in nested lists and objects."""
    *parents, last = path.split(".")
    for key in parents:
        data = data[int(key)] if isinstance(data, list) else data.setdefault(key, {})
    if isinstance(data, list):
        data[int(last)] = value
    else:
        data[last] = value


def whole() -> Model:
    """A model that has everything a reference can point to."""
    model = square(material=0)
    model.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = model.accessor(
        [(1, 0, 0, 1)] * 4
    )
    info = {"index": model.texture((1, 2, 3), sampler=0)}
    model.add("samplers", {})
    model.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": info}})
    model.add("cameras", {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}})
    model.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
    model.root(camera=0, extensions={"KHR_lights_punctual": {"light": 0}}, translation=[0, 0, 3])
    return model


def test_the_whole_is_read() -> None:
    assert read(whole())["lights"]


def test_a_refusal_is_422() -> None:
    nearest = next(kind for kind in ModelError.__mro__ if kind in STATUS)
    assert issubclass(ModelError, LightbenchError)
    assert STATUS[nearest] == 422


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [
        ("asset", None, "asset: "),
        ("asset.version", "1.0", "asset.version: glTF '1.0'; allowed is '2.0'"),
        ("asset.version", 2.0, "asset.version: "),
        ("asset.version", "2." + "0\n" * 99, "asset.version: "),
        ("asset.minVersion", "2.1", "asset.minVersion: glTF '2.1'"),
        ("extensionsRequired", ["KHR_texture_transform", "ACME_x"], "[1]: no support for 'ACME_x'"),
        ("scene", 1, "scene: there is no scenes[1]; there are 1"),
        ("scene", -1, "scene: "),
        ("scene", 0.5, "scene: "),
        ("scene", True, "scene: "),
        ("scenes.0.nodes.0", 9, "scenes[0].nodes[0]: there is no nodes[9]; there are 2"),
        ("scenes.0.nodes.1", 0, "scenes[0].nodes[1]: node 0 is listed twice"),
        ("scenes.0.nodes", [], "scene: has no triangle to show"),
        ("nodes", {}, "nodes: "),
        ("nodes.0", 3, "nodes[0]: "),
        ("nodes.0.children", [0], "nodes[0]: is its own ancestor"),
        ("nodes.0.children", [1, 1], "nodes[0].children[1]: node 1 is already a child of nodes[0]"),
        ("nodes.0.children", [1], "scenes[0].nodes[1]: node 1 has a parent; a scene lists roots"),
        ("nodes.0.children", [7], "nodes[0].children[0]: there is no nodes[7]"),
        ("nodes.0.mesh", 5, "nodes[0].mesh: there is no meshes[5]; there are 1"),
        ("nodes.0.mesh", "0", "nodes[0].mesh: "),
        ("nodes.0.skin", 0, "nodes[0].skin: there is no skins[0]; there are 0"),
        ("nodes.0.matrix", [1] * 15, "nodes[0].matrix: "),
        ("nodes.0.matrix", [0] * 16, "nodes[0].matrix: its last row is not 0, 0, 0, 1"),
        ("nodes.0.scale", [1, 1], "nodes[0].scale"),
        ("nodes.0.translation", [1e300, 0, 0], "nodes[0].translation[0]: "),
        ("nodes.0.translation", [3e38, 0, 0], "meshes[0].primitives[0]: a vertex lies beyond"),
        ("nodes.0.scale", [3e5, 1, 1], "scene: reaches 3.62e+05 m; allowed are 200000 m"),
        ("nodes.0.rotation", [0, 0, 0, 0], "nodes[0].rotation: a quaternion of length 0"),
        ("nodes.1.camera", 1, "nodes[1].camera: there is no cameras[1]"),
        ("nodes.1.extensions.KHR_lights_punctual.light", 1, "there is no lights[1]; there are 1"),
        ("nodes.1.translation", [2e6, 0, 0], "nodes[1]: lies beyond 1e+06 m"),
        ("cameras.0.perspective.yfov", 0, "cameras[0].perspective.yfov: "),
        ("cameras.0.type", "fisheye", "cameras[0].type: "),
        ("extensions.KHR_lights_punctual.lights.0.type", "area", "lights[0].type: "),
        ("extensions.KHR_lights_punctual.lights.0.intensity", -1, "lights[0].intensity: "),
        ("extensions.KHR_lights_punctual.lights.0.spot", {"outerConeAngle": 2}, "outerConeAngle: "),
        ("meshes.0.primitives", [], "meshes[0].primitives: "),
        ("meshes.0.primitives.0.mode", 7, "meshes[0].primitives[0].mode: "),
        ("meshes.0.primitives.0.material", 1, "material: there is no materials[1]"),
        ("meshes.0.primitives.0.indices", 99, "indices: there is no accessors[99]"),
        ("meshes.0.primitives.0.indices", 0, "accessors[0]: VEC3 of componentType 5126 for"),
        ("meshes.0.primitives.0.attributes", {}, "attributes: POSITION is missing"),
        ("meshes.0.primitives.0.attributes.POSITION", 3, "accessors[3].type: SCALAR for"),
        ("meshes.0.primitives.0.attributes.POSITION", None, "attributes.POSITION: "),
        ("meshes.0.primitives.0.attributes.NORMAL", 2, "accessors[2].type: VEC2 for"),
        ("materials.0.alphaMode", "GLASS", "materials[0].alphaMode: "),
        ("materials.0.pbrMetallicRoughness.metallicFactor", 1.5, "metallicFactor: "),
        ("materials.0.pbrMetallicRoughness.baseColorTexture.index", 4, "there is no textures[4]"),
        ("materials.0.pbrMetallicRoughness.baseColorTexture.texCoord", 2, "texCoord: "),
        ("textures.0.source", 1, "textures[0].source: there is no images[1]"),
        ("textures.0.sampler", 1, "textures[0].sampler: there is no samplers[1]"),
        ("samplers.0.wrapS", 1, "samplers[0].wrapS: "),
        ("images.0.bufferView", 99, "images[0].bufferView: there is no bufferViews[99]"),
        ("images.0", {}, "images[0]: has neither uri nor bufferView"),
        ("images.0.uri", "http://x/y.png", "is no path beside the model, nor a data URI"),
        ("images.0.uri", "y.png", "images[0].uri: the file 'y.png' is missing: what is sent alone"),
        ("images.0.uri", "data:image/png;base64,@@@@", "the data URI is not base64"),
        ("images.0.uri", "data:image/png", "a data URI without a comma"),
        ("accessors.0.bufferView", 99, "accessors[0].bufferView: there is no bufferViews[99]"),
        ("accessors.0.byteOffset", 4, "accessors[0]: ends at byte 52 of bufferViews[0], which has"),
        ("accessors.0.byteOffset", -4, "accessors[0].byteOffset: "),
        ("accessors.0.byteOffset", 2**70, "accessors[0].byteOffset: "),
        ("accessors.0.count", 0, "accessors[0].count: "),
        ("accessors.0.count", 5, "accessors[0]: ends at byte 60"),
        ("accessors.0.count", 2**31 - 1, "accessors[0]: ends at byte"),
        ("accessors.0.count", 10**30, "accessors[0].count: "),
        ("accessors.0.componentType", 5124, "accessors[0].componentType: "),
        ("accessors.0.type", "VEC5", "accessors[0].type: "),
        ("accessors.1.count", 3, "attributes.NORMAL: 3 elements for 4 positions"),
        ("accessors.0.sparse", {"count": 5, "indices": {"bufferView": 0, "componentType": 5121},
                                "values": {"bufferView": 0}}, "sparse.count: 5 of 4 elements"),
        ("accessors.0.sparse", {"count": 4, "indices": {"bufferView": 0, "byteOffset": 12,
                                "componentType": 5123}, "values": {"bufferView": 0}},
         "accessors[0].sparse.indices: element 16256 of an accessor of 4"),
        ("accessors.0.sparse", {"count": 4, "indices": {"bufferView": 9, "componentType": 5123},
                                "values": {"bufferView": 0}}, "sparse.indices.bufferView: there"),
        ("accessors.0.sparse", {"count": 4, "indices": {"bufferView": 0, "byteOffset": 47,
                                "componentType": 5121}, "values": {"bufferView": 0}},
         "accessors[0].sparse.indices: ends at byte 51"),
        ("bufferViews.0.buffer", 1, "bufferViews[0].buffer: there is no buffers[1]"),
        ("bufferViews.0.byteOffset", 10**6, "bufferViews[0]: bytes 1000000 to"),
        ("bufferViews.0.byteLength", 4, "accessors[0]: ends at byte 48"),
        ("bufferViews.0.byteStride", 8, "accessors[0]: elements of 12 bytes every 8 bytes"),
        ("bufferViews.0.byteStride", 16, "accessors[0]: ends at byte 60"),
        ("bufferViews.0.byteStride", 0, "bufferViews[0].byteStride: "),
    ],
)  # fmt: skip
def test_a_wrong_value_is_refused_by_its_path(path: str, value: object, words: str) -> None:
    model = whole()
    put(model.json, path, value)
    assert words in refusal(model)


@pytest.mark.parametrize("value", ["NaN", "Infinity", "-Infinity", "1e999"])
@pytest.mark.parametrize("path", ["nodes.0.translation", "nodes.0.matrix"])
def test_numbers_that_are_not_finite_are_refused(path: str, value: str) -> None:
    model = square()
    put(model.json, path, ["@"] * (3 if path.endswith("translation") else 16))
    text = model.gltf().replace(b'"@"', value.encode())
    assert refusal(text).startswith(f"nodes[0].{path[8:]}[0]: ")


def test_a_matrix_beside_its_parts_is_refused() -> None:
    model = square()
    model.json["nodes"][0] |= {"matrix": np.eye(4).ravel().tolist(), "scale": [1, 1, 1]}
    assert "nodes[0].matrix: stands beside translation" in refusal(model)


def test_places_that_overflow_are_refused() -> None:
    model = square()
    model.json["nodes"] = [{"children": [i + 1], "scale": [1e30] * 3} for i in range(20)]
    model.json["nodes"].append({"mesh": 0})
    assert "its place in the world is not finite" in refusal(model)


def test_longer_cycles_are_refused_even_outside_the_scene() -> None:
    model = square()
    model.json["nodes"] += [{"children": [2]}, {"children": [3]}, {"children": [1]}]
    assert refusal(model) == "nodes[1]: is its own ancestor"
    model.json["nodes"][0] |= {"children": [4]}
    model.json["nodes"].append({"children": [5]})
    model.json["nodes"].append({})
    assert refusal(model) == "nodes[1]: is its own ancestor"


@pytest.mark.parametrize("name", ["POSITION", "NORMAL", "TEXCOORD_0", "TANGENT"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_vertices_that_are_not_finite_are_refused(name: str, value: float) -> None:
    model = whole()
    index = model.json["meshes"][0]["primitives"][0]["attributes"][name]
    view = model.json["bufferViews"][model.json["accessors"][index]["bufferView"]]
    struct.pack_into("<f", model.binary, view["byteOffset"], value)
    assert f"accessors[{index}]: element 0 of " in refusal(model)


@pytest.mark.parametrize("index", [4, 254, 255])
def test_vertices_out_of_range_are_refused(index: int) -> None:
    model = Model()
    primitive = model.square() | {"indices": model.accessor([0, 1, index], "u1")}
    model.root(mesh=model.mesh([primitive]))
    expected = f"indices: vertex {index} is out of range; there are 4"
    assert refusal(model) == f"meshes[0].primitives[0].{expected}"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "file: is empty"),
        (b"  \n", "file: is empty"),
        (b"hello", "JSON: "),
        (b"{", "JSON: "),
        (b"[]", "JSON: "),
        (b"null", "JSON: "),
        (b"{}", "asset: is missing"),
        (b"\xff\xfe{}", "JSON: "),
        (b"[" * 100_000, "JSON: "),
        (b'{"a":' * 100_000, "JSON: "),
        (HEAD + b'"extras":' + b"[" * 10**5 + b"]" * 10**5 + b"}", "JSON: "),
        (b"{" * 600_000, "JSON: 600000 objects; allowed are 500000"),
        (b"," * 5_000_000, "JSON: 5000000 values"),
        (HEAD + b'"nodes":[' + b"{}," * 20_000 + b"{}]}", "nodes: there are 20001; allowed are"),
        (HEAD + b'"nodes":[' + b"0," * 10**6 + b"0]}", "nodes"),
        (b'{"asset":{"version":"2.0"}}', "scene: has no triangle to show"),
        (b"glTF", "header: the file ends after 4 bytes"),
        (b"glTF" + bytes(30), "header: version 0 of binary glTF; allowed is 2"),
        (struct.pack("<4sII", b"glTF", 1, 20) + bytes(8), "header: version 1"),
        (struct.pack("<4sII", b"glTF", 2, 99) + bytes(8), "has 20 bytes of the 99"),
        (struct.pack("<4sII", b"glTF", 2, 20) + bytes(8), "chunks[0]: is not JSON"),
        (struct.pack("<4sIIII", b"glTF", 2, 20, 9, 0x4E4F534A), "chunks[0]: declares 9 bytes"),
        (struct.pack("<4sIIII", b"glTF", 2, 20, 2**32 - 1, 0x4E4F534A), "declares 4294967295"),
        (b"Glt" + square().glb(), "JSON: "),
    ],
)  # fmt: skip
def test_what_is_no_gltf_is_refused(content: bytes, words: str) -> None:
    assert words in refusal(content)


@pytest.mark.parametrize("part", [0.1, 0.5, 0.9, 0.999])
def test_a_file_cut_short_is_refused(part: float) -> None:
    content = whole().glb()
    assert "of the" in refusal(content[: int(len(content) * part)])


def test_a_missing_binary_chunk_is_refused() -> None:
    model = square()
    model.json["buffers"] = []
    text = json.dumps(json.loads(model.gltf())).encode()
    document = json.loads(text)
    del document["buffers"][0]["uri"]
    assert "buffers[0].uri: is missing" in refusal(json.dumps(document).encode())


def test_a_short_buffer_is_refused() -> None:
    document = json.loads(square().gltf())
    document["buffers"][0]["byteLength"] += 1
    assert "buffers[0].byteLength: declares" in refusal(json.dumps(document).encode())


@pytest.mark.parametrize(
    ("uri", "words"),
    [
        ("../out.bin", "leads out of the model's folder"),
        ("%2e%2e/out.bin", "leads out of the model's folder"),
        ("sub/../../out.bin", "leads out of the model's folder"),
        ("link.bin", "leads out of the model's folder"),
        ("/etc/hostname", "is no path beside the model"),
        ("file:///etc/hostname", "is no path beside the model"),
        ("http://localhost/x.bin", "is no path beside the model"),
        ("..\\out.bin", "is no path beside the model"),
        ("a%00b", "is no path beside the model"),
        ("loop.bin", "is no path"),
        ("x" * 5000, ""),
        ("none.bin", "there is no file 'none.bin' beside the model"),
        ("sub", "there is no file 'sub' beside the model"),
        ("pipe", "there is no file 'pipe' beside the model"),
        ("", "there is no file '' beside the model"),
    ],
)
def test_only_neighbours_are_read(tmp_path: Path, uri: str, words: str) -> None:
    model, folder = square(), tmp_path / "folder"
    (folder / "sub").mkdir(parents=True)
    (tmp_path / "out.bin").write_bytes(model.binary)
    (folder / "link.bin").symlink_to(tmp_path / "out.bin")
    (folder / "loop.bin").symlink_to(folder / "loop.bin")
    os.mkfifo(folder / "pipe")
    document = json.loads(model.gltf())
    document["buffers"][0]["uri"] = uri
    (folder / "model.gltf").write_bytes(json.dumps(document).encode())
    assert words in refusal(folder / "model.gltf")


def test_neighbours_in_sub_folders_are_read(tmp_path: Path) -> None:
    model = square()
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "b.bin").write_bytes(model.binary)
    (tmp_path / "model.gltf").write_bytes(model.gltf("./sub/../sub/b.bin"))
    assert read(tmp_path / "model.gltf")["objects"]


def test_a_path_without_a_file_is_refused(tmp_path: Path) -> None:
    assert refusal(tmp_path / "none.glb") == "file: there is none"
    assert refusal(tmp_path) == "file: there is none"


def grid(side: int) -> Model:
    """A square of side x side quads."""
    model = Model()
    across = np.stack(np.meshgrid(np.arange(side + 1), np.arange(side + 1)), -1).reshape(-1, 2)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    quads = corner[:, None] + [0, 1, side + 2, 0, side + 2, side + 1]
    attributes = {"POSITION": model.accessor(np.column_stack([across, 0 * across[:, 0]]))}
    model.root(
        mesh=model.mesh(
            [{"attributes": attributes, "indices": model.accessor(quads.ravel(), "u4")}]
        )
    )
    return model


@pytest.mark.parametrize(
    ("make", "limits", "words"),
    [
        (square, {"file_bytes": 100}, "file bytes; allowed are 100"),
        (lambda: grid(4), {"triangles": 31}, "32 triangles; allowed are 31"),
        (lambda: grid(4), {"vertices": 24}, "25 vertices; allowed are 24"),
        (lambda: grid(4), {"vertices": 95}, "96 vertices; allowed are 95"),
        (whole, {"nodes": 1}, "nodes: there are 2; allowed are 1"),
        (whole, {"materials": 1, "lights": 1, "textures": 1, "nodes": 2}, ""),
    ],
)
def test_limits(make: Callable[[], Model], limits: dict[str, int], words: str) -> None:
    if words:
        assert words in refusal(make(), **limits)
    else:
        assert read(make(), **limits)["objects"]


def test_objects_materials_and_lights_are_limited() -> None:
    model = whole()
    model.json["materials"] *= 3
    model.json["nodes"][0] |= {"extensions": {"KHR_lights_punctual": {"light": 0}}}
    model.json["meshes"][0]["primitives"] *= 3
    assert "materials: there are 3; allowed are 2" in refusal(model, materials=2)
    assert "nodes[1]: 2 lights; allowed are 1" in refusal(model, lights=1)
    assert "nodes[0]: 3 nodes; allowed are 2" in refusal(model, nodes=2)


def test_external_files_count_too(tmp_path: Path) -> None:
    model = grid(20)
    (tmp_path / "b.bin").write_bytes(model.binary)
    (tmp_path / "model.gltf").write_bytes(model.gltf("b.bin"))
    assert "buffers[0].uri: " in refusal(tmp_path / "model.gltf", file_bytes=len(model.binary))


def test_huge_counts_in_a_small_file_are_refused() -> None:
    """Arrays of zeros take no room in the file, however many and long."""
    zeros = {"componentType": 5126, "count": 2**31 - 1, "type": "VEC3"}
    model = Model()
    model.root(mesh=model.mesh([{"attributes": {"POSITION": model.add("accessors", zeros)}}]))
    assert "bytes of vertex data; allowed are" in refusal(model)
    model = Model()
    many = [model.add("accessors", zeros | {"count": 500_000}) for _ in range(60)]
    model.root(mesh=model.mesh([{"attributes": {"POSITION": index}} for index in many]))
    assert "bytes of vertex data; allowed are" in refusal(model)


def test_a_flood_of_errors_ends_early() -> None:
    nodes = b",".join([b'{"mesh":"x"}'] * 60_000)
    assert "nodes[0].mesh: " in refusal(b'{"asset":{"version":"2.0"},"nodes":[' + nodes + b"]}")


def test_names_in_messages_are_printable() -> None:
    model = square()
    model.json["meshes"][0]["primitives"][0]["attributes"]["\n\x1b[31m" + "x" * 999] = -1
    message = refusal(model)
    assert "\x1b" not in message
    with pytest.raises(ModelError) as refused:
        read_gltf(b"", name="evil\nname.glb" + "x" * 999, limits=Limits(), keep=False)
    assert str(refused.value).startswith("evil name.glb")
    assert len(str(refused.value)) < 300


def test_limits_are_validated() -> None:
    with pytest.raises(ValueError, match="vertices"):
        Limits(vertices=0)
    with pytest.raises(ValueError, match="verts"):
        Limits.model_validate({"verts": 1})
