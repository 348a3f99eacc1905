"""The REST service, through its routes."""

import io
import json
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
import OpenEXR
import pytest
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image as Pillow

import lightbench as lb
from lightbench import answers, api, bvh, errors, pictures
from lightbench.api import create_app
from lightbench.library import read_library
from lightbench.paths import scenes_folder, shaders_folder
from lightbench.render import on_gl_thread
from lightbench.scene import Camera
from lightbench.scene_file import scene_names
from lightbench.shapes import mesh
from tests.support import copy_of_shaders

SMALL = {"width": "32", "height": "24"}
PRESETS = scene_names(scenes_folder())
fuzz = settings(
    deadline=None, derandomize=True, max_examples=80,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)  # fmt: skip


@pytest.fixture(scope="module")
def client() -> Iterator[TestClient]:
    with TestClient(create_app()) as client:
        yield client


def message(response: Any, status: int) -> str:
    """The message of an error answer, whose shape is checked."""
    assert response.status_code == status, response.text
    error = response.json()["error"]
    assert set(error) == {"type", "message"}
    assert error["message"]
    return str(error["message"])


def npy(response: Any) -> np.ndarray[Any, Any]:
    assert response.status_code == 200, response.text
    return np.load(io.BytesIO(response.content))  # type: ignore[no-any-return]


# What there is


def test_scenes_lists_the_presets(client: TestClient) -> None:
    found = client.get("/api/scenes").json()
    assert sorted(found) == PRESETS
    assert all(set(scene) == {"title", "about"} and scene["title"] for scene in found.values())


@pytest.mark.parametrize("name", PRESETS)
def test_scene_is_the_preset_with_every_default(client: TestClient, name: str) -> None:
    assert client.get(f"/api/scenes/{name}").json() == lb.load(name).data()


@pytest.mark.parametrize("name", ["nope", "..%2Fpyproject", "%2e%2e%2fbox-room", "box-room.json"])
def test_scene_of_no_preset_is_404(client: TestClient, name: str) -> None:
    assert "box-room" in message(client.get(f"/api/scenes/{name}"), 404)


def test_a_path_is_no_scene_name(client: TestClient) -> None:
    path = (scenes_folder() / "box-room.json").resolve()
    for url in (f"/api/scenes/{path}", f"/api/render/{path}.png", f"/data/scenes{path}"):
        assert client.get(url).status_code == 404
    message(client.post("/api/render", json={"scene": str(path)}), 404)


def test_options_hold_every_file_and_parameter(client: TestClient) -> None:
    found = client.get("/api/options").json()
    library = read_library(shaders_folder())
    for name, folder in library.folders.items():
        choice = found["choices"][folder.setting]
        assert list(choice["allowed"]) == library.choices(name)
        assert choice["default"] == folder.default
    named = set(found["parameters"])
    for choice in found["choices"].values():
        named |= {key for item in choice["allowed"].values() for key in item["parameters"]}
    assert named == {key for file in library.files.values() for key in file.meta.parameters}
    assert found["scene"]["camera"] == list(Camera.model_fields)


def test_every_default_of_the_options_is_accepted(client: TestClient) -> None:
    found = client.get("/api/options").json()
    query = {name: choice["default"] for name, choice in found["choices"].items()}
    query |= {name: parameter["default"] for name, parameter in found["parameters"].items()}
    body = {"scene": "box-room", "settings": query, "width": 8, "height": 8}
    assert client.post("/api/render", json=body).status_code == 200


# Pictures


@pytest.mark.parametrize("name", PRESETS)
def test_png_is_a_picture_without_invalid_pixels(client: TestClient, name: str) -> None:
    response = client.get(f"/api/render/{name}.png", params=SMALL)
    assert response.status_code == 200
    assert response.headers["content-type"] == "image/png"
    assert response.headers["x-lightbench-invalid"] == "0"
    assert float(response.headers["x-lightbench-render-ms"]) > 0
    assert response.headers["x-lightbench-renderer"] == client.get("/healthz").json()["renderer"]
    picture = np.asarray(Pillow.open(io.BytesIO(response.content)))
    assert picture.shape == (24, 32, 3)
    assert picture.std() > 0


def test_npy_is_what_python_renders(client: TestClient) -> None:
    response = client.get("/api/render/box-room.npy", params=SMALL | {"model": "phong"})
    linear = npy(response)
    assert linear.dtype == np.float32
    np.testing.assert_array_equal(linear, lb.render("box-room", (32, 24), model="phong").linear)


