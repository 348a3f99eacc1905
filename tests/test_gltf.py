"""Whole glTF files: what a scene is made of them, where things stand, what is seen and lit."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import lightbench as lb
from lightbench import assets
from lightbench.errors import ModelError
from lightbench.gltf import read_gltf
from lightbench.matrix import compose
from lightbench.mesh import Mesh
from lightbench.scene import Scene
from tests.gltf_files import Model, read, square
from tests.support import assert_sound, shared_models

Data = dict[str, Any]
Floats = NDArray[np.float64]
TURN_X = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))


def only(group: Data) -> Any:
    """The one member of a group."""
    assert len(group) == 1
    return next(iter(group.values()))


def mesh_in(data: Data, name: str) -> Mesh:
    """The mesh of an object."""
    return assets.mesh(data["meshes"][data["objects"][name]["mesh"]]["mesh"])


def world(data: Data, name: str) -> Floats:
    """The positions (V, 3) of an object in the world."""
    thing = data["objects"][name]
    place = (thing.get("position", (0, 0, 0)), thing.get("rotation", (0, 0, 0)))
    matrix = np.array(compose(*place, thing.get("scale", (1, 1, 1)))).reshape(4, 4).T
    moved: Floats = mesh_in(data, name).positions @ matrix[:3, :3].T + matrix[:3, 3]
    return moved


def test_a_square() -> None:
    data = read(square())
    scene = Scene.parse(data)
    assert scene.title == "test"
    assert scene.about == "glTF model: 1 object, 2 triangles."
    assert only(data["objects"]) == {
        "shape": "mesh", "mesh": "square", "material": "plain",
        "position": [0, 0, 0], "rotation": [0, 0, 0], "scale": [1, 1, 1],
    }  # fmt: skip
    asset = only(data["meshes"])
    assert (asset["low"], asset["high"]) == ([0, 0, 0], [1, 1, 0])
    assert (asset["colors"], asset["uv1"]) == (False, False)
    made = assets.mesh(asset["mesh"])
    np.testing.assert_array_equal(
        made.positions[made.indices[1]], [(0, 0, 0), (1, 1, 0), (0, 1, 0)]
    )
    np.testing.assert_array_equal(made.tangents, [(1, 0, 0, 1)] * 4)


def test_glb_and_gltf_give_the_same(tmp_path: Path) -> None:
    model = square()
    expected = read(model)
    assert read(model.gltf()) == expected
    assert read(b"\xef\xbb\xbf" + model.gltf()) == expected
    (tmp_path / "my buffer.bin").write_bytes(model.binary)
    (tmp_path / "test.gltf").write_bytes(model.gltf("my%20buffer.bin"))
    assert read(tmp_path / "test.gltf") == expected


def test_nodes_stand_under_their_parents() -> None:
    """Against the product of the matrices, for a turned and stretched child of a moved parent."""
    model = Model()
    mesh = model.mesh([model.square()], "leaf")
    child = model.add("nodes", {"mesh": mesh, "name": "Leaf", "translation": [0, 2, 0]})
    parent = model.root(rotation=TURN_X, translation=[1, 0, 0], scale=[2, 2, 2], children=[child])
    assert parent == 1
    data = read(model)
    thing = data["objects"]["leaf"]
    np.testing.assert_allclose(thing["position"], [1, 0, 4], atol=1e-9)
    np.testing.assert_allclose(thing["rotation"], [90, 0, 0], atol=1e-9)
    np.testing.assert_allclose(thing["scale"], [2, 2, 2], rtol=1e-12)
    np.testing.assert_allclose(world(data, "leaf").max(axis=0), [3, 0, 6], atol=1e-6)


@pytest.mark.parametrize(
    "quaternion",
    [(0, 0, 0, 1), TURN_X, (0, math.sqrt(0.5), 0, math.sqrt(0.5)), (0.5, 0.5, 0.5, 0.5),
     (0.1, -0.7, 0.3, 0.2), (1, 2, -3, 4), (0, -math.sqrt(0.5), 0, math.sqrt(0.5))],
)  # fmt: skip
def test_rotations_become_euler_angles(quaternion: tuple[float, ...]) -> None:
    """A quaternion, of whatever length, turns a vector v into q v q*."""
    model = Model()
    model.root(mesh=model.mesh([model.square()], "s"), rotation=quaternion, scale=[1, 2, 3])
    data = read(model)
    assert "position" in data["objects"]["s"]
    axis, w = np.array(quaternion[:3]), quaternion[3]
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 2, 0), (0, 2, 0)], np.float64)
    length = axis @ axis + w * w
    turned = (w * w - axis @ axis) * corners + 2 * np.outer(corners @ axis, axis)
    turned += 2 * w * np.cross(axis, corners)
    np.testing.assert_allclose(world(data, "s"), turned / length, atol=2e-6)


def test_instances_share_a_mesh() -> None:
    model = Model()
    mesh = model.mesh([model.square()], "Leaf")
    model.root(mesh=mesh, name="One", translation=[1, 0, 0])
    model.root(mesh=mesh, name="Two", scale=[2, 2, 2])
    data = read(model)
    assert set(data["objects"]) == {"one", "two"}
    assert {thing["mesh"] for thing in data["objects"].values()} == set(data["meshes"])
    assert len(data["meshes"]) == 1


def test_a_mirror_is_baked() -> None:
    """The triangles turn around with the bitangent, the normal stays with the surface."""
    model = Model()
    model.root(mesh=model.mesh([model.square()], "s"), scale=[-1, 1, 1])
    data = read(model)
    assert "position" not in data["objects"]["s"]
    made = mesh_in(data, "s")
    np.testing.assert_array_equal(made.positions.min(axis=0), [-1, 0, 0])
    a, b, c = made.positions[made.indices[0]]
    assert np.cross(b - a, c - a)[2] > 0
    np.testing.assert_array_equal(made.normals, [(0, 0, 1)] * 4)
    np.testing.assert_array_equal(made.tangents, [(-1, 0, 0, -1)] * 4)


def test_given_tangents_are_mirrored_too() -> None:
    model = Model()
    primitive = model.square()
    primitive["attributes"]["TANGENT"] = model.accessor([(1, 0, 0, 1)] * 4)
    model.root(mesh=model.mesh([primitive], "s"), scale=[1, 1, -1])
    made = mesh_in(read(model), "s")
    np.testing.assert_array_equal(made.normals, [(0, 0, -1)] * 4)
    np.testing.assert_array_equal(made.tangents, [(1, 0, 0, -1)] * 4)


def test_a_shear_is_baked_with_normals_square_to_the_surface() -> None:
    model = Model()
    shear = [1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0.25, 1, 0, 0, 0, 0, 1]
    tilted = [(0, 0, 0), (1, 0, 1), (1, 1, 1), (0, 1, 0)]
    attributes = {
        "POSITION": model.accessor(tilted),
        "NORMAL": model.accessor([(-math.sqrt(0.5), 0, math.sqrt(0.5))] * 4),
    }
    model.root(mesh=model.mesh([{"attributes": attributes, "mode": 6}], "s"), matrix=shear)
    made = mesh_in(read(model), "s")
    a, b, c = made.positions[made.indices[0]].astype(np.float64)
    face = np.cross(b - a, c - a)
    np.testing.assert_allclose(made.normals, [face / np.linalg.norm(face)] * 4, atol=1e-6)
    np.testing.assert_allclose(made.positions.max(axis=0), [1.5, 1.25, 1], atol=1e-6)


def test_a_deep_chain_of_nodes_is_read() -> None:
    model = square()
    count = 9000
    for i in range(count):
        model.add("nodes", {"children": [i + 2]} if i + 1 < count else {"translation": [1, 0, 0]})
    model.json["scenes"][0]["nodes"].append(1)
    assert len(read(model)["objects"]) == 1


def test_only_the_default_scene_is_read() -> None:
    model = square()
    other = model.add("nodes", {"mesh": 0, "name": "Other"})
    model.json["scenes"].append({"nodes": [other]})
    assert set(read(model)["objects"]) == {"square"}
    model.json["scene"] = 1
    assert set(read(model)["objects"]) == {"other"}
    del model.json["scene"]
    assert set(read(model)["objects"]) == {"square"}
    del model.json["scenes"]
    assert set(read(model)["objects"]) == {"square", "other"}


def test_names_are_plain_and_unique() -> None:
    model = Model()
    mesh = model.mesh([model.square(), model.square()], "")
    for name in ("Ünder Ground!", "under-ground", "3rd", "木", ""):
        model.root(mesh=mesh, name=name)
    assert list(read(model)["objects"]) == [
        "under_ground_0", "under_ground_1", "under_ground_0_2", "under_ground_1_2",
        "n3rd_0", "n3rd_1", "part_3_0", "part_3_1", "part_4_0", "part_4_1",
    ]  # fmt: skip


def test_points_and_lines_are_left_out_with_a_note() -> None:
    model = Model()
    model.root(mesh=model.mesh([model.square(), model.square(mode=0), model.square(mode=3)], "s"))
    data = read(model)
    assert list(data["objects"]) == ["s_0"]
    assert "points and lines were left out" in data["about"]


def test_animations_and_morph_targets_are_noted() -> None:
    model = square(targets=[{"POSITION": 0}])
    model.json["animations"] = [{"channels": [], "samplers": []}]
    model.json["asset"]["copyright"] = "CC0\nby a person"
    about = read(model)["about"]
    assert "; CC0 by a person; " in about
    assert "animations were left out" in about
    assert "morph targets were left out" in about


def skinned_square() -> Model:
    """A square on two joints: its right half moves up by one, all is turned by its root."""
    model = Model()
    primitive = model.square()
    primitive["attributes"] |= {
        "JOINTS_0": model.accessor([(0, 1, 0, 0)] * 4, "u1"),
        "WEIGHTS_0": model.accessor([(1, 0, 0, 0), (0, 1, 0, 0), (0, 1, 0, 0), (1, 0, 0, 0)]),
    }
    inverse = np.eye(4)
    inverse[3, 0] = -1
    matrices = model.accessor([np.eye(4).ravel(), inverse.ravel()])
    model.add("nodes", {"translation": [1, 1, 0]})
    model.root(children=[0], scale=[2, 2, 2])
    model.add("skins", {"joints": [1, 0], "inverseBindMatrices": matrices})
    model.root(mesh=model.mesh([primitive], "s"), skin=0, translation=[50, 0, 0])
    return model


def test_a_skin_stands_as_its_joints_do() -> None:
    """The mesh's own node does not count (specification, section 3.7.3.3)."""
    data = read(skinned_square())
    np.testing.assert_allclose(
        world(data, "s"), [(0, 0, 0), (2, 2, 0), (2, 4, 0), (0, 2, 0)], atol=1e-6
    )


