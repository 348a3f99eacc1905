"""The `lightbench` command: files, listings, exit codes, and one line for every mistake."""

import json
import os
import signal
import socket
import subprocess
import sys
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from fastapi.testclient import TestClient
from PIL import Image as Pillow

import lightbench as lb
from lightbench import doctor
from lightbench.api import create_app
from lightbench.cli import main
from lightbench.errors import GraphicsError
from tests.support import copy_of_shaders, presets

SMALL = ("--size", "32x24")
COMMAND = (sys.executable, "-m", "lightbench.cli")
HALVED = """/*---
title = "Halved"
---*/
vec3 tonemap(vec3 radiance) {
  return 0.5 * radiance;
}
"""
# A cube fills the upper half and is lit from the eye; below it there is nothing.
TOP_LIT = {
    "camera": {"eye": [0, 0, 9], "target": [0, 0, 0]},
    "materials": {"white": {"base_color": [1, 1, 1]}},
    "objects": {"top": {"shape": "cube", "material": "white", "position": [0, 4, 0], "scale": 8}},
    "lights": {"sun": {"type": "directional", "direction": [0, 0, -1], "intensity": 3}},
    "settings": {"ambient": "none", "model": "lambert"},
}


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work in an empty folder, and undo what --shaders and --scenes do to the environment."""
    monkeypatch.chdir(tmp_path)
    for name in ("LIGHTBENCH_SHADERS", "LIGHTBENCH_SCENES"):
        monkeypatch.setenv(name, "")
        monkeypatch.delenv(name)


def lightbench(*arguments: str) -> int:
    """The exit code of one call."""
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    code = stop.value.code
    assert isinstance(code, int)
    return code


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    """The one line that a wrong call ends with."""
    assert lightbench(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("lightbench: ")
    assert err.count("\n") == 1
    assert err.endswith("\n")
    return err


def exr(path: Path) -> "np.ndarray[tuple[int, ...], np.dtype[np.float32]]":
    with OpenEXR.File(str(path)) as file:
        return np.asarray(file.channels()["RGB"].pixels)


def png(path: str) -> "np.ndarray[tuple[int, ...], np.dtype[np.uint8]]":
    with Pillow.open(path) as file:
        return np.asarray(file)


# Pictures


def test_render_writes_each_format(capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("a.png", "a.npy", "a.exr"):
        assert lightbench("render", "box-room", *SMALL, "-o", name) == 0
        out, err = capsys.readouterr()
        assert out.startswith(f"{name}  32x24  ")
        assert " ms  " in out
        assert (out.count("\n"), err) == (1, "")
    linear = np.load("a.npy")
    assert linear.shape == (24, 32, 3)
    assert linear.dtype == np.float32
    assert np.isfinite(linear).all()
    assert (linear >= 0).all()
    assert png("a.png").shape == (24, 32, 3)
    np.testing.assert_array_equal(exr(Path("a.exr")), linear)


def test_render_equals_python(capsys: pytest.CaptureFixture[str]) -> None:
    settings = ("--set", "model=phong", "--set", "camera.fov=60", "--view", "final")
    assert lightbench("render", "spheres", *SMALL, *settings, "-o", "a.npy") == 0
    image = lb.render("spheres", (32, 24), model="phong", **{"camera.fov": 60})
    np.testing.assert_array_equal(np.load("a.npy"), image.linear)


def test_the_last_value_of_a_setting_counts() -> None:
    twice = ("--set", "model=lambert", "--set", "model=phong")
    assert lightbench("render", "metals", *SMALL, *twice, "-o", "a.npy") == 0
    expected = lb.render("metals", (32, 24), model="phong").linear
    np.testing.assert_array_equal(np.load("a.npy"), expected)


def test_row_0_is_the_top() -> None:
    Path("top.json").write_text(json.dumps(TOP_LIT))
    for ending in ("npy", "exr", "png"):
        assert lightbench("render", "top.json", *SMALL, "-o", f"a.{ending}") == 0
    for picture in (np.load("a.npy"), exr(Path("a.exr")), png("a.png")):
        assert picture[0].min() > 0.1
        assert picture[-1].max() == 0


def test_the_picture_is_named_after_the_scene() -> None:
    Path("scenes/lab").mkdir(parents=True)
    Path("scenes/lab/top.json").write_text(json.dumps(TOP_LIT))
    for arguments, name in (
        (("metals",), "metals.png"),
        (("scenes/lab/top.json",), "top.png"),
        (("lab/top", "--scenes", "scenes"), "top.png"),
    ):
        assert lightbench("render", *arguments, *SMALL) == 0
        assert Path(name).is_file()
        Path(name).unlink()


def test_invalid_pixels_are_said_aloud(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    bad = HALVED.replace("tonemap(vec3 radiance)", "brdf(Material m, vec3 l, vec3 v)")
    bad = bad.replace("0.5 * radiance", "vec3(-1.0)").replace(
        "vec3 b", '#include "lib/material.glsl"\nvec3 b'
    )
    shaders = copy_of_shaders(tmp_path, {"models/bad.glsl": bad})
    arguments = ("render", "box-room", *SMALL, "--set", "model=bad", "--shaders", str(shaders))
    assert lightbench(*arguments, "-o", "a.npy") == 0
    err = capsys.readouterr().err
    count = (np.load("a.npy") < 0).any(axis=2).sum()
    assert count > 100
    assert f"{count} negative pixels" in err
    assert "0 NaN" in err


# A person's own shaders


@pytest.mark.parametrize("how", ["group", "command", "environment"])
def test_own_shaders(
    how: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = str(copy_of_shaders(tmp_path, {"tonemaps/halved.glsl": HALVED}))
    before = ("--shaders", folder) if how == "group" else ()
    after = ("--shaders", folder) if how == "command" else ()
    if how == "environment":
        monkeypatch.setenv("LIGHTBENCH_SHADERS", folder)
    assert lightbench(*before, "options", *after) == 0
    assert "Halved" in capsys.readouterr().out
    settings = ("--set", "tonemap=halved", "--set", "transfer=linear")
    assert lightbench(*before, "render", "metals", *SMALL, *settings, *after, "-o", "a.png") == 0
    linear = lb.render("metals", (32, 24)).linear
    codes = png("a.png").astype(float)
    np.testing.assert_allclose(codes, np.clip(linear / 2, 0, 1) * 255, atol=0.51)


def test_the_option_stands_above_the_environment(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LIGHTBENCH_SHADERS", str(tmp_path / "none"))
    folder = str(copy_of_shaders(tmp_path, {"tonemaps/halved.glsl": HALVED}))
    assert lightbench("--shaders", folder, "options") == 0
    assert "Halved" in capsys.readouterr().out


# Listings


def test_listings_are_what_the_service_answers(capsys: pytest.CaptureFixture[str]) -> None:
    client = TestClient(create_app())
    for name in ("scenes", "options"):
        assert lightbench(name, "--json") == 0
        assert json.loads(capsys.readouterr().out) == client.get(f"/api/{name}").json()


def test_listings_for_a_person(capsys: pytest.CaptureFixture[str]) -> None:
    assert lightbench("scenes") == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == presets()
    assert lightbench("options") == 0
    out = capsys.readouterr().out
    assert "ggx" in out
    assert "Exposure: -10 to 10 stops, default 0" in out
    assert "camera" in out


@pytest.mark.parametrize(
    "arguments", [(), ("--help",), ("-h",), ("render", "--help"), ("--version",)]
)
def test_help(arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert lightbench(*arguments) == 0
    out, err = capsys.readouterr()
    assert "lightbench" in out
    assert err == ""


# Mistakes


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ("paint", "No such command 'paint'"),
        ("--nope", "--nope"),
        ("render", "Missing argument 'SCENE'"),
        ("render nope", "no scene 'nope'; there is: box-room"),
        ("render missing.json", "missing.json"),
        ("render .", "no scene '.'"),
        ("render model.glb", "no scene 'model.glb'; there is: box-"),
        ("render model.GLTF", "or a .json, .glb or .gltf file"),
        ("render bad.json", "bad.json: not a JSON file"),
        ("render empty.json", "empty.json: materials"),
        ("render deep.json", "deep.json: not a JSON file"),
        ("render bytes.json", "bytes.json: not a JSON file"),
        ("render digits.json", "digits.json: not a JSON file"),
        ("options --shaders bytes", "models/_choice.toml:1: is not UTF-8"),
        ("render box-room extra", "extra"),
        ("render box-room --size", "--size"),
        ("render box-room --size 640", "'640' is not WIDTHxHEIGHT"),
        ("render box-room --size 0x1", "size 0x1: each side is 1 to 16384"),
        ("render box-room --size -4x4", "'-4x4'"),
        ("render box-room --size 99999x1", "99999x1"),
        ("render box-room --set model", "'model' is not NAME=VALUE"),
        ("render box-room --set =phong", "'=phong' is not NAME=VALUE"),
        ("render box-room --set model=nope", "allowed are: blinn_phong"),
        ("render box-room --set nope=1", "no setting 'nope'; there is"),
        ("render box-room --set exposure=99", "from -10 to 10 stops"),
        ("render box-room --set camera.fov=wide", "camera.fov"),
        ("render box-room --set lights.nope.intensity=1", "lights: "),
        ("render box-room --view nope", "view: no 'nope'; allowed are: ambient"),
        ("render box-room -o a.jpg", "no format '.jpg'; allowed are: .png, .npy, .exr"),
        ("render box-room -o a", "no format ''"),
        ("render box-room -o nope/a.png", "nope/a.png: cannot be written"),
        ("render box-room -o folder.png", "folder.png: cannot be written"),
        ("render box-room -o ", "no format"),
        ("--shaders nope options", "Directory 'nope' does not exist"),
        ("options --shaders bad.json", "'bad.json' is a file"),
        ("scenes --scenes nope", "Directory 'nope' does not exist"),
        ("options --shaders broken", "_choice.toml:1"),
        ("serve --port 99999", "99999"),
        ("serve --port http", "http"),
        ("serve --host nowhere.invalid", "cannot listen on nowhere.invalid:8000"),
        ("serve --shaders broken", "_choice.toml:1"),
        ("bake", "Missing argument 'DIR'"),
        ("bake full", "full: holds files that `bake` did not make"),
        ("bake bad.json", "bad.json: is a file"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_line_and_exit_2(
    arguments: str, says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    (tmp_path / "bad.json").write_text("{")
    (tmp_path / "empty.json").write_text("{}")
    (tmp_path / "deep.json").write_text("[" * 100_000)
    (tmp_path / "digits.json").write_text("9" * 10_000)
    (tmp_path / "bytes.json").write_bytes(b"\xff")
    (tmp_path / "bytes/models").mkdir(parents=True)
    (tmp_path / "bytes/models/_choice.toml").write_bytes(b"\xff")
    (tmp_path / "broken/models").mkdir(parents=True)
    (tmp_path / "broken/models/_choice.toml").write_text("setting = 1\n")
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "full").mkdir()
    (tmp_path / "full/notes.txt").write_text("mine")
    (tmp_path / "web").mkdir()
    (tmp_path / "web/index.html").touch()
    monkeypatch.setattr("lightbench.bake.web_folder", lambda: tmp_path / "web")
    before = sorted(tmp_path.rglob("*"))
    assert says in refusal(capsys, *arguments.split(" "))
    assert sorted(tmp_path.rglob("*")) == before


def test_a_broken_shader_is_one_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    text = HALVED.replace("radiance;", "nothing;")
    folder = str(copy_of_shaders(tmp_path, {"tonemaps/halved.glsl": text}))
    line = refusal(capsys, "render", "metals", "--shaders", folder, "--set", "tonemap=halved")
    assert "tonemaps/halved.glsl:5: " in line
    assert "return 0.5 * nothing;" in line


def test_a_wrong_folder_in_the_environment(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LIGHTBENCH_SCENES", "nope")
    assert "Directory 'nope' does not exist" in refusal(capsys, "scenes")


def test_a_port_in_use(capsys: pytest.CaptureFixture[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        assert "already in use" in refusal(capsys, "serve", "--port", port)


def test_ctrl_c_ends_without_a_word(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(lb, "render_plan", interrupted)
    assert lightbench("render", "metals") == 130
    assert "".join(capsys.readouterr()).strip() == ""


# The doctor


def test_doctor_finds_what_the_tests_need(capsys: pytest.CaptureFixture[str]) -> None:
    code = lightbench("doctor")
    out = capsys.readouterr().out
    assert code == int("\nmissing" in out)
    for name in ("OpenGL", "RGBA32F renders", "Python", "moderngl", "playground", "Chromium"):
        assert name in out
    assert lb.render("metals", (8, 8)).renderer in out


def test_doctor_names_the_command_for_what_is_missing(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def broken() -> None:
        raise GraphicsError("no OpenGL context (libEGL.so.1: cannot open); run: lightbench doctor")

    monkeypatch.setattr(doctor, "renderer", broken)
    monkeypatch.setattr(doctor, "web_folder", lambda: tmp_path)
    monkeypatch.setattr(doctor, "CHROMIUM", ())
    requirements = ["absent-package>=1", "click>=8"]
    monkeypatch.setattr("importlib.metadata.requires", lambda _: requirements)
    assert lightbench("doctor") == 1
    lines = capsys.readouterr().out.splitlines()
    states = {line.split()[1]: line for line in lines}
    assert states["OpenGL"].startswith("missing")
    assert states["OpenGL"].endswith("sudo apt-get install -y libegl1 libgl1 libgl1-mesa-dri")
    assert states["playground"].endswith("run: make web/dist/index.html")
    assert states["package"].endswith("-m pip install 'absent-package>=1'")
    assert states["Chromium"].startswith("note")
    assert states["Chromium"].endswith("sudo apt-get install -y chromium")


# As a process


def test_a_mistake_as_a_process() -> None:
    done = subprocess.run([*COMMAND, "render", "nope"], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("lightbench: no scene 'nope'")
    assert done.stderr.count("\n") == 1


def test_a_reader_that_goes_away_is_no_error() -> None:
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(
        [*COMMAND, "options"], stdout=write, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(write)
    assert done.stderr == ""


@pytest.fixture
def server() -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        [*COMMAND, "serve", "--port", "0"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    with process:
        yield process
        process.kill()


def test_serve_answers_and_stops_on_ctrl_c(server: subprocess.Popen[str]) -> None:
    assert server.stdout is not None
    first = server.stdout.readline()
    assert first.startswith("Lightbench at http://127.0.0.1:")
    address = first.split()[2]
    with urllib.request.urlopen(f"{address}/healthz", timeout=30) as response:
        assert json.load(response)["status"] == "ok"
    url = f"{address}/api/render/box-room.png?model=phong&width=16&height=16"
    with urllib.request.urlopen(url, timeout=30) as response:
        assert response.read(4) == b"\x89PNG"
    server.send_signal(signal.SIGINT)
    out, err = server.communicate(timeout=30)
    assert (server.returncode, out.strip(), err) == (0, "", "")