def test_exr_holds_the_same_values(client: TestClient, tmp_path: Path) -> None:
    response = client.get("/api/render/box-room.exr", params=SMALL)
    assert response.headers["content-type"] == "image/x-exr"
    (tmp_path / "a.exr").write_bytes(response.content)
    with OpenEXR.File(str(tmp_path / "a.exr")) as file:
        pixels = file.channels()["RGB"].pixels
    np.testing.assert_array_equal(pixels, npy(client.get("/api/render/box-room.npy", params=SMALL)))


def test_size_defaults_to_640_by_480(client: TestClient) -> None:
    picture = Pillow.open(io.BytesIO(client.get("/api/render/single-sphere.png").content))
    assert picture.size == (640, 480)


def test_a_scene_s_own_size(client: TestClient) -> None:
    url = "/api/render/lab/sphere-intersection.npy"
    assert npy(client.get(url)).shape == (400, 500, 3)
    assert npy(client.get(url, params={"width": "50"})).shape == (400, 50, 3)


def test_a_scene_setting_changes_the_picture(client: TestClient) -> None:
    wide = npy(client.get("/api/render/box-room.npy", params=SMALL | {"camera.fov": "100"}))
    assert not np.array_equal(wide, npy(client.get("/api/render/box-room.npy", params=SMALL)))


def test_post_with_a_name_or_the_scene_is_the_get(client: TestClient) -> None:
    body = {"settings": {"model": "phong"}, "width": 32, "height": 24, "format": "npy"}
    expected = client.get("/api/render/metals.npy", params=SMALL | {"model": "phong"}).content
    scene = client.get("/api/scenes/metals").json()
    for given_scene in ("metals", scene):
        assert client.post("/api/render", json=body | {"scene": given_scene}).content == expected


def test_post_of_an_own_scene(client: TestClient) -> None:
    glow = {"materials": {}, "objects": {}, "background": [0.25, 0.5, 2.0]}
    body = {"scene": glow, "width": 3, "height": 2, "format": "npy"}
    linear = npy(client.post("/api/render", json=body))
    np.testing.assert_array_equal(linear, np.full((2, 3, 3), (0.25, 0.5, 2.0), np.float32))


# Refusals


@pytest.mark.parametrize(
    ("query", "says"),
    [
        ("model=nope", "allowed are: blinn_phong, cook_torrance"),
        ("nope=1", "there is: L_white"),
        ("exposure=1000", "exposure: '1000' is not a number from -10 to 10 stops"),
        ("exposure=", "exposure: ''"),
        ("exposure=nan", "exposure: 'nan'"),
        ("samples=1.5", "whole number"),
        ("camera.fov=500", "camera.fov"),
        ("camera.zoom=1", "allowed here are: eye, target, up, fov"),
        ("lights.nope.intensity=1", "lights: "),
        ("width=0", "width: Input should be greater than or equal to 1 (given '0')"),
        ("height=4097", "height: Input should be less than or equal to 4096"),
        ("width=wide", "width: "),
        ("width=4001&height=4000", "16.0 megapixels; at most 16"),
        ("width=4096&height=2048&samples=4", "16384x8192 values"),
        ("width=4096&height=1&samples=8", "32768x8 values; sides to 16384"),
        ("model=phong&model=phong", "model: is given more than once"),
        ("width=8&width=8", "width: is given more than once"),
    ],
)  # fmt: skip
def test_a_wrong_query_says_what_is_allowed(client: TestClient, query: str, says: str) -> None:
    assert says in message(client.get(f"/api/render/box-room.png?{query}"), 422)


def test_an_unknown_scene_or_format_or_route(client: TestClient) -> None:
    assert "box-room" in message(client.get("/api/render/nope.png"), 404)
    assert "'png', 'npy' or 'exr'" in message(client.get("/api/render/box-room.gif"), 422)
    assert "/docs" in message(client.get("/api/nope"), 404)
    assert "/docs" in message(client.post("/api/scenes"), 405)


@pytest.mark.parametrize(
    ("body", "says"),
    [
        ("{", "body"),
        ("[]", "valid dictionary"),
        ('{"width": 8}', "scene: Field required"),
        ('{"scene": "box-room", "size": 8}', "size: Extra inputs"),
        ('{"scene": "box-room", "width": 0}', "width"),
        ('{"scene": "box-room", "format": "gif"}', "format"),
        ('{"scene": "box-room", "settings": {"model": "nope"}}', "allowed are"),
        ('{"scene": "box-room", "settings": {"exposure": true}}', "exposure"),
        ('{"scene": {"objects": {}}}', "materials: Field required"),
        ('{"scene": {"materials": {}, "objects": {"a": {"shape": "egg"}}}}', "objects.a"),
        ('{"scene": {"materials": {}, "objects": {}, "units": "classic", "lights": []}}', "lights"),
        ('{"scene": "box-room", "settings": {"exposure": 1%s}}' % ("0" * 400), "exposure"),
        ('{"scene": "\\ud800"}', "no scene"),
    ],
)  # fmt: skip
def test_a_wrong_body_says_what_is_allowed(client: TestClient, body: str, says: str) -> None:
    headers = {"content-type": "application/json"}
    response = client.post("/api/render", content=body, headers=headers)
    assert says in message(response, 404 if "ud800" in body else 422)


