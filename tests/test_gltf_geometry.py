"""The arrays of glTF primitives: every layout of the same geometry gives the same mesh."""

import io
import json
import math
from pathlib import Path
from typing import Any

import DracoPy
import meshopt
import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from lightbench import assets
from lightbench.errors import ModelError
from lightbench.gltf import draco, draco_worker, mikktspace
from lightbench.mesh import Mesh, pack
from tests.gltf_files import CORNERS, FACING, SQUARE, UPRIGHT, Model, read, square

Data = dict[str, Any]


def one_mesh(model: Model, **limits: int) -> Mesh:
    (asset,) = read(model, **limits)["meshes"].values()
    return assets.mesh(asset["mesh"])


def with_primitive(primitive: Data, model: Model) -> Model:
    model.root(mesh=model.mesh([primitive], "s"))
    return model


def with_attribute(name: str, values: ArrayLike, kind: str = "f4", **more: object) -> Model:
    model = Model()
    primitive = model.square()
    primitive["attributes"][name] = model.accessor(values, kind, **more)
    return with_primitive(primitive, model)


EXPECTED = pack(one_mesh(square()))


def corners(mesh: Mesh) -> list[list[tuple[float, ...]]]:
    """The triangles as positions, each from its least corner on."""
    found = []
    for triangle in mesh.positions[mesh.indices].tolist():
        points = [tuple(point) for point in triangle]
        least = points.index(min(points))
        found.append(points[least:] + points[:least])
    return sorted(found)


@pytest.mark.parametrize("kind", ["u1", "u2", "u4"])
def test_indices_of_each_type(kind: str) -> None:
    model = Model()
    primitive = model.square() | {"indices": model.accessor(SQUARE, kind)}
    assert pack(one_mesh(with_primitive(primitive, model))) == EXPECTED


@pytest.mark.parametrize(
    ("mode", "indices"), [(4, [*SQUARE, 1]), (5, [1, 2, 0, 3]), (5, [1, 2, 0, 3, 3]), (6, range(4))]
)
def test_lists_strips_and_fans(mode: int, indices: list[int]) -> None:
    """All face +z; a triangle that is cut off or has two equal corners is nothing."""
    model = Model()
    primitive = model.square(mode=mode) | {"indices": model.accessor(list(indices), "u2")}
    made = one_mesh(with_primitive(primitive, model))
    assert corners(made) == corners(one_mesh(square()))


def test_without_indices() -> None:
    model = square(mode=6)
    del model.json["meshes"][0]["primitives"][0]["indices"]
    assert corners(one_mesh(model)) == corners(one_mesh(square()))


def test_unused_vertices_are_left_out() -> None:
    model = Model()
    primitive = model.square() | {"indices": model.accessor([0, 2, 3], "u2")}
    made = one_mesh(with_primitive(primitive, model))
    np.testing.assert_array_equal(made.positions, np.array(CORNERS)[[0, 2, 3]])
    np.testing.assert_array_equal(made.uvs, np.array(UPRIGHT)[[0, 2, 3]])


def test_interleaved_and_unaligned_attributes() -> None:
    model = Model()
    rows = np.zeros(4, [("p", "<f4", 3), ("odd", "u1", 3), ("n", "<f4", 3), ("t", "<f4", 2)])
    rows["p"], rows["n"], rows["t"] = CORNERS, FACING, UPRIGHT
    view = model.view(rows.tobytes(), byteStride=rows.itemsize)
    about = {"bufferView": view, "componentType": 5126, "count": 4}
    names = [("POSITION", 0, "VEC3"), ("NORMAL", 15, "VEC3"), ("TEXCOORD_0", 27, "VEC2")]
    attributes = {
        name: model.add("accessors", about | {"byteOffset": offset, "type": kind})
        for name, offset, kind in names
    }
    primitive = {"attributes": attributes, "indices": model.accessor(SQUARE, "u1")}
    assert pack(one_mesh(with_primitive(primitive, model))) == EXPECTED


