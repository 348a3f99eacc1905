"""The room: sound triangles, real measures, shared furniture, files that exist."""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from scenes.making.room import make_room
from tests.support import SCENES

ROOM = SCENES / "model-room.gltf"
DOCUMENT: dict[str, Any] = json.loads(ROOM.read_text())
BINARY = ROOM.with_suffix(".bin").read_bytes()
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}
KINDS = {5126: "<f4", 5123: "<u2", 5125: "<u4"}
PRIMITIVES = [
    (f"{mesh['name']}-{DOCUMENT['materials'][part['material']]['name']}", part)
    for mesh in DOCUMENT["meshes"]
    for part in mesh["primitives"]
]

Values = NDArray[np.float64]


def array(index: int) -> Values:
    """An accessor's values, (count, width)."""
    accessor = DOCUMENT["accessors"][index]
    view = DOCUMENT["bufferViews"][accessor["bufferView"]]
    width = WIDTHS[accessor["type"]]
    found = np.frombuffer(
        BINARY, KINDS[accessor["componentType"]], accessor["count"] * width, view["byteOffset"]
    )
    assert found.nbytes == view["byteLength"]
    assert view["byteOffset"] % 4 == 0
    return found.reshape(-1, width).astype(np.float64)


def matrix(node: dict[str, Any]) -> Values:
    """A node's own transform, (4, 4)."""
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    made = np.eye(4)
    made[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)))
    made[:3, 3] = node.get("translation", (0, 0, 0))
    return made


def placed() -> Iterator[tuple[str, dict[str, Any], Values]]:
    """(name, node, transform to the world) of every node under the scene."""
    waiting = [(index, np.eye(4)) for index in DOCUMENT["scenes"][0]["nodes"]]
    while waiting:
        index, above = waiting.pop()
        node = DOCUMENT["nodes"][index]
        here = above @ matrix(node)
        yield node["name"], node, here
        waiting += [(child, here) for child in node.get("children", [])]


def bounds(wanted: str) -> tuple[Values, Values]:
    """Lowest and highest corner of one node's mesh in the room."""
    found = next((node, here) for name, node, here in placed() if name == wanted)
    mesh = DOCUMENT["meshes"][found[0]["mesh"]]
    points = np.concatenate([array(p["attributes"]["POSITION"]) for p in mesh["primitives"]])
    world = points @ found[1][:3, :3].T + found[1][:3, 3]
    return world.min(0), world.max(0)


@pytest.mark.parametrize(("name", "part"), PRIMITIVES, ids=[name for name, _ in PRIMITIVES])
def test_triangles_are_sound(name: str, part: dict[str, Any]) -> None:
    positions, normals, uvs = (
        array(part["attributes"][key]) for key in ("POSITION", "NORMAL", "TEXCOORD_0")
    )
    faces = array(part["indices"]).astype(int).reshape(-1, 3)
    assert sorted(set(faces.ravel().tolist())) == list(range(len(positions)))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
    a, b, c = np.moveaxis(positions[faces], 1, 0)
    cross = np.cross(b - a, c - a)
    assert (np.linalg.norm(cross, axis=1) > 1e-11).all()
    assert ((cross * normals[faces].sum(1)).sum(1) > 0).all()
    (ua, va), (ub, vb), (uc, vc) = (uvs[faces[:, i]].T for i in range(3))
    assert (np.abs((ub - ua) * (vc - va) - (vb - va) * (uc - ua)) > 1e-9).all()
    accessor = DOCUMENT["accessors"][part["attributes"]["POSITION"]]
    np.testing.assert_allclose(accessor["min"], positions.min(0), atol=1e-6)
    np.testing.assert_allclose(accessor["max"], positions.max(0), atol=1e-6)


