"""The display's gamma in the playground: by a meter, by eye, and put to use."""

import io
import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser import BACKENDS, COMMON, PATIENCE_MS, chromium
from tests.test_calibration_chart import CODES

Open = Callable[..., Locator]


@pytest.fixture
def open_dialog(browser: Browser, site: str) -> Iterator[Open]:
    """Open the dialog of a page of its own; an error that nobody caught fails the test."""
    errors: list[str] = []
    contexts = []

    def go(width: int = 760, height: int = 700, **options: Any) -> Locator:
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        context.set_default_timeout(PATIENCE_MS)
        contexts.append(context)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(f"{site}/#single-sphere")
        page.evaluate("window.lightbench.ready")
        return shown(page)

    yield go
    for context in contexts:
        context.close()
    assert errors == []


def shown(page: Page) -> Locator:
    page.get_by_role("button", name="Display", exact=True).click()
    dialog = page.get_by_role("dialog", name="Display gamma")
    expect(dialog).to_be_visible()
    return dialog


def measure(dialog: Locator, gamma: float, white: float = 120.0) -> None:
    """Type what a display of that gamma shines with."""
    for code in CODES:
        field = dialog.get_by_label(f"Luminance of level {code}", exact=True)
        field.fill(f"{white * (code / 255) ** gamma:.4f}")


def match(dialog: Locator, name: str, level: int) -> None:
    slider = dialog.get_by_label(f"{name} of white", exact=True)
    slider.evaluate(
        "(s, v) => { s.value = v; s.dispatchEvent(new Event('input', { bubbles: true })); }", level
    )


def pixels(of: Locator) -> NDArray[np.uint8]:
    """(H, W) red levels of an element as it is on the screen, in the device's pixels."""
    with Image.open(io.BytesIO(of.screenshot(scale="device"))) as picture:
        return np.asarray(picture.convert("RGB"))[..., 0]


def test_measured_with_a_meter(open_dialog: Open) -> None:
    """A display of gamma 2.4 is found to be one, and the picture is encoded for it."""
    dialog = open_dialog()
    page, says = dialog.page, dialog.get_by_role("status")
    apply = dialog.get_by_role("button", name="Encode the picture")
    expect(says).to_contain_text("No γ yet: type the luminances")
    expect(apply).to_be_disabled()
    before = page.evaluate("window.lightbench.link()")
    measure(dialog, 2.4)
    expect(says).to_contain_text("γ = 2.40")
    expect(says).to_contain_text("off by 0.0000 of white")
    row = dialog.get_by_role("row").filter(has=page.get_by_label("Luminance of level 127"))
    share = f"{(127 / 255) ** 2.4:.4f}"
    expect(row.get_by_role("cell").nth(1)).to_have_text(share)
    expect(row.get_by_role("cell").nth(2)).to_have_text(share)
    expect(dialog.locator(".curves canvas")).to_be_visible()
    assert page.evaluate("window.lightbench.link()") == before
    apply.click()
    expect(says).to_contain_text("encoded for a display of γ 2.40")
    link = page.evaluate("window.lightbench.link()")
    assert "transfer=gamma" in link
    assert "gamma=2.4" in link.split("&")
    dialog.get_by_role("button", name="Close").click()
    page.wait_for_function(
        "window.lightbench.programs().some(({ fragment }) => fragment.includes('u_gamma'))"
    )
    page.get_by_role("button", name="Undo").click()
    assert page.evaluate("window.lightbench.link()") == before


def test_matched_by_eye(open_dialog: Open) -> None:
    """One patch gives gamma = log share / log level; three are fitted together."""
    dialog = open_dialog()
    says = dialog.get_by_role("status")
    dialog.get_by_label("by eye").check()
    expect(says).to_contain_text("No γ yet: move a slider")
    expect(dialog.get_by_role("table").filter(has=dialog.page.locator("input"))).to_have_count(0)
    match(dialog, "Half", 186)
    one = math.log(0.5) / math.log(186 / 255)
    expect(says).to_contain_text(f"γ = {one:.2f}")
    expect(dialog.get_by_text(f"level 186, γ {one:.2f}")).to_be_visible()
    for name, share in (("A quarter", 0.25), ("Half", 0.5), ("Three quarters", 0.75)):
        match(dialog, name, round(255 * share ** (1 / 1.8)))
    expect(says).to_contain_text("γ = 1.80")
    dialog.get_by_role("button", name="Encode the picture for γ 1.80").click()
    link = dialog.page.evaluate("window.lightbench.link()")
    assert "transfer=gamma" in link
    gamma = next(part for part in link.split("&") if part.startswith("gamma="))
    assert abs(float(gamma.removeprefix("gamma=")) - 1.8) < 0.01


def test_by_keyboard(open_dialog: Open) -> None:
    """From the way of measuring to the picture without a pointer."""
    dialog = open_dialog()
    keyboard = dialog.page.keyboard
    dialog.get_by_label("with a luminance meter").focus()
    keyboard.press("ArrowRight")
    keyboard.press("Tab")
    for _ in range(12):
        keyboard.press("ArrowRight")
    expect(dialog.get_by_role("status")).to_contain_text("γ = ")
    expect(dialog.get_by_text("level 76, γ ")).to_be_visible()
    for _ in range(3):
        keyboard.press("Tab")
    expect(dialog.get_by_role("button", name="Encode the picture")).to_be_focused()
    keyboard.press("Enter")
    assert "transfer=gamma" in dialog.page.evaluate("window.lightbench.link()")
    keyboard.press("Escape")
    expect(dialog).to_have_count(0)