@pytest.mark.parametrize("dense", [True, False])
def test_sparse_accessors(dense: bool) -> None:
    """Over an array, or over zeros where there is no buffer view."""
    model = Model()
    primitive = model.square()
    wrong = model.accessor(np.zeros((4, 3)) if dense else CORNERS)
    position = model.json["accessors"][wrong]
    if not dense:
        del position["bufferView"]
    position["sparse"] = {
        "count": 3,
        "indices": {"bufferView": model.view(bytes([1, 2, 3])), "componentType": 5121},
        "values": {"bufferView": model.view(np.array(CORNERS[1:], "<f4").tobytes())},
    }
    primitive["attributes"]["POSITION"] = wrong
    assert pack(one_mesh(with_primitive(primitive, model))) == EXPECTED


@pytest.mark.parametrize(("kind", "most"), [("u1", 255), ("u2", 65535)])
def test_normalised_texture_coordinates(kind: str, most: int) -> None:
    model = with_attribute("TEXCOORD_0", np.array(UPRIGHT) * most, kind, normalized=True)
    assert pack(one_mesh(model)) == EXPECTED


@pytest.mark.parametrize(("kind", "most"), [("i1", 127), ("i2", 32767)])
def test_quantised_geometry(kind: str, most: int) -> None:
    """KHR_mesh_quantization; the least integer counts as -1 too."""
    model = Model()
    model.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    primitive = model.square()
    primitive["attributes"] |= {
        "POSITION": model.accessor(CORNERS, kind),
        "NORMAL": model.accessor(np.array(FACING) * most, kind, normalized=True),
        "TANGENT": model.accessor([(most, 0, 0, -most - 1)] * 4, kind, normalized=True),
    }
    made = one_mesh(with_primitive(primitive, model))
    np.testing.assert_array_equal(made.positions, CORNERS)
    np.testing.assert_array_equal(made.normals, FACING)
    np.testing.assert_array_equal(made.tangents, [(1, 0, 0, -1)] * 4)


@pytest.mark.parametrize(
    ("values", "kind", "expected"),
    [
        ([(1, 0.5, 0)] * 4, "f4", (1, 0.5, 0, 1)),
        ([(1, 0.5, 0, 0.25)] * 4, "f4", (1, 0.5, 0, 0.25)),
        ([(255, 51, 0, 102)] * 4, "u1", (1, 0.2, 0, 0.4)),
        ([(65535, 13107, 0)] * 4, "u2", (1, 0.2, 0, 1)),
        ([(2, -1, 0)] * 4, "f4", (1, 0, 0, 1)),
    ],
)
def test_vertex_colours(values: ArrayLike, kind: str, expected: tuple[float, ...]) -> None:
    model = with_attribute("COLOR_0", values, kind, normalized=kind != "f4")
    (asset,) = read(model)["meshes"].values()
    assert asset["colors"]
    colors = assets.mesh(asset["mesh"]).colors
    assert colors is not None
    np.testing.assert_allclose(colors, np.tile(expected, (4, 1)), atol=1e-7)


def tent() -> Model:
    """Two triangles that share an edge, without normals."""
    model = Model()
    positions = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, -1)]
    attributes = {
        "POSITION": model.accessor(positions),
        "TANGENT": model.accessor([(0, 0, 1, 1)] * 4),
        "TEXCOORD_0": model.accessor([(0, 0), (1, 0), (0, -1), (0, 1)]),
        "COLOR_0": model.accessor(np.eye(4)[:, :3]),
    }
    indices = model.accessor([0, 1, 2, 0, 3, 1], "u2")
    return with_primitive({"attributes": attributes, "indices": indices}, model)


def test_missing_normals_are_flat() -> None:
    """Each triangle has its own; given tangents do not count then (section 3.7.2.1)."""
    made = one_mesh(tent())
    np.testing.assert_allclose(made.normals[made.indices[0]], [(0, 0, 1)] * 3, atol=1e-7)
    np.testing.assert_allclose(made.normals[made.indices[1]], [(0, -1, 0)] * 3, atol=1e-7)
    np.testing.assert_allclose(made.tangents, [(1, 0, 0, 1)] * 6, atol=1e-7)
    assert len(made.positions) == 6
    assert made.colors is not None
    np.testing.assert_array_equal(made.colors[made.indices[1]][:, :3], np.eye(4)[[0, 3, 1], :3])


