"""Mutated glTF files: a scene that is sound, or a ModelError; nothing else, and soon."""

import copy
import json
import struct
import time
from functools import cache
from typing import Any

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lightbench import assets
from lightbench.errors import ModelError
from lightbench.scene import Scene
from tests.gltf_files import read
from tests.test_gltf import skinned_square
from tests.test_gltf_geometry import draco_square, meshopt_square
from tests.test_gltf_refusals import whole

# Of work in this process, however busy the machine is.
SECONDS = 1.0
QUICK = settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
# A place, counted around and around, and the byte to stand there.
CHANGE = st.tuples(st.integers(0), st.integers(0, 255))
# What may stand in place of a value: of each type, and at the edges of the numbers.
ODD = st.one_of(
    st.none(),
    st.booleans(),
    st.sampled_from([-1, 0, 1, 2, 3, 5, 255, 5120, 5121, 5123, 5125, 2**31 - 1, 2**32, 2**63, 1e9]),
    st.sampled_from([-1e38, 1e-38, 0.5, 1e6, 1e-7, 3.3e38, 1e39, float("nan"), float("inf")]),
    st.integers(-10, 40),
    st.floats(width=32),
    st.text(max_size=4),
    st.sampled_from(
        ["VEC3", "SCALAR", "BLEND", "data:,", "data:;base64,AAAA", "../x", "TRIANGLES"]
    ),
    st.lists(st.integers(-2, 9), max_size=4),
    st.dictionaries(st.sampled_from(["index", "extensions", "POSITION"]), st.integers(0, 3)),
)


@cache
def valid() -> tuple[bytes, ...]:
    """Files that are good, of each kind of content."""
    return tuple(m.glb() for m in (whole(), skinned_square(), draco_square(), meshopt_square()))


def split(content: bytes) -> tuple[Any, bytes]:
    """The document and the binary chunk of a .glb."""
    (length,) = struct.unpack_from("<I", content, 12)
    return json.loads(content[20 : 20 + length]), content[28 + length :]


def check(content: bytes) -> None:
    """A scene whose arrays are finite and whose indices are in range, or a refusal of one line."""
    began = time.process_time()
    data, reason = outcome(content)
    assert time.process_time() - began < SECONDS
    if data is None:
        assert "\n" not in reason
        return
    for asset in Scene.parse(data).meshes.values():
        made = assets.mesh(asset.mesh)
        assert all(np.isfinite(array).all() for array in made.floats())
        assert made.indices.max() < len(made.positions)
        assert np.abs(np.linalg.norm(made.normals, axis=1) - 1).max() < 1e-5


def outcome(content: bytes) -> tuple[Any, str]:
    try:
        return read(content), ""
    except ModelError as refusal:
        return None, str(refusal)


def test_the_files_themselves_are_good() -> None:
    for content in valid():
        Scene.parse(read(content))


@QUICK
@given(
    st.sampled_from(range(4)), st.lists(st.tuples(st.integers(0), st.integers(0, 255)), max_size=8)
)
def test_flipped_bytes(which: int, changes: list[tuple[int, int]]) -> None:
    content = bytearray(valid()[which])
    for at, byte in changes:
        content[at % len(content)] = byte
    check(bytes(content))


@QUICK
@given(
    st.sampled_from(range(4)), st.lists(st.tuples(st.integers(0), st.integers(0, 255)), max_size=4)
)
def test_flipped_bytes_of_the_binary_chunk(which: int, changes: list[tuple[int, int]]) -> None:
    """In floats, indices, images and what Draco and meshopt compressed."""
    content = bytearray(valid()[which])
    _, binary = split(bytes(content))
    for at, byte in changes:
        content[-1 - at % len(binary)] = byte
    check(bytes(content))


@QUICK
@given(st.sampled_from(range(4)), st.integers(0), st.binary(max_size=12))
def test_files_cut_and_spliced(which: int, at: int, more: bytes) -> None:
    content = valid()[which]
    at %= len(content)
    check(content[:at])
    check(content[:at] + more + content[at:])


def places(value: Any) -> list[tuple[Any, Any]]:
    """(container, key) of every value in a document."""
    found: list[tuple[Any, Any]] = []
    waiting = [value]
    while waiting:
        here = waiting.pop()
        keys = here.keys() if isinstance(here, dict) else range(len(here))
        for key in keys:
            found.append((here, key))
            if isinstance(here[key], dict | list):
                waiting.append(here[key])
    return found


@settings(QUICK, max_examples=400)
@given(
    st.sampled_from(range(4)),
    st.lists(st.tuples(st.integers(0), ODD | st.just(...)), min_size=1, max_size=3),
)
def test_replaced_values(which: int, changes: list[tuple[int, Any]]) -> None:
    """Up to three values of the document replaced, or removed, whatever stands there."""
    document, binary = split(valid()[which])
    for at, value in changes:
        everywhere = places(document)
        if not everywhere:
            break
        here, key = everywhere[at % len(everywhere)]
        if value is ...:
            del here[key]
        else:
            here[key] = copy.deepcopy(value)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
    check(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