def test_a_joint_that_a_skin_lacks_is_refused() -> None:
    model = skinned_square()
    model.json["skins"][0]["joints"] = [1]
    with pytest.raises(ModelError, match=r"JOINTS_0: joint 1 of skins\[0\], which has 1"):
        read(model)
    index = model.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"]
    huge = model.accessor([(3e38, 0, 0, 0)] * 4)
    model.json["accessors"][index] = model.json["accessors"][huge]
    with pytest.raises(ModelError, match=r"JOINTS_0: joint 3e\+38 of skins\[0\], which has 1"):
        read(model)


def project(camera: Data, points: Floats) -> Floats:
    """Where points are seen, (N, 2), from -1 to 1 up and across a square picture."""
    eye = np.array(camera["eye"])
    back = eye - camera["target"]
    back /= np.linalg.norm(back)
    right = np.cross(camera["up"], back)
    right /= np.linalg.norm(right)
    ahead = points - eye
    depth = -(ahead @ back) * math.tan(math.radians(camera["fov"] / 2))
    assert (depth > 0).all()
    seen: Floats = np.stack([ahead @ right, ahead @ np.cross(back, right)], axis=1) / depth[:, None]
    return seen


@pytest.mark.parametrize("scale", [1e-4, 1.0, 8e4])
def test_a_model_without_a_camera_is_framed(scale: float) -> None:
    """All is in sight and fills the picture, seen from the front right and above."""
    model = Model()
    mesh = model.mesh([model.square()], "s")
    model.root(mesh=mesh, name="a", scale=[scale] * 3)
    model.root(mesh=mesh, name="b", scale=[scale] * 3, translation=[0, scale, -scale])
    data = read(model)
    seen = project(data["camera"], np.concatenate([world(data, "a"), world(data, "b")]))
    assert 0.5 < np.abs(seen).max() < 1
    eye = np.subtract(data["camera"]["eye"], data["camera"]["target"])
    assert eye[2] > eye[0] > eye[1] > 0
    assert data["camera"]["up"] == [0, 1, 0]
    Scene.parse(data)