def test_normals_are_made_unit_vectors() -> None:
    made = one_mesh(with_attribute("NORMAL", [(0, 0, 9), (0, 0, 1e-30), (0, 3, 4), (0, 0, 1)]))
    np.testing.assert_allclose(
        made.normals, [(0, 0, 1), (0, 0, 1), (0, 0.6, 0.8), (0, 0, 1)], atol=1e-7
    )


def test_a_zero_normal_becomes_that_of_its_triangle() -> None:
    made = one_mesh(with_attribute("NORMAL", [(0, 0, 0), (1, 0, 0), (1, 0, 0), (0, 0, 0)]))
    np.testing.assert_array_equal(made.normals, [(0, 0, 1), (1, 0, 0), (1, 0, 0), (0, 0, 1)])


def test_a_triangle_whose_normals_are_all_zero_is_refused() -> None:
    model = with_attribute("NORMAL", [(0, 0, 0), (1, 0, 0), (0, 0, 0), (0, 0, 0)])
    with pytest.raises(ModelError, match=r"NORMAL: the normals of triangle 1 are all zero"):
        read(model)


@pytest.mark.parametrize("given", [(2, 0, 1, 0.5), (1, 0, 0, 1), (0, 0, 1, 1), (0, 0, 0, 1)])
def test_given_tangents_are_made_square_to_the_normals(given: tuple[float, ...]) -> None:
    made = one_mesh(with_attribute("TANGENT", [given] * 4))
    np.testing.assert_allclose(made.tangents, [(1, 0, 0, 1)] * 4, atol=1e-6)


def test_without_texture_coordinates_there_is_still_a_frame() -> None:
    model = square()
    del model.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"]
    made = one_mesh(model)
    np.testing.assert_array_equal(made.uvs, np.zeros((4, 2)))
    np.testing.assert_array_equal(made.tangents, [(1, 0, 0, 1)] * 4)


def test_a_square_without_a_texture_direction_still_has_a_frame() -> None:
    made = one_mesh(with_attribute("TEXCOORD_0", [(0.5, 0.5)] * 4))
    np.testing.assert_allclose(np.linalg.norm(made.tangents[:, :3], axis=1), 1, atol=1e-6)
    np.testing.assert_allclose((made.tangents[:, :3] * made.normals).sum(axis=1), 0, atol=1e-6)


@pytest.mark.parametrize(
    ("uvs", "tangent"),
    [
        (UPRIGHT, (1, 0, 0, 1)),
        ([(u, 1 - v) for u, v in UPRIGHT], (1, 0, 0, -1)),
        ([(-u, v) for u, v in UPRIGHT], (-1, 0, 0, -1)),
        ([(v, u) for u, v in UPRIGHT], (0, -1, 0, -1)),
        ([(-v, u) for u, v in UPRIGHT], (0, 1, 0, 1)),
    ],
)
def test_tangents_of_a_turned_or_mirrored_texture(
    uvs: list[tuple[float, float]], tangent: tuple[float, ...]
) -> None:
    """u grows along the tangent; w * cross(n, t) points up the image, towards smaller v."""
    made = one_mesh(with_attribute("TEXCOORD_0", uvs))
    np.testing.assert_allclose(made.tangents, [tangent] * 4, atol=1e-6)


def reference() -> dict[str, NDArray[Any]]:
    path = Path(__file__).parent / "fixtures" / "mikktspace.json"
    data = json.loads(path.read_text())
    del data["source"]
    return {name: np.array(rows) for name, rows in data.items()}


def test_tangents_are_those_of_the_reference_implementation() -> None:
    """On a bumpy grid whose texture is mirrored in the middle and folded here and there."""
    known = reference()
    made, vertices, triangles = mikktspace.tangents(
        known["positions"], known["normals"], known["uvs"], known["triangles"]
    )
    np.testing.assert_array_equal(vertices[triangles], known["triangles"])
    np.testing.assert_allclose(made[triangles], known["tangents"], atol=5e-5)
    assert len(made) > len(known["positions"])


def test_tangents_do_not_depend_on_the_order_of_triangles() -> None:
    known = reference()
    order = np.random.default_rng(1).permutation(len(known["triangles"]))
    made, _, triangles = mikktspace.tangents(
        known["positions"], known["normals"], known["uvs"], known["triangles"][order]
    )
    np.testing.assert_allclose(made[triangles], known["tangents"][order], atol=5e-5)


