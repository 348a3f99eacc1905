"""Models and textures on their way in: by path, by command line, by REST, from a scene file."""

import base64
import io
import json
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient
from PIL import Image as Pillow

import lightbench as lb
from lightbench import assets
from lightbench.api import create_app
from lightbench.cli import main
from lightbench.gltf import Limits
from tests.support import shared_models

SIZE = (96, 72)
ABSENT = pytest.param(Path("none"), marks=pytest.mark.skip("no shared models"))
WHOLE: list[Any] = [*shared_models().glob("*.gl*")] or [ABSENT]
_BROKEN = [*shared_models().glob("broken/*.glb"), *shared_models().glob("broken/*/*.gltf")]
BROKEN: list[Any] = _BROKEN or [ABSENT]
ROOM = Path(__file__).parents[1] / "scenes" / "model-room.gltf"


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(create_app()) as client:
        yield client


def triangle(**document: Any) -> bytes:
    """A .gltf of one triangle that stands alone, with more of its document."""
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    uri = "data:application/octet-stream;base64," + base64.b64encode(positions.tobytes()).decode()
    made: dict[str, Any] = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 36, "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 1, 0],
            }
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }  # fmt: skip
    return json.dumps({**made, **document}).encode()


def lightbench(*arguments: str) -> int:
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert isinstance(stop.value.code, int)
    return stop.value.code


@pytest.mark.parametrize("path", WHOLE, ids=lambda path: path.name)
def test_a_model_is_seen(path: Path) -> None:
    """Framed whole, not cut off, lit, and finite."""
    image = lb.render(lb.load(str(path)), SIZE)
    assert image.invalid().total == 0
    seen = lb.render(lb.load(str(path)), SIZE, view="depth").linear[..., 0] > 0
    assert 0.03 < seen.mean() < 0.9
    border = np.concatenate([seen[0], seen[-1], seen[:, 0], seen[:, -1]])
    assert not border.any()
    assert image.display[seen].mean() > 40


@pytest.mark.parametrize("path", BROKEN, ids=lambda path: path.name)
def test_a_broken_model_is_refused_quickly(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], client: TestClient
) -> None:
    start = time.perf_counter()
    out = tmp_path / "out.png"
    assert lightbench("render", str(path), "-o", str(out)) == 2
    assert time.perf_counter() - start < 1
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert path.name in error
    assert not out.exists()
    answer = client.post("/api/models", params={"name": path.name}, content=path.read_bytes())
    assert answer.status_code == 422
    assert answer.json()["error"]["message"].startswith(path.name)


def test_a_model_from_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = tmp_path / "mine.gltf"
    model.write_bytes(triangle())
    out = tmp_path / "mine.npy"
    assert lightbench("render", str(model), "-o", str(out), "--size", "96x72") == 0
    assert np.load(out).max() > 0
    assert lightbench("render", str(model), "-o", str(out), "--limit", "vertices=2") == 2
    assert "allowed are 2" in capsys.readouterr().err
    assert lightbench("render", str(model), "--limit", "corners=2") == 2
    assert "NAME=NUMBER of one of: file_bytes, vertices" in capsys.readouterr().err


def test_an_attachment_from_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "map"
    common = ("render", "shadow-lab", "--size", "64x48", "--set", "shadow_resolution=256")
    for ending in ("npy", "png", "exr"):
        given = (*common, "--attachment", "shadow_map.0", "-o", f"{out}.{ending}")
        assert lightbench(*given) == 0
    depth = np.load(f"{out}.npy")
    assert 0 < depth.min() < depth.max() <= 1
    codes = np.asarray(Pillow.open(f"{out}.png"))
    assert np.abs(codes / 255 - depth).max() < 0.6 / 255
    capsys.readouterr()
    assert lightbench(*common, "--attachment", "depth") == 2
    assert "no attachment 'depth'; there is: display, linear, normal_distance, radiance" in (
        capsys.readouterr().err
    )