@pytest.fixture
def dense_page(browser: Browser, site: str, request: pytest.FixtureRequest) -> Iterator[Page]:
    """The playground on a screen of so many pixels per CSS pixel, which is not emulated."""
    screen = [f"--force-device-scale-factor={request.param}", "--window-size=800,700"]
    own = browser.browser_type.launch(
        executable_path=chromium(), args=[*COMMON, *BACKENDS["llvmpipe"], *screen]
    )
    page = own.new_page(no_viewport=True)
    page.goto(f"{site}/#single-sphere")
    page.evaluate("window.lightbench.ready")
    assert page.evaluate("devicePixelRatio") == request.param
    yield page
    own.close()


@pytest.mark.parametrize("dense_page", [1, 1.5, 2], indirect=True)
def test_no_pixel_is_scaled(dense_page: Page) -> None:
    """Lines of black and white alone, one row of the screen each, about a patch of the level."""
    dialog = shown(dense_page)
    dialog.get_by_label("by eye").check()
    for quarters, name in enumerate(("A quarter", "Half", "Three quarters"), 1):
        match(dialog, name, 100)
        canvas = dialog.get_by_role("img").nth(quarters - 1)
        canvas.scroll_into_view_if_needed()
        seen = pixels(canvas)
        size = canvas.evaluate("c => [c.height, c.width]")
        assert np.abs(np.subtract(seen.shape, size)).max() <= 2
        inside = seen[8:-8, 8:-8]
        assert set(np.unique(inside)) == {0, 100, 255}
        height, width = inside.shape
        rows = inside[: height // 8, 0]
        lines = {int(np.count_nonzero(rows[k : k + 4])) for k in range(len(rows) - 4)}
        assert lines == {quarters}
        assert (inside[height // 2, width // 3 : -width // 3] == 100).all()


def test_the_chart_covers_the_screen(open_dialog: Open) -> None:
    """The codes of the preset, in bars of one width; a key leaves it, and the dialog is there."""
    dialog = open_dialog()
    labels = dialog.get_by_role("textbox").evaluate_all("all => all.map((f) => f.ariaLabel)")
    assert labels == [f"Luminance of level {code}" for code in CODES]
    for leave in ("key", "click"):
        dialog.get_by_role("button", name="Show the chart").click()
        chart = dialog.page.get_by_role("dialog", name="Calibration chart")
        image = chart.get_by_role("img", name="Calibration chart: bars of levels 0, 63, 127")
        expect(image).to_be_visible()
        dialog.page.wait_for_function("document.querySelector('dialog.chart canvas').width > 700")
        seen = pixels(image)
        assert seen.shape == (700, 760)
        assert seen[350, 76::152].tolist() == CODES
        assert np.count_nonzero(np.diff(seen[350].astype(int))) == 4
        if leave == "key":
            dialog.page.keyboard.press("Space")
        else:
            image.click()
        expect(chart).to_have_count(0)
        expect(dialog).to_be_visible()


def test_what_was_typed_is_kept(open_dialog: Open) -> None:
    dialog = open_dialog()
    measure(dialog, 2.2)
    page = dialog.page
    page.reload()
    page.evaluate("window.lightbench.ready")
    dialog = shown(page)
    expect(dialog.get_by_role("status")).to_contain_text("γ = 2.20")
    expect(dialog.get_by_label("Luminance of level 255")).to_have_value("120.0000")


@pytest.mark.parametrize(
    ("typed", "says"),
    [
        ({255: "100"}, "too few points"),
        ({127: "20"}, "too few points"),
        ({63: "5", 127: "20"}, "no luminance at the top: the highest level is 127"),
        ({127: "bright", 255: "100"}, "level 127: its luminance nan must be finite"),
        ({127: "-3", 255: "100"}, "level 127: its luminance -3 must be"),
        ({127: "0", 255: "0"}, "every luminance is 0"),
        ({127: "21,9", 255: "100"}, "γ = 2.18"),
        ({127: "70", 255: "100"}, "γ = 0.51"),
    ],
)
def test_what_cannot_be_used(typed: dict[int, str], says: str, open_dialog: Open) -> None:
    """A mistake is said in place; a gamma that no picture is encoded for is not offered."""
    dialog = open_dialog()
    for level, text in typed.items():
        dialog.get_by_label(f"Luminance of level {level}", exact=True).fill(text)
    expect(dialog.get_by_role("status")).to_contain_text(says)
    apply = dialog.get_by_role("button", name="Encode the picture")
    if says.startswith("γ = 2"):
        expect(apply).to_be_enabled()
    else:
        expect(apply).to_be_disabled()
    if says == "γ = 0.51":
        expect(apply).to_have_text("Encode the picture for γ from 1 to 4")


def test_it_fits_a_telephone(open_dialog: Open) -> None:
    dialog = open_dialog(width=360, height=640)
    measure(dialog, 2.4)
    expect(dialog.locator(".curves canvas")).to_be_visible()
    for way in ("with a luminance meter", "by eye"):
        dialog.get_by_label(way).check()
        assert dialog.evaluate("d => d.scrollWidth <= d.clientWidth")
        assert dialog.page.evaluate("document.documentElement.scrollWidth") == 360