def test_tangents_are_shared_across_a_colour_seam() -> None:
    """Vertices that differ in nothing that MikkTSpace sees have one tangent."""
    known = reference()
    flat = known["triangles"].ravel()
    made, _, triangles = mikktspace.tangents(
        known["positions"][flat],
        known["normals"][flat],
        known["uvs"][flat],
        np.arange(len(flat)).reshape(-1, 3),
    )
    np.testing.assert_allclose(made[triangles], known["tangents"], atol=5e-5)


def test_tangents_follow_the_normal_maps_texture_set() -> None:
    model = with_attribute("TEXCOORD_1", [(-v, u) for u, v in UPRIGHT])
    info = {"index": model.texture((128, 128, 255)), "texCoord": 1}
    model.add("materials", {"normalTexture": info})
    model.json["meshes"][0]["primitives"][0]["material"] = 0
    made = one_mesh(model)
    np.testing.assert_allclose(made.tangents, [(0, 1, 0, 1)] * 4, atol=1e-6)
    np.testing.assert_array_equal(made.uvs, UPRIGHT)
    np.testing.assert_array_equal(made.uvs1, [(-v, u) for u, v in UPRIGHT])


def draco_square(**more: object) -> Model:
    """A square of which Draco holds positions, normals and colours; the texture's set is plain."""
    model = Model()
    primitive = model.square()
    colors = np.array([(255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (51, 51, 51, 102)])
    primitive["attributes"]["COLOR_0"] = model.accessor(colors, "u1", normalized=True)
    packed = DracoPy.encode(
        np.array(CORNERS, np.float32), np.array(SQUARE, np.uint32).reshape(-1, 3),
        preserve_order=True, colors=colors.astype(np.uint8), normals=np.array(FACING, np.float64),
    )  # fmt: skip
    ids = {a["attribute_type"]: a["unique_id"] for a in DracoPy.decode(packed).attributes}
    names = {"POSITION": ids[0], "NORMAL": ids[1], "COLOR_0": ids[2]}
    view = model.view(packed)
    extension = {"bufferView": view, "attributes": names} | more
    primitive["extensions"] = {"KHR_draco_mesh_compression": extension}
    for name in names:
        del model.json["accessors"][primitive["attributes"][name]]["bufferView"]
    del model.json["accessors"][primitive["indices"]]["bufferView"]
    model.json["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return with_primitive(primitive, model)


def test_draco() -> None:
    made = one_mesh(draco_square())
    assert corners(made) == corners(one_mesh(square()))
    np.testing.assert_allclose(made.normals, FACING, atol=1e-6)
    assert made.colors is not None
    at = {tuple(p): tuple(c) for p, c in zip(made.positions.tolist(), made.colors, strict=True)}
    np.testing.assert_allclose(at[0, 1, 0], (0.2, 0.2, 0.2, 0.4), atol=1e-6)
    np.testing.assert_allclose(at[1, 0, 0], (0, 1, 0, 1), atol=1e-6)


def draco_bytes(model: Model) -> tuple[int, bytes]:
    """Place and bytes of a model's Draco data."""
    extensions = model.json["meshes"][0]["primitives"][0]["extensions"]
    index = extensions["KHR_draco_mesh_compression"]["bufferView"]
    view = model.json["bufferViews"][index]
    start = view["byteOffset"]
    return start, bytes(model.binary[start : start + view["byteLength"]])


@pytest.mark.parametrize(
    ("at", "byte", "words"),
    [
        (0, 0, "is no Draco data"),
        (5, 3, "Draco bitstream 3.2; allowed is 2.2"),
        (7, 0, "is no triangle mesh of Draco's"),
        (10, 0x80, "with metadata"),
        (11, 100, "Draco holds 4 points and 100 faces where the accessors have 4 and 2"),
        (12, 100, "Draco holds 100 points"),
        (20, 255, "Draco"),
    ],
)
def test_broken_draco_is_refused(at: int, byte: int, words: str) -> None:
    model = draco_square()
    start, _ = draco_bytes(model)
    model.binary[start + at] = byte
    with pytest.raises(ModelError) as refused:
        read(model)
    assert words in str(refused.value)


def test_draco_cut_short_is_refused() -> None:
    model = draco_square()
    start, content = draco_bytes(model)
    for length in (1, 12, 20, len(content) - 3):
        model.binary[start : start + len(content)] = content[:length] + bytes(len(content) - length)
        with pytest.raises(ModelError):
            read(model)


def test_draco_without_a_named_attribute_is_refused() -> None:
    with pytest.raises(ModelError, match="Draco holds no attribute 77"):
        read(draco_square(attributes={"POSITION": 77}))


def packed_view(
    model: Model, values: NDArray[Any], mode: str, filter_: str = "NONE",
    name: str = "EXT_meshopt_compression", encoded: NDArray[Any] | None = None,
) -> int:  # fmt: skip
    """A buffer view of values in meshopt's compression, with the fallback buffer that it needs."""
    fallback = 1 if "buffers" in model.json else len(model.json.setdefault("buffers", [])) + 1
    if len(model.json["buffers"]) == 0:
        model.json["buffers"].append({"byteLength": 4096, "extensions": {name: {"fallback": True}}})
    rows = values if encoded is None else encoded
    content = meshopt.encode_gltf_buffer(rows, mode)
    plain = model.view(content)
    place = model.json["bufferViews"].pop(plain)
    extension = place | {
        "byteStride": rows.nbytes // len(rows), "count": len(rows), "mode": mode, "filter": filter_,
    }  # fmt: skip
    size = {"buffer": fallback, "byteOffset": 0, "byteLength": rows.nbytes}
    return model.add("bufferViews", size | {"extensions": {name: extension}})


def meshopt_square(name: str = "EXT_meshopt_compression") -> Model:
    model = Model()
    model.json["extensionsRequired"] = [name]
    positions = np.array([(*corner, 0) for corner in CORNERS], "<u2")
    directions = np.array([(*normal, 1) for normal in FACING], np.float32)
    normals = meshopt.encode_filter_oct(directions, 4, 8).view(np.uint8)
    views = [
        packed_view(model, positions, "ATTRIBUTES", name=name),
        packed_view(model, directions, "ATTRIBUTES", "OCTAHEDRAL", name, normals),
        packed_view(model, np.array(SQUARE, "<u2"), "TRIANGLES", name=name),
    ]
    about = {"byteOffset": 0, "count": 4, "type": "VEC3"}
    attributes = {
        "POSITION": model.add("accessors", about | {"bufferView": views[0], "componentType": 5123}),
        "NORMAL": model.add(
            "accessors", about | {"bufferView": views[1], "componentType": 5120, "normalized": True}
        ),
        "TEXCOORD_0": model.accessor(UPRIGHT),
    }
    index = {"bufferView": views[2], "componentType": 5123, "count": 6, "type": "SCALAR"}
    primitive = {"attributes": attributes, "indices": model.add("accessors", index)}
    return with_primitive(primitive, model)


@pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
def test_meshopt(name: str) -> None:
    made = one_mesh(meshopt_square(name))
    assert corners(made) == corners(one_mesh(square()))
    np.testing.assert_allclose(made.normals, FACING, atol=1e-6)
    np.testing.assert_array_equal(
        np.array(UPRIGHT)[[CORNERS.index(tuple(p)) for p in made.positions.astype(int).tolist()]],
        made.uvs,
    )


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("count", 5, "of 40 decoded bytes"),
        ("byteStride", 6, "allowed are fours"),
        ("mode", "INDICES", "meshopt cannot decode it"),
        ("mode", "OTHER", "mode"),
        ("byteLength", 3, "meshopt cannot decode it"),
        ("byteLength", 10**6, "of buffers[0], which has"),
        ("filter", "OTHER", "filter"),
    ],
)
def test_broken_meshopt_is_refused(field: str, value: object, words: str) -> None:
    model = meshopt_square()
    view = model.json["bufferViews"][0]
    view["extensions"]["EXT_meshopt_compression"][field] = value
    with pytest.raises(ModelError) as refused:
        read(model)
    assert words in str(refused.value)