def test_an_upload_is_a_scene(client: TestClient) -> None:
    answer = client.post("/api/models", params={"name": "tri.gltf"}, content=triangle())
    assert answer.status_code == 200, answer.text
    scene = answer.json()
    assert scene["title"] == "tri"
    body = {"scene": scene, "width": 96, "height": 72, "format": "npy"}
    picture = client.post("/api/render", json=body)
    assert picture.status_code == 200, picture.text
    found = np.load(io.BytesIO(picture.content))
    want = lb.render(lb.Scene.parse(scene), SIZE).linear
    np.testing.assert_array_equal(found, want)
    key = next(iter(scene["meshes"].values()))["mesh"]
    assert client.get(f"/data/meshes/{key}.bin").status_code == 200


def test_a_scene_whose_assets_are_gone(client: TestClient) -> None:
    scene = client.post("/api/models", content=triangle()).json()
    name = next(iter(scene["meshes"]))
    scene["meshes"][name]["mesh"] = "mesh-" + "0" * 32
    answer = client.post("/api/render", json={"scene": scene})
    assert answer.status_code == 404
    assert "read its model again" in answer.json()["error"]["message"]


def test_an_upload_is_bounded() -> None:
    with TestClient(create_app(Limits(file_bytes=100))) as small:
        answer = small.post("/api/models", params={"name": "big"}, content=b"x" * 101)
    assert answer.status_code == 422
    message = answer.json()["error"]["message"]
    assert message == "big: is larger than the 100 bytes that are allowed"


def test_an_upload_reads_no_file_of_the_server(client: TestClient) -> None:
    for uri in ("../scenes/model-room.bin", "/etc/passwd", "model-room.bin"):
        content = triangle(buffers=[{"byteLength": 36, "uri": uri}])
        answer = client.post("/api/models", content=content)
        assert answer.status_code == 422
        assert uri.rpartition("/")[2] in answer.json()["error"]["message"]


def write(folder: Path, **scene: Any) -> str:
    path = folder / "scene.json"
    cube = {"shape": "cube", "material": "m"}
    whole = {"materials": {"m": {}}, "objects": {"cube": cube}, **scene}
    path.write_text(json.dumps(whole))
    return str(path)


def test_a_scene_file_names_its_images(tmp_path: Path) -> None:
    Pillow.new("L", (4, 4), 128).save(tmp_path / "grey.jpg")
    path = write(tmp_path, textures={"grey": {"file": "grey.jpg", "encoding": "srgb"}})
    texture = lb.load(path).textures["grey"]
    with Pillow.open(io.BytesIO(assets.image(texture.image))) as stored:
        assert stored.format == "PNG"
        assert stored.getpixel((0, 0)) == (128, 128, 128)


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ({"textures": {"t": {"file": "none.png"}}}, "textures.t.file: no file 'none.png' beside"),
        ({"textures": {"t": {"file": "../secret.png"}}}, "no file '../secret.png' beside"),
        ({"textures": {"t": {"file": "scene.json"}}}, "textures.t.file: is no image"),
        ({"textures": {"t": {}}}, "textures.t.image: Field required"),
        ({"model": "none.glb"}, "model: no file 'none.glb' beside the scene"),
        ({"model": 3}, "model: no file 3 beside"),
        ({"model": "scene.json"}, "scene.json: "),
    ],
    ids=str,
)
def test_a_scene_file_is_refused(tmp_path: Path, entry: dict[str, Any], message: str) -> None:
    (tmp_path.parent / "secret.png").write_bytes(b"")
    with pytest.raises(lb.LightbenchError) as caught:
        lb.load(write(tmp_path, **entry))
    assert message in str(caught.value)


def test_a_scene_s_own_entries_stand_above_its_model_s(tmp_path: Path) -> None:
    (tmp_path / "tri.gltf").write_bytes(triangle())
    scene = {"model": "tri.gltf", "objects": {}, "camera": {"eye": [0, 0, 9]}}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene))
    loaded = lb.load(str(path))
    assert loaded.camera.eye == (0, 0, 9)
    assert len(loaded.objects) == 1
    assert loaded.lights
    path.write_text(json.dumps({**scene, "lights": {}, "settings": {}}))
    assert not lb.load(str(path)).lights


def test_the_room_of_the_preset_is_its_model() -> None:
    preset, model = lb.load("model-room"), lb.load(str(ROOM))
    assert preset.objects == model.objects
    assert preset.camera != model.camera
