"""Models of a person's own on the page: dropped, chosen, refused, compared, kept out of links."""

import base64
import io
import json
import re
import struct
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from PIL import Image
from playwright.sync_api import Browser, Page, Route, ViewportSize, expect

from lightbench import assets
from lightbench.api import create_app
from lightbench.gltf import Limits
from tests.browser import PATIENCE_MS, serving

Open = Callable[..., Page]
Files = dict[str, bytes]
SIZE: ViewportSize = {"width": 760, "height": 480}
# Larger than any model here, smaller than what the browser sends in one piece.
LIMITS = Limits(file_bytes=1 << 20)
DROP = """(files) => {
  const dataTransfer = new DataTransfer();
  for (const [name, content] of Object.entries(files)) {
    const bytes = Uint8Array.from(atob(content), (c) => c.charCodeAt(0));
    dataTransfer.items.add(new File([bytes], name));
  }
  for (const kind of ['dragenter', 'dragover', 'drop']) {
    const event = new DragEvent(kind, { dataTransfer, bubbles: true, cancelable: true });
    document.querySelector('#picture').dispatchEvent(event);
  }
}"""


@pytest.fixture(scope="module")
def site() -> Iterator[str]:
    """The address of a served playground."""
    with serving(create_app(LIMITS)) as address:
        yield address


@pytest.fixture
def open_page(browser: Browser, site: str) -> Iterator[Open]:
    """Open the playground at a link; an error on the page that nobody caught fails the test."""
    context = browser.new_context(viewport=SIZE)
    context.set_default_timeout(PATIENCE_MS)
    errors: list[str] = []

    def go(link: str = "#single-sphere") -> Page:
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(f"{site}/{link}")
        page.evaluate("window.lightbench.ready")
        return page

    yield go
    context.close()
    assert errors == []


def quad(color: str = "#3060a0") -> Files:
    """A square with an image on it, as three files that belong together."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    positions = b"".join(struct.pack("<3f", x, y, 0) for x, y in corners)
    uvs = b"".join(struct.pack("<2f", (x + 1) / 2, (1 - y) / 2) for x, y in corners)
    content = positions + uvs + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    image = io.BytesIO()
    Image.new("RGB", (4, 4), color).save(image, "PNG")
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
         "min": [-1, -1, 0], "max": [1, 1, 0]},
        {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
        {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
    ]  # fmt: skip
    spans = [(0, 48), (48, 32), (80, 12)]
    attributes = {"POSITION": 0, "TEXCOORD_0": 1}
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "sign"}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"uri": "maps/paint%20ed.png"}],
        "buffers": [{"uri": "sign.bin", "byteLength": len(content)}],
        "bufferViews": [{"buffer": 0, "byteOffset": a, "byteLength": b} for a, b in spans],
        "accessors": accessors,
    }
    return {
        "sign.gltf": json.dumps(document).encode(),
        "sign.bin": content,
        "paint ed.png": image.getvalue(),
    }


def alone(files: Files) -> Files:
    """The same model as one file."""
    document = json.loads(files["sign.gltf"])
    for table, name in (("buffers", "sign.bin"), ("images", "paint ed.png")):
        content = base64.b64encode(files[name]).decode()
        document[table][0]["uri"] = f"data:application/octet-stream;base64,{content}"
    return {"sign.gltf": json.dumps(document).encode()}


def binary(files: Files) -> Files:
    """The same model as a .glb."""
    text = alone(files)["sign.gltf"]
    text += b" " * (-len(text) % 4)
    chunk = struct.pack("<I4s", len(text), b"JSON") + text
    return {"sign.glb": struct.pack("<4s2I", b"glTF", 2, 12 + len(chunk)) + chunk}


def drop(page: Page, files: Files) -> None:
    """Drop files on the picture."""
    page.evaluate(DROP, {name: base64.b64encode(text).decode() for name, text in files.items()})


def shown(page: Page) -> bytes:
    """The picture on the page once nothing more is under way."""
    expect(page.locator("#progress")).to_be_hidden()
    expect(page.locator("#line")).to_contain_text("median of")  # it may take a line more by then
    return page.locator("#picture").screenshot(style="#notices, #hint { visibility: hidden }")


def scene(page: Page) -> str:
    """What the address names."""
    link: str = page.evaluate("window.lightbench.link()")
    return link.partition("#")[2]


def as_png(page: Page) -> Any:
    """A note below the server's picture: how many pixels differ."""
    page.get_by_role("button", name="PNG from server").click()
    return page.locator(".verdict")