def test_a_model_without_lights_has_a_studio() -> None:
    data = read(square())
    assert {light["type"] for light in data["lights"].values()} == {"directional"}
    assert set(data["lights"]) == {"key", "fill", "rim"}
    key = np.array(data["lights"]["key"]["direction"])
    assert key[1] < 0
    assert key[2] < 0
    assert data["settings"]["tonemap"] == "reinhard_extended"
    assert data["settings"]["ambient_level"] > 0


@pytest.mark.parametrize("look", [(0, 0, 0, 1), (0, 1, 0, 0)])
def test_a_grey_model_is_well_exposed_from_either_side(look: tuple[float, ...]) -> None:
    """Turned to the camera or to its right: neither dark nor burnt."""
    model = square(material=0)
    grey = {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0}
    model.add("materials", {"pbrMetallicRoughness": grey, "doubleSided": True})
    model.json["nodes"][0]["rotation"] = look
    image = lb.render(Scene.parse(read(model)), (64, 48))
    assert_sound(image)
    lit = image.linear[image.linear.sum(axis=2) > 0.1]
    assert len(lit) > 200
    assert 0.05 < float(lit.mean()) < 1


def with_camera(camera: Data, **node: object) -> Model:
    model = square()
    model.add("cameras", camera)
    model.root(camera=0, **node)
    return model


