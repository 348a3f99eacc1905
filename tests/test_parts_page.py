"""The robot in the playground: a slider for every joint, nothing compiled while one turns."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

import lightbench as lb
from tests.browser import PATIENCE_MS, render_in

JOINTS = ("Neck", "Left shoulder", "Left elbow", "Right shoulder", "Right elbow",
          "Left hip", "Left knee", "Right hip", "Right knee")  # fmt: skip
SHOULDER = "parts.right_shoulder.rotation"
# Counts the programs that a page links.
COUNTING = """
window.linked = 0;
const link = WebGL2RenderingContext.prototype.linkProgram;
WebGL2RenderingContext.prototype.linkProgram = function (program) {
    window.linked += 1;
    link.call(this, program);
};
"""


@pytest.fixture
def open_page(browser: Browser, site: str) -> Iterator[Callable[[str], Page]]:
    """Open the playground at a link; an error on the page that nobody caught fails the test."""
    context = browser.new_context(viewport={"width": 760, "height": 480})
    context.set_default_timeout(PATIENCE_MS)
    context.add_init_script(COUNTING)
    errors: list[str] = []

    def go(link: str) -> Page:
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        page.goto(f"{site}/{link}")
        page.evaluate("window.lightbench.ready")
        return page

    yield go
    context.close()
    assert errors == []


def settings(page: Page) -> dict[str, str]:
    """What the page's link holds now."""
    _, _, link = page.evaluate("window.lightbench.link()").partition("#")
    return dict(part.split("=", 1) for part in link.split("&")[1:])


def joint(page: Page, name: str) -> Locator:
    """The slider of a joint in the fold of all joints."""
    return page.locator("[data-group=joints]").get_by_role("slider", name=name, exact=True)


def test_a_slider_for_every_joint_and_a_fold_for_every_part(open_page: Any) -> None:
    page = open_page("#lab/robot")
    expect(page).to_have_title("A robot of matrices · Lightbench")
    expect(page.get_by_role("tab")).to_have_text(["Parts", "Picture"])
    for name in JOINTS:
        expect(joint(page, name)).to_be_visible()
    folds = page.locator("#page-parts [data-group^='parts.']")
    assert folds.count() == len(lb.load("lab/robot").parts)
    expect(joint(page, "Dial")).to_have_attribute("aria-valuetext", "0 °")


def test_a_joint_that_turns_changes_the_picture_and_compiles_nothing(open_page: Any) -> None:
    page = open_page("#lab/robot")
    before, linked = page.locator("#picture").screenshot(), page.evaluate("window.linked")
    assert linked > 0
    box = joint(page, "Right shoulder").bounding_box()
    assert box is not None
    y, left, width = box["y"] + box["height"] / 2, box["x"], box["width"]
    page.mouse.move(left + 0.55 * width, y)
    page.mouse.down()
    for share in (0.6, 0.65, 0.7):
        page.mouse.move(left + share * width, y)
        page.wait_for_function("window.lightbench.link().includes('right_shoulder')")
    page.mouse.up()
    turned = float(settings(page)[SHOULDER])
    assert 50 < turned < 100
    page.wait_for_timeout(500)
    assert page.locator("#picture").screenshot() != before
    assert page.evaluate("window.linked") == linked
    page.keyboard.press("Control+z")
    assert settings(page) == {}


def test_a_radius_is_one_slider(open_page: Any) -> None:
    """Both factors of a circle go together, also where a link gives one for both."""
    page = open_page("#lab/robot&parts.dial.scale=0.08")
    page.locator("[data-group='parts.dial'] > button").click()
    slider = page.locator("[data-group='parts.dial']").get_by_role("slider", name="Radius")
    expect(slider).to_have_attribute("aria-valuetext", "0.08")
    slider.focus()
    page.keyboard.press("ArrowRight")
    x, y = settings(page)["parts.dial.scale"].split(",")
    assert float(x) == float(y) > 0.08


def test_a_tab_without_content_gives_way_and_comes_back(open_page: Any) -> None:
    page = open_page("#box-room")
    chosen = page.locator("[role=tab][aria-selected=true]")
    expect(chosen).to_have_text("Model")
    page.evaluate("location.hash = '#lab/robot'")
    expect(chosen).to_have_text("Parts")
    page.evaluate("location.hash = '#box-room'")
    expect(chosen).to_have_text("Model")


def test_a_flat_scene_offers_no_camera_and_none_moves(open_page: Any) -> None:
    page = open_page("#box-room")
    modes, hint = page.locator("#modes"), page.locator("#hint")
    expect(modes).to_be_visible()
    expect(hint).to_be_visible()
    page.evaluate("location.hash = '#lab/robot'")
    expect(modes).to_be_hidden()
    expect(hint).to_be_hidden()
    picture = page.locator("#picture")
    expect(picture).to_have_attribute("aria-label", "The picture")
    box = picture.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 100, box["y"] + 100)
    page.mouse.wheel(0, 200)
    page.mouse.down()
    page.mouse.move(box["x"] + 160, box["y"] + 130, steps=4)
    page.mouse.up()
    for key in ("ArrowLeft", "+", "f", "w", "Home"):
        page.keyboard.press(key)
    page.wait_for_timeout(500)
    assert settings(page) == {}
    expect(page.locator("#walk-hint")).to_be_hidden()
    page.keyboard.press("Control+z")  # nothing was done but to come here
    expect(page).to_have_title("Box room · Lightbench")
    expect(modes).to_be_visible()
    expect(hint).to_be_visible()
    expect(page.locator("#orbit")).to_have_attribute("aria-pressed", "true")


def test_the_same_robot_in_the_browser(open_page: Any) -> None:
    """Bit by bit what the offline renderer draws."""
    page, size = open_page("#lab/robot"), (160, 120)
    for chosen in ({}, {SHOULDER: 80, "samples": 2, "parts.head.rotation": 12.5}):
        offline = lb.render("lab/robot", size, **chosen)
        linear, display, _ = render_in(page, "lab/robot", chosen, size)
        assert np.array_equal(linear, offline.linear)
        assert np.array_equal(display, offline.display)
