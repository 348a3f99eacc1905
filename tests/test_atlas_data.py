"""The atlas's documents for the page: what they hold, and what is refused."""

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from numpy.typing import NDArray

from lightbench import atlas_data
from lightbench.api import create_app
from lightbench.atlas import PRECISIONS
from lightbench.exact import reference
from lightbench.library import read_library
from lightbench.sweep import points, sweep_of, sweeps
from lightbench.sweep_arguments import arguments, doubled
from tests.support import copy_of_shaders, library

GGX = ("distributions/ggx.glsl", "distribution", "alpha", "theta_h")
TEXTBOOK = "distributions/ggx_textbook.glsl"


def unpacked(document: bytes) -> tuple[dict[str, Any], bytes]:
    """Header and arrays."""
    (length,) = struct.unpack_from("<I", document)
    assert (length + 4) % 8 == 0
    return json.loads(document[4 : 4 + length]), document[4 + length :]


def array(arrays: bytes, place: dict[str, Any], kind: str) -> NDArray[Any]:
    """One array of a document."""
    shape = (place["rows"], place["components"])
    return np.frombuffer(arrays, kind, shape[0] * shape[1], place["at"]).reshape(shape)


@pytest.fixture(scope="module")
def client() -> TestClient:
    return TestClient(create_app())


def test_a_document_holds_every_form_and_its_axes() -> None:
    header, _ = unpacked(atlas_data.document(library(), *GGX))
    forms = [(form["file"], form["precision"]["name"]) for form in header["forms"]]
    assert forms == [(file, p.name) for p in PRECISIONS for file in (TEXTBOOK, GGX[0])]
    assert [form["textbook"] for form in header["forms"]] == [True, False] * 2
    sweep = sweep_of(library(), *GGX)
    for name in "xy":
        assert header[name]["values"] == sweep.axis(header[name]["name"]).samples(96).tolist()
    assert (header["title"], header["size"]) == ("GGX (Trowbridge-Reitz)", 96)
    for form in header["forms"]:
        program = form["program"]
        assert program["fragment"].startswith("#version 300 es")
        assert len(program["fragment_lines"]) == len(program["fragment"].split("\n"))
        assert ("toHalf" in program["fragment"]) == form["precision"]["half"]
        for column in form["columns"]:
            assert f"uniform highp sampler2D {column['sampler']};" in program["fragment"]


def test_columns_and_truth_are_those_of_the_atlas() -> None:
    for sweep in sweeps(library()):
        document = atlas_data.document(library(), sweep.file, sweep.function, sweep.x, sweep.y)
        header, arrays = unpacked(document)
        exact = reference(library(), sweep.file, sweep.function)
        assert exact is not None
        for form in header["forms"]:
            given = arguments(library(), sweep, form["file"], points(sweep, 96))
            first, settings = doubled(given)
            with np.errstate(all="ignore"):
                want = np.asarray(exact(*first, **settings))
            found = array(arrays, form["exact"], "<f8")
            assert np.array_equal(found, want.reshape(found.shape), equal_nan=True)
            columns = {c["sampler"]: array(arrays, c, "<f4") for c in form["columns"]}
            for index, value in enumerate(given[0]):
                name = f"u_call_a{index}"
                fields = value if isinstance(value, dict) else {"": value}
                for field, column in fields.items():
                    shipped = columns[f"{name}_{field}" if field else name]
                    assert np.array_equal(shipped, column.reshape(shipped.shape))
            assert len(document) % 8 == 0


def test_a_dropped_in_file_has_no_truth(tmp_path: Path) -> None:
    code = "float distribution(vec3 h, float alpha) { return u_k * alpha; }\n"
    head = '/*---\ntitle = "Mine"\n[parameters.k]\ndefault = 0.5\nrange = [0.0, 1.0]\n---*/\n'
    folder = copy_of_shaders(tmp_path, {"distributions/mine.glsl": head + code})
    mine = "distributions/mine.glsl"
    found = read_library(folder)
    header, _ = unpacked(atlas_data.document(found, mine, "distribution", "k", "alpha"))
    assert [form["exact"] for form in header["forms"]] == [None, None]
    assert mine in [entry["file"] for entry in atlas_data.index(found)["functions"]]


def test_the_index_lists_every_sweep(client: TestClient) -> None:
    index = client.get("/data/atlas.json").json()
    assert index == atlas_data.index(library())
    listed = [(e["file"], e["function"], *axes) for e in index["functions"] for axes in e["axes"]]
    assert sorted(listed) == sorted((s.file, s.function, s.x, s.y) for s in sweeps(library()))
    for entry in index["functions"]:
        names = {each["name"] for each in entry["inputs"]}
        assert all(set(axes) <= names for axes in entry["axes"])


def test_any_two_inputs_are_served(client: TestClient) -> None:
    answer = client.get("/data/atlas/maskings/smith_ggx/masking/azimuth/NoL.bin")
    assert answer.status_code == 200
    header, _ = unpacked(answer.content)
    assert (header["x"]["name"], header["y"]["name"]) == ("azimuth", "NoL")
    assert {each["name"] for each in header["fixed"]} == {"alpha", "NoV"}
    tag = {"If-None-Match": answer.headers["ETag"]}
    assert client.get(answer.url.path, headers=tag).status_code == 304


@pytest.mark.parametrize(
    ("path", "status", "says"),
    [
        ("distributions/none/distribution/alpha/theta_h", 404, "distributions/ggx.glsl"),
        ("../secret/distribution/alpha/theta_h", 404, ""),
        ("distributions/ggx/masking/alpha/theta_h", 404, "there is: distribution"),
        ("distributions/ggx/distribution/alpha/theta", 404, "there is: alpha, theta_h"),
        ("distributions/ggx/distribution/alpha/alpha", 422, "two different inputs"),
    ],
)
def test_what_there_is_not_is_refused(
    path: str, status: int, says: str, client: TestClient
) -> None:
    answer = client.get(f"/data/atlas/{path}.bin")
    assert answer.status_code == status
    assert says in answer.json()["error"]["message"]