def test_shared_arrays_are_counted_once_for_each_mesh() -> None:
    """Instances cost nothing; a copy that is baked does."""
    model = square()
    for i in range(5):
        model.root(mesh=0, translation=[i, 0, 0])
    assert one_mesh(model, vertices=4, triangles=2).positions.shape == (4, 3)
    model.root(mesh=0, scale=[-1, 1, 1])
    with pytest.raises(ModelError, match=r"8 vertices; allowed are 4"):
        read(model, vertices=4)


def test_a_mesh_scaled_to_nothing_harms_nobody() -> None:
    model = square()
    model.root(mesh=0, scale=[0, 0, 0])
    model.root(mesh=0, scale=[1, 0, 1])
    data = read(model)
    assert len(data["objects"]) == 3
    for asset in data["meshes"].values():
        made = assets.mesh(asset["mesh"])
        np.testing.assert_allclose(np.linalg.norm(made.normals, axis=1), 1, atol=1e-6)


def test_far_coordinates_are_placed_where_they_are_allowed() -> None:
    """Beyond the scene's limit in the mesh, within it in the world."""
    model = Model()
    primitive = model.square()
    primitive["attributes"]["POSITION"] = model.accessor(np.array(CORNERS) * 3e6)
    model.root(mesh=model.mesh([primitive]), scale=[0.001, 0.001, 0.001])
    (asset,) = read(model)["meshes"].values()
    np.testing.assert_allclose(asset["high"], [3000, 3000, 0])
    model.json["nodes"][0]["scale"] = [1, 1, 1]
    with pytest.raises(ModelError, match="beyond 1e\\+06 m"):
        read(model)