def test_the_room_is_light_enough_for_a_page() -> None:
    counts = [DOCUMENT["accessors"][part["indices"]]["count"] // 3 for _, part in PRIMITIVES]
    drawn = [
        sum(DOCUMENT["accessors"][p["indices"]]["count"] // 3 for p in mesh["primitives"])
        for _, node, _ in placed()
        if "mesh" in node
        for mesh in [DOCUMENT["meshes"][node["mesh"]]]
    ]
    assert sum(counts) < sum(drawn) <= 60_000
    assert len(BINARY) == DOCUMENT["buffers"][0]["byteLength"] <= 2.5e6


def test_every_node_is_in_the_tree_once_under_a_name_that_a_scene_takes() -> None:
    names = [name for name, _, _ in placed()]
    assert len(names) == len(set(names)) == len(DOCUMENT["nodes"])
    named = [*names, *(m["name"] for m in (*DOCUMENT["materials"], *DOCUMENT["meshes"]))]
    assert [name for name in named if not re.fullmatch(r"[a-z][a-z0-9_]*", name)] == []


def test_four_chairs_share_one_mesh_and_stand_differently() -> None:
    chairs = [node for name, node, _ in placed() if name.startswith("chair")]
    assert len(chairs) == 4
    assert len({node["mesh"] for node in chairs}) == 1
    assert len({tuple(node["rotation"]) for node in chairs}) == 4
    uses = Counter(node["mesh"] for _, node, _ in placed() if "mesh" in node)
    assert sum(count > 1 for count in uses.values()) >= 4


@pytest.mark.parametrize(
    ("name", "floor", "height"),
    [
        ("table", 0.009, 0.75),
        ("chair_1", 0.009, 0.91),
        ("bookcase", 0.0, 1.93),
        ("rug", 0.0, 0.009),
    ],
)
def test_furniture_stands_on_the_floor_and_has_real_measures(
    name: str, floor: float, height: float
) -> None:
    low, high = bounds(name)
    assert low[1] == pytest.approx(floor, abs=5e-4)
    assert high[1] - low[1] == pytest.approx(height, abs=0.02)


@pytest.mark.parametrize("name", ["bowl", "teapot", "cup_1", "cup_2", "lamp", "books_lying"])
def test_what_is_on_the_table_lies_on_its_top(name: str) -> None:
    low, high = bounds(name)
    table = bounds("table")
    assert low[1] == pytest.approx(table[1][1], abs=2e-3)
    assert (low[[0, 2]] > table[0][[0, 2]]).all()
    assert (high[[0, 2]] < table[1][[0, 2]]).all()


def test_everything_is_inside_the_walls() -> None:
    low, high = bounds("shell")
    for name, node, _ in placed():
        if "mesh" in node:
            mine = bounds(name)
            assert (mine[0] >= low - 1e-5).all(), name
            assert (mine[1] <= high + 1e-5).all(), name


def test_the_lamp_of_the_scene_hangs_inside_the_lamps_shade() -> None:
    lamp = json.loads((SCENES / "model-room.json").read_text())["lights"]["lamp"]
    head = next(here for name, _, here in placed() if name == "lamp_head")
    x, y, z, _ = np.linalg.inv(head) @ (*lamp["position"], 1)
    # Past the bulb's tip, before the rim.
    assert 0.064 < y < 0.105
    assert math.hypot(x, z) < 0.02


def test_textures_exist_and_are_used_with_the_encoding_of_their_maps() -> None:
    for image in DOCUMENT["images"]:
        assert (SCENES / image["uri"]).is_file()

    def kinds(slot: str) -> set[str]:
        found = set()
        for material in DOCUMENT["materials"]:
            reference = (material | material["pbrMetallicRoughness"]).get(slot)
            if reference:
                source = DOCUMENT["textures"][reference["index"]]["source"]
                found.add(DOCUMENT["images"][source]["uri"].rpartition("_")[2])
        return found

    assert kinds("baseColorTexture") == {"albedo.png"}
    assert kinds("normalTexture") == {"normal.png"}
    assert kinds("metallicRoughnessTexture") == kinds("occlusionTexture") == {"orm.png"}


def test_making_the_room_again_gives_the_stored_one(tmp_path: Path) -> None:
    again = make_room(tmp_path / "model-room.gltf")
    made = json.loads(again[0].read_text())
    for accessor, before in zip(made["accessors"], DOCUMENT["accessors"], strict=True):
        for key in ("min", "max"):
            # Another processor's sine may round the last digit differently.
            np.testing.assert_allclose(accessor.pop(key, 0), before.get(key, 0), atol=1e-5)
    assert made["accessors"] == [
        {key: a[key] for key in a if key not in ("min", "max")} for a in DOCUMENT["accessors"]
    ]
    assert made.keys() == DOCUMENT.keys()
    for key in made.keys() - {"accessors", "nodes"}:
        assert made[key] == DOCUMENT[key], key
    assert len(again[1].read_bytes()) == len(BINARY)
