"""The playground as static files: all that the page loads, the same as served."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

import lightbench as lb
from lightbench import bake as baking
from lightbench.api import create_app
from lightbench.bake import bake, hierarchy_keys, mesh_keys
from lightbench.errors import LightbenchError
from lightbench.library import read_library
from lightbench.paths import shaders_folder
from lightbench.plan import plan
from lightbench.settings import Setting
from tests.support import presets


@pytest.fixture(autouse=True, scope="module")
def _page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A page that stands for the built one."""
    web = tmp_path_factory.mktemp("web")
    (web / "assets").mkdir()
    (web / "index.html").write_text("<!doctype html>")
    (web / "assets/a.js").write_text("1")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(baking, "web_folder", lambda: web)
        yield


@pytest.fixture(scope="module")
def baked(tmp_path_factory: pytest.TempPathFactory, _page: None) -> Path:
    folder = tmp_path_factory.mktemp("parent") / "site"
    count = bake(folder)
    assert count == len(files(folder))
    return folder


def files(folder: Path) -> list[str]:
    return sorted(p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file())


def test_the_folder_holds_the_page_and_its_data(baked: Path) -> None:
    found = files(baked)
    assert {"index.html", "assets/a.js", "data/manifest.json"} <= set(found)
    for name in presets():
        assert {f"data/scenes/{name}.json", f"data/thumbs/{name}.png"} <= set(found)
    assert [p.name for p in baked.parent.iterdir()] == ["site"]
    assert baked.stat().st_mode & 0o777 == 0o755


def test_every_file_is_what_the_service_answers(baked: Path) -> None:
    client = TestClient(create_app())
    for name in files(baked / "data"):
        if name != "baked.json":
            answer = client.get(f"/data/{name}")
            assert answer.status_code == 200, name
            assert answer.content == (baked / "data" / name).read_bytes(), name


def test_manifest_holds_the_menu_the_scenes_and_their_schema(baked: Path) -> None:
    manifest = json.loads((baked / "data/manifest.json").read_text())
    assert set(manifest) == {
        "folders", "files", "material_fields", "icosphere_errors", "scenes", "materials",
        "schema",
    }  # fmt: skip
    assert sorted(manifest["scenes"]) == presets()
    assert manifest["files"].keys() == read_library(shaders_folder()).files.keys()
    assert "camera" in manifest["schema"]["properties"]


def test_every_mesh_of_a_plan_is_there(baked: Path) -> None:
    library = read_library(shaders_folder())
    meshes = {path.stem for path in (baked / "data/meshes").iterdir()}
    for name in presets():
        for error in (0.01, 0.1, 4.0):
            settings: dict[str, Setting] = {"sphere_error": error, "technique": "raster"}
            planned = plan(library, lb.load(name), settings, (640, 480))
            draws = [d for p in planned["passes"] for b in p["batches"] for d in b["draws"]]
            assert {draw["mesh"] for draw in draws} - {None} <= meshes
    assert meshes == set(mesh_keys([lb.load(name) for name in presets()]))


def test_every_hierarchy_of_a_plan_is_there(baked: Path) -> None:
    library = read_library(shaders_folder())
    wanted: set[str] = set()
    for name in presets():
        tables = plan(library, lb.load(name), {"technique": "whitted"}, (64, 48))["tables"]
        wanted |= {key for table in tables.values() for key in table["meshes"]}
    assert wanted
    there = {path.stem for path in (baked / "data/hierarchies").iterdir()}
    assert wanted <= there == set(hierarchy_keys([lb.load(name) for name in presets()]))


def test_an_earlier_bake_is_replaced_whole(baked: Path) -> None:
    (baked / "assets/old.js").write_text("1")
    bake(baked)
    assert "assets/old.js" not in files(baked)
    assert [p.name for p in baked.parent.iterdir()] == ["site"]


def test_an_empty_folder_is_filled(tmp_path: Path) -> None:
    (tmp_path / "site").mkdir()
    bake(tmp_path / "site")
    assert (tmp_path / "site/index.html").is_file()


def test_what_it_did_not_make_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text("mine")
    with pytest.raises(LightbenchError, match="did not make"):
        bake(tmp_path)
    assert files(tmp_path) == ["index.html"]
    with pytest.raises(LightbenchError, match="is a file"):
        bake(tmp_path / "index.html")
    with pytest.raises(LightbenchError, match="cannot be written"):
        bake(tmp_path / "index.html/site")


def test_a_failure_leaves_nothing_behind(baked: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = files(baked)

    def full(_key: str) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(baking, "mesh", full)
    with pytest.raises(LightbenchError, match="No space left"):
        bake(baked)
    assert files(baked) == before
    assert [p.name for p in baked.parent.iterdir()] == ["site"]


def test_without_a_built_page_it_says_how(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(baking, "web_folder", lambda: tmp_path / "none")
    with pytest.raises(LightbenchError, match="not built; in a checkout run: make"):
        bake(tmp_path / "site")
    assert not (tmp_path / "site").exists()