@pytest.mark.parametrize("form", [lambda files: files, alone, binary])
def test_a_dropped_model_is_drawn_as_the_server_draws_it(
    open_page: Open, form: Callable[[Files], Files]
) -> None:
    page = open_page("#single-sphere&model=lambert")
    drop(page, form(quad()))
    expect(page).to_have_title("sign · Lightbench")
    expect(page.locator("#line")).to_contain_text("2 triangles")
    expect(page.locator("#summary")).to_have_text("Lambert")
    expect(page.locator("#notices")).to_contain_text("glTF model: 1 object, 2 triangles.")
    expect(as_png(page)).to_contain_text(" pixels are equal")


def test_a_click_on_a_mesh_shows_its_material(open_page: Open) -> None:
    page = open_page()
    drop(page, quad())
    expect(page).to_have_title("sign · Lightbench")
    shown(page)
    page.locator("#picture").click()
    expect(page.locator('[data-group="surface"]')).to_contain_text("On: Sign")


def test_no_link_leads_to_a_model(open_page: Open) -> None:
    page = open_page("#single-sphere&exposure=1")
    share = page.get_by_role("button", name="Share")
    drop(page, quad())
    expect(page).to_have_title("sign · Lightbench")
    expect(share).to_be_disabled()
    expect(share).to_have_attribute(
        "title", "No link leads to this picture: the model is a file of your own"
    )
    page.get_by_role("tab", name="Camera").click()
    page.locator('#page-camera input[type="range"]').first.press("ArrowRight")
    assert scene(page) == "single-sphere&exposure=1"
    page.get_by_role("button", name="Help").click()
    dialog = page.get_by_role("dialog", name="Help")
    expect(dialog).to_contain_text("lightbench render sign.gltf --set exposure=1")
    expect(dialog).not_to_contain_text("api/render")
    page.keyboard.press("Escape")
    page.reload()
    page.evaluate("window.lightbench.ready")
    expect(page).to_have_title("Single sphere · Lightbench")
    assert scene(page) == "single-sphere&exposure=1"
    expect(share).to_be_enabled()


def test_undo_keys_and_the_dialog_lead_away_and_back(open_page: Open) -> None:
    page = open_page()
    drop(page, quad())
    expect(page).to_have_title("sign · Lightbench")
    model = shown(page)
    page.keyboard.press("Control+z")
    expect(page).to_have_title("Single sphere · Lightbench")
    expect(page.get_by_role("button", name="Share")).to_be_enabled()
    page.keyboard.press("Control+Shift+z")
    expect(page).to_have_title("sign · Lightbench")
    page.keyboard.press("1")
    expect(page).to_have_title("Box room · Lightbench")
    assert scene(page) == "box-room"
    page.locator("#scene").click()
    page.get_by_role("dialog", name="Scenes").get_by_role("button", name="sign.gltf").click()
    expect(page).to_have_title("sign · Lightbench")
    expect(page.locator("#thumb")).to_have_attribute("src", re.compile("^data:"))
    assert shown(page) == model


def test_a_model_is_chosen_by_keyboard(open_page: Open) -> None:
    page = open_page()
    page.locator("#scene").click()
    button = page.get_by_role("button", name="Open a model")
    # The dialog takes the focus when it opens.
    expect(page.get_by_role("dialog")).to_be_visible()
    with page.expect_file_chooser() as chooser:
        button.press("Enter")
    files = [{"name": name, "mimeType": "", "buffer": content} for name, content in quad().items()]
    chooser.value.set_files(files)  # type: ignore[arg-type]
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(page).to_have_title("sign · Lightbench")