def test_too_many_lights_are_refused(client: TestClient) -> None:
    lights = {f"l{i}": {"type": "directional"} for i in range(pictures.MAX_LIGHTS + 1)}
    scene = {"materials": {}, "objects": {}, "lights": lights}
    assert "allows 64" in message(client.post("/api/render", json={"scene": scene}), 422)


def test_every_error_class_has_a_status() -> None:
    declared = {errors.NotFoundError: 404, errors.GraphicsError: 503, answers.BusyError: 503}
    for kind in (getattr(errors, name) for name in errors.__all__ if name.endswith("Error")):
        nearest = next(answers.STATUS[k] for k in kind.__mro__ if k in answers.STATUS)
        assert nearest == declared.get(kind, 422)


def test_no_opengl_is_503(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> None:
        raise errors.GraphicsError("no OpenGL context; run: lightbench doctor")

    monkeypatch.setattr(pictures, "renderer", broken)
    for url in ("/api/render/box-room.png?width=31", "/data/thumbs/nope.png"):
        expected = 503 if "render" in url else 404
        message(client.get(url), expected)


def test_a_flaw_of_the_service_has_the_same_shape(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(api, "scenes", lambda _: 1 / 0)
    response = TestClient(create_app(), raise_server_exceptions=False).get("/api/scenes")
    assert "division" not in message(response, 500)


# Caching


def test_etag_gives_304_without_rendering(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = client.get("/api/render/box-room.png", params=SMALL)
    etag = first.headers["etag"]
    assert etag.startswith('"')
    assert first.headers["cache-control"] == "no-cache"
    monkeypatch.delattr(pictures, "renderer")
    for known in (etag, f'"other", {etag}', f"W/{etag}", "*"):
        again = client.get(
            "/api/render/box-room.png", params=SMALL, headers={"If-None-Match": known}
        )
        assert again.status_code == 304
        assert again.content == b""
        assert again.headers["etag"] == etag


def test_etag_follows_all_that_the_picture_depends_on(
    client: TestClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def etag(path: str = "box-room.png", **query: str) -> str:
        return client.get(f"/api/render/{path}", params=SMALL | query).headers["etag"]

    tags = {
        etag(), etag("metals.png"), etag("box-room.npy"), etag(model="phong"), etag(exposure="1"),
        etag(width="31"), etag(**{"camera.fov": "70"}),
    }  # fmt: skip
    assert len(tags) == 7
    assert etag(view="final") in tags
    shaders = copy_of_shaders(tmp_path, {})
    monkeypatch.setenv("LIGHTBENCH_SHADERS", str(shaders))
    assert etag() in tags
    file = shaders / "transfers/srgb.glsl"
    file.write_text(file.read_text() + "\nfloat unused() {\n    return 1.0;\n}\n")
    assert etag() not in tags


@pytest.mark.parametrize(
    "url",
    ["/api/scenes", "/api/scenes/box-room", "/api/options", "/data/manifest.json",
     "/data/thumbs/box-room.png", "/data/meshes/cube.bin", "/data/hierarchies/cube.bin"],
)  # fmt: skip
def test_other_answers_are_compared_too(client: TestClient, url: str) -> None:
    first = client.get(url)
    assert first.status_code == 200
    again = client.get(url, headers={"If-None-Match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


def test_hierarchies_are_what_rays_read(client: TestClient) -> None:
    found = client.get("/data/hierarchies/cube.bin")
    assert found.headers["content-type"] == "application/octet-stream"
    texels = np.frombuffer(found.content, "<i4").reshape(-1, 4)
    assert np.array_equal(texels, bvh.bake(mesh("cube")))


@pytest.mark.parametrize("key", ["cuboid", "mesh-0", "icosphere-99"])
def test_unknown_meshes_have_no_hierarchy(client: TestClient, key: str) -> None:
    found, other = (client.get(f"/data/{kind}/{key}.bin") for kind in ("hierarchies", "meshes"))
    assert found.status_code == other.status_code == 404
    assert found.json() == other.json()


def test_json_is_compressed_and_pictures_are_not(client: TestClient) -> None:
    accept = {"Accept-Encoding": "gzip"}
    assert client.get("/data/manifest.json", headers=accept).headers["content-encoding"] == "gzip"
    for ending in ("png", "npy", "exr"):
        response = client.get(f"/api/render/box-room.{ending}", params=SMALL, headers=accept)
        assert "content-encoding" not in response.headers


# The page and its description


def test_healthz(client: TestClient) -> None:
    found = client.get("/healthz").json()
    assert found["status"] == "ok"
    assert set(found) == {"status", "renderer", "version"}


def test_openapi_describes_every_route(client: TestClient) -> None:
    paths = client.get("/openapi.json").json()["paths"]
    assert sorted(paths) == [
        "/api/models", "/api/options", "/api/render", "/api/render/{name}.{format}", "/api/scenes",
        "/api/scenes/{name}", "/healthz",
    ]  # fmt: skip
    parameters = paths["/api/render/{name}.{format}"]["get"]["parameters"]
    assert {p["name"] for p in parameters} == {"name", "format", "width", "height", "settings"}
    assert client.get("/docs").status_code == 200


def test_without_a_built_page_the_service_says_how(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(api, "web_folder", lambda: tmp_path)
    page = TestClient(create_app()).get("/")
    assert page.status_code == 503
    assert "make play" in page.text


def test_the_built_page_is_served(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "index.html").write_text("<!doctype html><title>built</title>")
    (tmp_path / "assets").mkdir()
    (tmp_path / "assets/a.js").write_text("1")
    monkeypatch.setattr(api, "web_folder", lambda: tmp_path)
    page = TestClient(create_app())
    assert "built" in page.get("/").text
    assert page.get("/").headers["cache-control"] == "no-cache"
    assert page.get("/assets/a.js").status_code == 200
    assert page.get("/assets/../../etc/passwd").status_code == 404
    message(page.get("/assets/b.js"), 404)


# A person's own shaders


@pytest.fixture
def own_shaders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = copy_of_shaders(tmp_path, {})
    monkeypatch.setenv("LIGHTBENCH_SHADERS", str(folder))
    return folder


def tone_curve(body: str) -> str:
    return f'/*---\ntitle = "Mine"\n---*/\nvec3 tonemap(vec3 radiance) {{\n{body}\n}}\n'


def test_a_dropped_in_file_is_an_option_and_a_picture(
    client: TestClient, own_shaders: Path
) -> None:
    (own_shaders / "tonemaps/mine.glsl").write_text(tone_curve("  return vec3(0.0, 1.0, 0.0);"))
    assert "mine" in client.get("/api/options").json()["choices"]["tonemap"]["allowed"]
    response = client.get("/api/render/box-room.png", params=SMALL | {"tonemap": "mine"})
    pixels = np.asarray(Pillow.open(io.BytesIO(response.content)))
    np.testing.assert_array_equal(pixels, np.full((24, 32, 3), (0, 255, 0), np.uint8))


def test_a_broken_file_is_named_with_its_line(client: TestClient, own_shaders: Path) -> None:
    (own_shaders / "tonemaps/mine.glsl").write_text(tone_curve("  return radiance * nothing;"))
    response = client.get("/api/render/box-room.png", params=SMALL | {"tonemap": "mine"})
    assert "tonemaps/mine.glsl:5" in message(response, 422)
    assert client.get("/api/render/box-room.png", params=SMALL).status_code == 200


def test_invalid_pixels_are_counted(client: TestClient, own_shaders: Path) -> None:
    (own_shaders / "models/bad.glsl").write_text(
        '/*---\ntitle = "Bad"\n---*/\n#include "lib/material.glsl"\n'
        "vec3 brdf(Material m, vec3 l, vec3 v) {\n  return vec3(-1.0);\n}\n"
    )
    response = client.get("/api/render/box-room.png", params=SMALL | {"model": "bad"})
    assert int(response.headers["x-lightbench-invalid"]) > 100


# Many at once


def test_threads_get_the_bytes_that_one_gets(client: TestClient) -> None:
    urls = [
        f"/api/render/{name}.png?width={width}&height=24&model={model}"
        for name in PRESETS[:2] for width in (24, 32) for model in ("phong", "cook_torrance")
    ]  # fmt: skip
    alone = [client.get(url).content for url in urls]
    with ThreadPoolExecutor(8) as pool:
        together = list(pool.map(lambda url: client.get(url).content, urls * 4))
    assert together == alone * 4


def test_a_full_queue_is_503_and_health_still_answers(
    client: TestClient, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(api, "MAX_WAITING", 2)
    client.get("/healthz")
    free = threading.Event()
    with ThreadPoolExecutor(api.WORKERS + 6) as pool:
        try:
            pool.submit(on_gl_thread, free.wait)
            url = "/api/render/box-room.png?width=9&height=9"
            asked = [pool.submit(client.get, url) for _ in range(api.WORKERS + 5)]
            deadline = time.monotonic() + 20
            while sum(future.done() for future in asked) < 3 and time.monotonic() < deadline:
                time.sleep(0.01)
            assert client.get("/healthz").status_code == 200
        finally:
            free.set()
        responses = [future.result() for future in asked]
    busy = [response for response in responses if response.status_code != 200]
    assert len(busy) == 3
    for response in busy:
        message(response, 503)
        assert response.headers["retry-after"] == "1"


def test_readiness_does_not_wait_for_the_warm_up() -> None:
    free = threading.Event()
    with ThreadPoolExecutor(1) as pool:
        try:
            blocked = pool.submit(on_gl_thread, free.wait, 30)
            with TestClient(create_app()) as client:
                assert client.get("/api/scenes").status_code == 200
                assert not blocked.done()
                free.set()
        finally:
            free.set()


# Anything at all

SETTINGS = sorted({
    *(folder.setting for folder in read_library(shaders_folder()).folders.values()),
    *(name for f in read_library(shaders_folder()).files.values() for name in f.meta.parameters),
})  # fmt: skip
SCENE_SETTINGS = [
    "camera.fov", "camera.eye", "camera", "camera.", ".", "lights.key", "lights.key.intensity",
    "objects.sphere.position", "objects.cone.stacks", "materials.white.roughness", "settings.model",
]  # fmt: skip
VALUES = [
    "phong", "ggx", "none", "true", "0", "1", "-1", "2", "0.5", "1e400", "-0", "nan", "inf",
    "1e-30", "#ff8800", "1,2,3", "0,0,0", "auto", "[1]", "", " ", "9" * 400,
]  # fmt: skip
NAMES = st.sampled_from([*SETTINGS, *SCENE_SETTINGS]) | st.text(max_size=8)
QUERIES = st.dictionaries(NAMES, st.sampled_from(VALUES) | st.text(max_size=8), max_size=3)
SIDES = st.sampled_from(["1", "7", "16", "0", "-1", "4097", "x", "", "1e1", "9" * 400])
JSON = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.sampled_from([10**400, 2**63, -0.0, 1e308])
    | st.floats()
    | st.text(st.characters(), max_size=6)
    | st.sampled_from(["phong", "point", "spot", "classic", "cube", "#fff000"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=4,
)


def paths(value: object, prefix: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    if isinstance(value, dict):
        for key, inner in value.items():
            yield (*prefix, key)
            yield from paths(inner, (*prefix, key))


BOX_ROOM = lb.load("box-room").data()


@fuzz
@given(
    query=QUERIES, width=SIDES, height=SIDES, name=st.sampled_from(PRESETS) | st.text(max_size=5)
)
def test_any_query_is_a_picture_or_a_refusal(
    client: TestClient, query: dict[str, str], width: str, height: str, name: str
) -> None:
    sized = query | {"width": width, "height": height}
    response = client.get(f"/api/render/{quote(name)}.png", params=sized)
    if response.status_code != 200:
        message(response, response.status_code)
        assert response.status_code in (404, 422)


@fuzz
@given(path=st.sampled_from(sorted(paths(BOX_ROOM))), value=JSON)
def test_any_scene_is_a_picture_or_a_refusal(
    client: TestClient, path: tuple[str, ...], value: object
) -> None:
    scene = json.loads(json.dumps(BOX_ROOM))
    at = scene
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    body = json.dumps({"scene": scene, "width": 8, "height": 8})
    headers = {"content-type": "application/json"}
    response = client.post("/api/render", content=body, headers=headers)
    if response.status_code != 200:
        message(response, response.status_code)
        assert response.status_code in (400, 422)


@fuzz
@given(body=st.dictionaries(st.sampled_from(["scene", "settings", "width", "format", "x"]), JSON))
def test_any_body_is_a_picture_or_a_refusal(client: TestClient, body: dict[str, object]) -> None:
    content = json.dumps({"scene": "single-sphere", "width": 8, "height": 8} | body)
    headers = {"content-type": "application/json"}
    response = client.post("/api/render", content=content, headers=headers)
    if response.status_code != 200:
        message(response, response.status_code)
        assert response.status_code in (400, 404, 422)