def test_the_files_camera_is_taken() -> None:
    lens = {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}
    data = read(
        with_camera(lens, translation=[3, 0.5, 0], rotation=[0, math.sqrt(0.5), 0, math.sqrt(0.5)])
    )
    camera = data["camera"]
    np.testing.assert_allclose(camera["eye"], [3, 0.5, 0], atol=1e-9)
    np.testing.assert_allclose(camera["target"], [0.5, 0.5, 0], atol=1e-6)
    np.testing.assert_allclose(camera["up"], [0, 1, 0], atol=1e-9)
    assert camera["fov"] == pytest.approx(math.degrees(0.8))
    Scene.parse(data)


def test_an_orthographic_camera_has_a_height() -> None:
    lens = {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1.5, "znear": 0, "zfar": 9}}
    data = read(with_camera(lens, translation=[0, 0, 3]))
    camera = Scene.parse(data).camera
    assert (camera.projection, camera.height) == ("orthographic", 3)


def test_a_camera_that_looks_nowhere_is_noted() -> None:
    lens = {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}
    data = read(with_camera(lens, scale=[0, 0, 0]))
    assert data["camera"]["fov"] == 35
    assert "looks from nowhere" in data["about"]


def test_punctual_lights() -> None:
    model = square()
    lights = [
        {"type": "point", "name": "Lamp", "intensity": 8, "color": [1, 0.5, 0]},
        {"type": "spot", "intensity": 9, "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
        {"type": "directional", "color": [2, 1, 0]},
    ]
    model.json["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    for i in range(3):
        extensions = {"KHR_lights_punctual": {"light": i}}
        model.root(extensions=extensions, translation=[0, 0, 2], rotation=TURN_X, scale=[3, 3, 3])
    data = read(model)
    lamp, spot, sun = data["lights"].values()
    assert lamp == {
        "type": "point", "color": [1, 0.5, 0], "intensity": 8, "position": [0, 0, 2]
    }  # fmt: skip
    np.testing.assert_allclose(spot["direction"], [0, 1, 0], atol=1e-9)
    assert spot["inner"] == pytest.approx(math.degrees(0.25))
    assert spot["outer"] == pytest.approx(math.degrees(0.5))
    assert (sun["color"], sun["intensity"]) == ([1, 0.5, 0], 2)
    assert list(data["lights"]) == ["lamp", "light", "light_2"]
    assert "ambient_level" not in data["settings"]
    Scene.parse(data)


@pytest.mark.parametrize(("candela", "stops"), [(math.pi * 4, 0), (math.pi * 4096, -10), (0, 0)])
def test_strong_lights_are_exposed_for(candela: float, stops: float) -> None:
    """From 2 m above: the illuminance is a quarter, pi lux make white paper radiance 1."""
    model = square()
    lights = [{"type": "point", "intensity": candela}]
    model.json["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    model.root(extensions={"KHR_lights_punctual": {"light": 0}}, translation=[0.5, 0.5, 2])
    assert read(model)["settings"]["exposure"] == pytest.approx(stops, abs=0.06)


def test_nothing_is_stored_of_a_broken_file() -> None:
    model = square(material=0)
    color = {"baseColorTexture": {"index": model.texture((1, 2, 3))}}
    model.add("materials", {"pbrMetallicRoughness": color})
    model.root(mesh=model.mesh([{"attributes": {"POSITION": model.accessor([(math.nan,) * 3])}}]))
    before = dict(assets._assets)
    with pytest.raises(ModelError):
        read(model)
    assert dict(assets._assets) == before


MODELS = [
    "BoxTextured.glb",
    "Duck.glb",
    "monkey.glb",
    "nested.glb",
    "rgb_cube_with_primitives.gltf",
]
BROKEN = {
    "BoxBadNormals.glb": r"NORMAL: the normals of triangle 0 are all zero",
    "BoxWithInfinites.glb": r"accessors\[2\]: element 0 of .*POSITION is not finite: -inf",
    "IndexOutOfRange/AllIndicesOutOfRange.gltf": r"indices: vertex 65535 is out of range",
    "IndexOutOfRange/IndexOutOfRange.gltf": r"indices: vertex 255 is out of range; there are 24",
    "MissingBin/BoxTextured.gltf": r"buffers\[0\]\.uri: there is no file 'BoxTextured0\.bin'",
    "RecursiveNodes/RecursiveNodes.gltf": r"nodes\[0\]: is its own ancestor",
    "SchemaFailures/sceneWrongType.gltf": r"scene: .*integer \(given 'hello'\)",
    "wrongTypes/badArray.gltf": r"meshes\[0\]\.primitives: ",
    "wrongTypes/badExtension.gltf": r"KHR_texture_transform: .*\(given 'Not an object'\)",
    "wrongTypes/badNumber.gltf": r"materials\[0\]\.normalTexture\.",
    "wrongTypes/badObject.gltf": r"materials\[0\]\.pbrMetallicRoughness: ",
    "wrongTypes/badString.gltf": r"scenes\[0\]\.name: .*string \(given 42\)",
    "wrongTypes/badUint.gltf": r"baseColorTexture\.index: .*\(given -1\)",
}  # fmt: skip


def shared_model(name: str) -> Path:
    path = shared_models() / name
    if not path.is_file():
        pytest.skip(f"no shared models here: {name}")
    return path


@pytest.mark.parametrize("name", MODELS)
def test_sample_models_are_read(name: str) -> None:
    data = read_gltf(shared_model(name), name=name, keep=False)
    scene = Scene.parse(data, name)
    assert scene.title == Path(name).stem
    for asset in scene.meshes.values():
        made = assets.mesh(asset.mesh)
        assert np.isfinite(np.column_stack(list(made.floats()))).all()
        np.testing.assert_allclose(np.linalg.norm(made.normals, axis=1), 1, atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(made.tangents[:, :3], axis=1), 1, atol=1e-6)


@pytest.mark.parametrize("name", BROKEN)
def test_broken_sample_models_are_refused(name: str) -> None:
    with pytest.raises(ModelError, match=BROKEN[name]) as refused:
        read_gltf(shared_model(f"broken/{name}"), name=Path(name).name, keep=False)
    assert str(refused.value).startswith(f"{Path(name).name}: ")
    assert "\n" not in str(refused.value)