@pytest.mark.parametrize(
    ("files", "reason"),
    [
        ({"a.glb": b"glTF"}, "a.glb: "),
        ({"a.gltf": b"{"}, "a.gltf: "),
        ({"a.gltf": b'{"asset": {"version": "2.0"}}'}, "scene: has no triangle to show"),
        ({"sign.gltf": quad()["sign.gltf"]}, "refers to sign.bin and maps/paint%20ed.png, which"),
        ({"a.txt": b""}, "There is no model in a.txt: drop a .glb"),
        ({"a.glb": b"glTF" * (1 << 19)}, "is larger than the 1048576 bytes that are allowed"),
    ],
)
def test_a_refused_file_says_why_and_changes_nothing(
    open_page: Open, files: Files, reason: str
) -> None:
    page = open_page()
    before = shown(page)
    drop(page, files)
    notice = page.locator(".notice")
    expect(notice).to_contain_text(reason)
    assert "\n" not in notice.locator("p").inner_text()
    assert shown(page) == before
    expect(page).to_have_title("Single sphere · Lightbench")
    expect(page.get_by_role("button", name="Undo")).to_be_disabled()
    drop(page, quad())
    expect(notice).to_have_count(1)  # the next one takes the place of the last
    expect(notice).to_contain_text("glTF model")


def test_the_latest_of_two_drops_counts(open_page: Open) -> None:
    page = open_page()
    held: list[Route] = []
    arrived = threading.Event()

    def hold(route: Route) -> None:
        if held:
            route.continue_()
        held.append(route)
        arrived.set()

    page.route("**/api/models**", hold)
    drop(page, quad())
    progress = page.locator("#progress")
    expect(progress).to_have_attribute("aria-valuetext", "Uploading sign.gltf")
    expect(progress).to_have_text("Uploading sign.gltf")
    files = quad("#a03060")
    drop(page, {"other.gltf": alone(files)["sign.gltf"]})
    expect(page).to_have_title("other · Lightbench")
    expect(progress).to_be_hidden()
    expect(page.locator(".notice")).to_have_count(1)
    page.locator("#scene").click()
    expect(page.get_by_role("button", name="sign.gltf")).to_have_count(0)
    assert len(held) == 2


def test_behind_files_only_the_page_says_what_models_need(open_page: Open) -> None:
    page = open_page()
    page.route("**/api/**", lambda route: route.fulfill(status=405, content_type="text/html"))
    drop(page, quad())
    expect(page.locator(".notice")).to_contain_text(
        "There is no server behind this page, only files. Run `lightbench serve` and open the"
        " address that it prints to open models of your own."
    )


def test_a_model_that_the_server_lost_is_to_be_dropped_again(
    open_page: Open, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = open_page()
    drop(page, quad("#30a060"))
    expect(page).to_have_title("sign · Lightbench")
    shown(page)
    page.keyboard.press("6")
    expect(page).to_have_title("Single sphere · Lightbench")
    monkeypatch.setattr(assets, "_assets", type(assets._assets)())
    page.evaluate(
        "window.lost = document.querySelector('#picture').getContext('webgl2')"
        ".getExtension('WEBGL_lose_context'); window.lost.loseContext()"
    )
    expect(page.locator("#notices")).to_contain_text("comes back by itself")
    page.evaluate("window.lost.restoreContext()")
    expect(page.locator(".failure")).to_have_count(0)
    page.keyboard.press("Control+z")
    expect(page.locator(".failure")).to_contain_text(
        "The server no longer has sign.gltf: it was started anew, or newer models took the room."
    )
    drop(page, quad("#30a060"))
    expect(page.locator(".failure")).to_have_count(0)
    page.locator("#scene").click()
    expect(page.get_by_role("dialog").get_by_role("button", name="sign.gltf")).to_have_count(1)


def test_the_page_says_where_to_drop(open_page: Open) -> None:
    page = open_page()
    sign = page.locator("#drop")
    expect(sign).to_be_hidden()
    page.evaluate(
        """() => {
          const dataTransfer = new DataTransfer();
          dataTransfer.items.add(new File(['x'], 'a.glb'));
          const over = { dataTransfer, bubbles: true, cancelable: true };
          window.drag = () => document.body.dispatchEvent(new DragEvent('dragover', over));
          window.dragging = setInterval(window.drag, 100);
        }"""
    )
    expect(sign).to_be_visible()
    expect(sign).to_contain_text("Drop a model here")
    page.evaluate("clearInterval(window.dragging)")
    expect(sign).to_be_hidden()
