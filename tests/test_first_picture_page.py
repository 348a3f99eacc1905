"""The playground's first picture: `lightbench.ready` settles whatever comes, and the page rests."""

import json
import re
from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, Page, Route, expect

from tests.browser import PATIENCE_MS

Open = Callable[..., Page]
READY = "lightbench.ready.then(() => 'drawn', (error) => error.message)"
FRAMES = "Math.max(...Object.values(lightbench.runs()))"
# A clock of the GPU that is disturbed each time it is asked, so that no frame is ever timed.
DISTURBED = """
const extension = WebGL2RenderingContext.prototype.getExtension;
const parameter = WebGL2RenderingContext.prototype.getParameter;
Object.assign(WebGL2RenderingContext.prototype, {
  getExtension(name) {
    if (name !== 'EXT_disjoint_timer_query_webgl2') return extension.call(this, name);
    return { TIME_ELAPSED_EXT: 0x88bf, GPU_DISJOINT_EXT: 0x8fbb };
  },
  getParameter(name) { return name === 0x8fbb ? true : parameter.call(this, name); },
  beginQuery() {}, endQuery() {}, getQueryParameter() { return 1; },
});
"""


@pytest.fixture
def open_page(browser: Browser, site: str) -> Iterator[Open]:
    """Open the playground after some preparation, ready or not; no error may go uncaught."""
    context = browser.new_context(viewport={"width": 500, "height": 400})
    context.set_default_timeout(PATIENCE_MS)
    errors: list[str] = []

    def go(before: Callable[[Page], None], link: str = "#single-sphere") -> Page:
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        before(page)
        page.goto(f"{site}/{link}")
        return page

    yield go
    context.close()
    assert errors == []


def broken_model(route: Route) -> None:
    """The manifest with a model that does not compile."""
    data = route.fetch().json()
    file = data["files"]["models/lambert.glsl"]
    file["code"] = file["code"].replace("m.base_color", "m.no_such_color")
    route.fulfill(body=json.dumps(data), content_type="application/json")


def test_ready_tells_of_a_shader_that_does_not_compile(open_page: Open) -> None:
    page = open_page(
        lambda page: page.route("**/manifest.json", broken_model), "#single-sphere&model=lambert"
    )
    reason = page.evaluate(READY)
    assert re.search(r"models/lambert\.glsl:\d+: .*no_such_color", reason)
    expect(page.locator("#notices .failure")).to_have_text(reason)


@pytest.mark.parametrize(
    ("before", "reason"),
    [
        (lambda page: page.route("**/manifest.json", lambda r: r.abort()), "manifest.json could"),
        (
            lambda page: page.add_init_script(
                "HTMLCanvasElement.prototype.getContext = () => null"
            ),
            "WebGL2 is missing",
        ),
    ],
)
def test_ready_tells_of_a_page_that_cannot_start(
    open_page: Open, before: Callable[[Page], None], reason: str
) -> None:
    page = open_page(before)
    assert reason in page.evaluate(READY)
    expect(page.locator("#frame .fatal")).to_contain_text(reason)


def test_frames_that_are_never_timed_are_not_drawn_forever(open_page: Open) -> None:
    page = open_page(lambda page: page.add_init_script(DISTURBED))
    assert page.evaluate(READY) == "drawn"
    page.wait_for_timeout(4000)
    drawn = page.evaluate(FRAMES)
    assert 1 < drawn < 15
    page.wait_for_timeout(1500)
    assert page.evaluate(FRAMES) == drawn


def test_cheap_frames_are_drawn_until_their_median_means_something(open_page: Open) -> None:
    page = open_page(lambda _: None)
    assert page.evaluate(READY) == "drawn"
    expect(page.locator("#line .source")).to_contain_text("median of 3")
