"""The atlas in the playground: computed by the browser, the same as by `lightbench atlas`."""

import base64
from collections.abc import Iterator

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, Route, expect

import lightbench as lb
from lightbench import atlas_data
from lightbench.atlas import chart
from lightbench.sweep import points, sweep_of
from lightbench.sweep_arguments import arguments
from tests.browser import PATIENCE_MS, serving
from tests.support import library

MAPS = """async ([file, name, x, y]) => {
  const panels = await window.lightbench.atlas(file, name, x, y);
  const text = (array) => {
    let binary = '';
    for (const byte of new Uint8Array(array.buffer)) binary += String.fromCharCode(byte);
    return btoa(binary);
  };
  return panels.map((panel) => ({ ...panel, got: text(panel.got), want: null,
    ulp: text(panel.ulp), kind: text(panel.kind) }));
}"""


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """The playground; an error on it that nobody caught fails the test."""
    errors: list[str] = []
    with serving() as site:
        context = browser.new_context(viewport={"width": 760, "height": 700})
        context.set_default_timeout(PATIENCE_MS)
        found = context.new_page()
        found.on("pageerror", lambda error: errors.append(str(error)))
        found.goto(site)
        found.evaluate("window.lightbench.ready")
        yield found
        context.close()
    assert errors == []


def test_the_tab_maps_both_forms_on_this_gpu(page: Page) -> None:
    page.get_by_role("button", name="Atlas").click()
    dialog = page.get_by_role("dialog", name="Stability atlas")
    expect(dialog.locator("figure")).to_have_count(4)
    expect(dialog.get_by_role("status")).to_contain_text("computed on ANGLE")
    expect(dialog.get_by_role("status")).to_contain_text("llvmpipe")
    textbook, ours = (
        dialog.locator(f'figure[data-file$="{name}.glsl"][data-precision=float32] .summary')
        for name in ("ggx_textbook", "ggx")
    )
    expect(textbook).to_contain_text("not a valid value at")
    expect(textbook).to_contain_text("infinite")
    expect(ours).to_contain_text("every value is valid")
    expect(ours).not_to_contain_text("no right digit")
    dialog.get_by_role("img").first.focus()
    page.keyboard.press("ArrowRight")
    expect(dialog.locator(".inputs")).to_contain_text("α 0.0")
    expect(dialog.locator(".readout").first).to_contain_text("truth")
    expect(dialog.locator(".readout").first).to_contain_text("ULP")


def test_function_and_axes_are_chosen(page: Page) -> None:
    page.get_by_role("button", name="Atlas").click()
    page.get_by_label("Function").select_option(label="Smith for GGX: masking")
    page.get_by_label("x axis").select_option(label="n·l")
    labels = page.locator("figure").first.locator(".label")
    expect(labels).to_have_text(["n·v", "n·l"])
    page.get_by_label("y axis").select_option(label="n·l")
    expect(labels).to_have_text(["n·l", "n·v"])
    assert page.get_by_label("x axis").input_value() == "NoV"
    page.get_by_label("Function").select_option(label="Constant: ambient")
    expect(page.locator("figure")).to_have_count(2)


def test_without_a_server_it_says_what_to_run(page: Page) -> None:
    def gone(route: Route) -> None:
        route.fulfill(status=404, content_type="text/plain", body="none")

    page.route("**/data/atlas/**", gone)
    page.get_by_role("button", name="Atlas").click()
    expect(page.get_by_role("status").last).to_contain_text("Run `lightbench serve`")


@pytest.mark.parametrize(
    ("file", "function", "x", "y"),
    [
        ("distributions/ggx.glsl", "distribution", "alpha", "theta_h"),
        ("maskings/smith_ggx.glsl", "visibility", "NoL", "NoV"),
        ("models/cook_torrance.glsl", "brdfCos", "roughness", "delta"),
        ("tonemaps/reinhard_extended.glsl", "tonemap", "level", "L_white"),
        ("attenuations/polynomial.glsl", "attenuation", "distance", "c0"),
    ],
)
def test_the_browser_computes_what_python_does(
    file: str, function: str, x: str, y: str, page: Page
) -> None:
    """Every value bit for bit, and every figure of the comparison with the truth."""
    sweep = sweep_of(library(), file, function, x, y)
    values = points(sweep, atlas_data.SIZE)
    expected = chart(library(), sweep, atlas_data.SIZE)
    panels = page.evaluate(MAPS, [file, function, x, y])
    assert len(panels) == len(expected.panels)
    for panel in panels:
        precision = panel["precision"]["name"]
        given, settings = arguments(library(), sweep, panel["file"], values)
        want = lb.glsl.call(
            panel["file"], function, *given, settings=settings, half=precision == "half"
        )
        got = np.frombuffer(base64.b64decode(panel["got"]), np.float32).reshape(want.shape)
        nan = np.isnan(want)
        assert np.array_equal(np.isnan(got), nan)
        assert np.array_equal(got[~nan].view(np.uint32), want[~nan].view(np.uint32))
        twin = expected.panel(panel["file"], precision)
        kinds = np.frombuffer(base64.b64decode(panel["kind"]), np.uint8)
        assert np.array_equal(kinds, twin.kind.ravel())
        ulps = np.frombuffer(base64.b64decode(panel["ulp"]), np.float64)
        assert np.array_equal(ulps, twin.ulp.ravel())
        figures = twin.summary()
        shares = panel["shares"]
        found = {"median_ulp": panel["median"], "max_ulp": panel["largest"]}
        found |= {name: shares[name] for name in ("wrong", "nan", "inf", "negative")}
        assert found == pytest.approx(figures, rel=1e-12)