def test_a_fan_of_many_triangles_has_one_tangent() -> None:
    """A fan of many triangles about one vertex is the hardest case of the tangents' grouping."""
    count = 100_000
    turn = np.linspace(0, math.tau, count)
    rim = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    positions = np.vstack([(0, 0, 0), rim])
    triangles = np.column_stack(
        [np.zeros(count - 1, int), np.arange(1, count), np.arange(2, count + 1)]
    )
    order = np.random.default_rng(0).permutation(len(triangles))
    normals = np.tile([0.0, 0.0, 1.0], (len(positions), 1))
    made, vertices, _ = mikktspace.tangents(
        positions, normals, positions[:, :2] * (1, -1), triangles[order]
    )
    assert len(vertices) == count + 1
    np.testing.assert_allclose(made, np.tile([1, 0, 0, 1], (count + 1, 1)), atol=1e-6)


def test_a_decoder_that_hangs_or_ends_is_refused_and_replaced(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """The next model is read by a new process."""
    for text in ("import time; time.sleep(60)", "import os; os.abort()", "print('no answer')"):
        (tmp_path / "worker.py").write_text(text)
        with monkeypatch.context() as patched:
            patched.setattr(draco, "WORKER", tmp_path / "worker.py")
            patched.setattr(draco, "PATIENCE", 0.5)
            draco._worker.close()
            with pytest.raises(ModelError, match="takes too much time or memory"):
                read(draco_square())
        draco._worker.close()
    assert one_mesh(draco_square()).colors is not None


def test_the_worker_answers_what_it_is_sent() -> None:
    """One answer for each request, good or not, until the input ends."""
    _, content = draco_bytes(draco_square())
    position = DracoPy.decode(content).attributes[0]["unique_id"]
    wanted = np.array([2, position, 99], "<u4").tobytes()
    requests = [wanted + content, b"", bytes(4) + b"DRACO" + bytes(20), bytes(4) + content]
    sent = b"".join(len(r).to_bytes(8, "little") + r for r in requests)
    target = io.BytesIO()
    draco_worker.serve(io.BytesIO(sent + b"cut"), target)
    answers, at = [], 0
    while at < len(target.getvalue()):
        length = int.from_bytes(target.getvalue()[at : at + 8], "little")
        answers.append(target.getvalue()[at + 8 : at + 8 + length])
        at += 8 + length
    assert [answer[:1] for answer in answers] == [b"+", b"-", b"-", b"+"]
    assert all(len(answer) > 1 for answer in answers)
    assert np.load(io.BytesIO(answers[0][1:])).files == ["faces", str(position)]
    assert np.load(io.BytesIO(answers[3][1:])).files == ["faces"]
