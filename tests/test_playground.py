"""The playground in a browser: picture, panel, state, hands and honest instruments."""

import json
import re
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, Route, ViewportSize, expect

from tests.browser import PATIENCE_MS

Open = Callable[..., Page]
# A software rasteriser on a busy machine needs a while for a frame.
SIZE: ViewportSize = {"width": 760, "height": 480}
ROUGHNESS = "materials.sphere.roughness"


@pytest.fixture
def open_page(browser: Browser, site: str) -> Iterator[Open]:
    """Open the playground at a link; an error on the page that nobody caught fails the test."""
    context = browser.new_context(viewport=SIZE)
    context.set_default_timeout(PATIENCE_MS)
    errors: list[str] = []

    def go(
        link: str = "", ready: bool = True, before: Callable[[Page], None] | None = None
    ) -> Page:
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        if before:
            before(page)
        page.goto(f"{site}/{link}")
        if ready:
            page.evaluate("window.lightbench.ready")
        return page

    yield go
    context.close()
    assert errors == []


def drag(page: Page, dx: int, dy: int, button: Any = "left") -> None:
    """Drag across the picture from its middle."""
    box = page.locator("#picture").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down(button=button)
    page.mouse.move(x + dx / 2, y + dy / 2)
    page.mouse.move(x + dx, y + dy)
    page.mouse.up(button=button)


def settings(page: Page) -> dict[str, str]:
    """What the page's link holds now."""
    _, _, link = page.evaluate("window.lightbench.link()").partition("#")
    return dict(part.split("=", 1) for part in link.split("&")[1:])


def row(page: Page, name: str, tab: str = "model") -> Locator:
    """The widget of a setting in the tab that is open."""
    return page.locator(f'#page-{tab} [data-control*="{name}"]')


def test_the_first_picture_comes_with_its_cost(open_page: Open) -> None:
    page = open_page()
    line = page.locator("#line")
    expect(line).to_contain_text(re.compile(r"\d ms"))
    expect(line).to_contain_text(re.compile("GPU timer|wall clock"))
    expect(line).to_contain_text("llvmpipe")
    expect(line).to_contain_text("triangles")
    expect(line).to_contain_text("2 passes")
    expect(page.locator("#summary")).to_contain_text("Cook-Torrance · GGX")
    expect(page).to_have_title("Box room · Lightbench")
    assert settings(page) == {}


def test_dragging_orbits_and_one_undo_takes_it_back(open_page: Open) -> None:
    page = open_page("#single-sphere")
    drag(page, 100, 0)
    once = settings(page)["camera.eye"]
    x, y, z = map(float, once.split(","))
    assert page.url.endswith(f"#single-sphere&camera.eye={once}")
    assert x < -0.5
    assert y == 0
    assert (x * x + z * z) ** 0.5 == pytest.approx(4.2, rel=1e-3)
    drag(page, 0, 60)
    assert float(settings(page)["camera.eye"].split(",")[1]) > 0.5
    page.keyboard.press("Control+z")
    assert settings(page) == {"camera.eye": once}
    page.keyboard.press("Control+z")
    assert settings(page) == {}
    page.keyboard.press("Control+Shift+Z")
    assert settings(page) == {"camera.eye": once}


def test_wheel_keys_and_right_drag_move_the_camera(open_page: Open) -> None:
    page = open_page("#single-sphere")
    page.locator("#picture").hover()
    page.mouse.wheel(0, -200)
    assert float(settings(page)["camera.eye"].split(",")[2]) < 4
    page.keyboard.press("Home")
    page.wait_for_function("!window.lightbench.link().includes('camera')")
    page.keyboard.press("ArrowRight")
    assert float(settings(page)["camera.eye"].split(",")[0]) > 0
    page.keyboard.press("Home")
    page.wait_for_function("!window.lightbench.link().includes('camera')")
    drag(page, 60, 0, button="right")
    assert set(settings(page)) == {"camera.eye", "camera.target"}
    assert float(settings(page)["camera.target"].split(",")[0]) < 0


def test_a_choice_changes_formula_controls_and_link(open_page: Open) -> None:
    page = open_page()
    panel = page.locator("#page-model")
    expect(panel.locator(".formula .katex").first).to_be_visible()
    expect(panel).to_contain_text("Walter et al. 2007, eq. 33")
    expect(page.get_by_label("Distribution D", exact=True)).to_be_visible()
    page.get_by_label("Lighting model", exact=True).select_option("phong")
    expect(panel).to_contain_text("Phong 1975")
    expect(panel.locator('[data-group="model"] .katex')).to_contain_text("max")
    expect(page.get_by_label("Distribution D", exact=True)).to_have_count(0)
    expect(row(page, "materials.sphere.shininess")).to_be_visible()
    expect(page.locator("#summary")).to_have_text("Phong")
    assert settings(page) == {"model": "phong"}
    assert "brdf" in page.evaluate("window.lightbench.programs()[0].fragment")


def test_each_choice_is_a_step_to_undo(open_page: Open) -> None:
    page = open_page("#single-sphere")
    model = page.get_by_label("Lighting model", exact=True)
    model.select_option("phong")
    model.select_option("lambert")
    expect(page.locator("#summary")).to_have_text("Lambert")
    page.get_by_role("button", name="Undo").click()
    expect(model).to_have_value("phong")
    page.get_by_role("button", name="Redo").click()
    expect(model).to_have_value("lambert")


def test_sharing_copies_the_link(open_page: Open) -> None:
    page = open_page("#metals&model=phong")
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.get_by_role("button", name="Share").click()
    expect(page.locator("#notices")).to_contain_text("on the clipboard")
    assert page.evaluate("navigator.clipboard.readText()") == page.url


def test_the_sources_are_those_that_run(open_page: Open) -> None:
    page = open_page("#single-sphere&model=phong")
    page.get_by_role("button", name="GLSL").click()
    dialog = page.get_by_role("dialog", name="GLSL of this picture")
    expect(dialog.locator(".gutter")).to_contain_text("models/phong.glsl:")
    shown = dialog.locator(".code").inner_text()
    assert shown.strip() in page.evaluate(
        "window.lightbench.programs().map((program) => program.fragment.trim())"
    )
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)


def test_shadow_maps_are_drawn_again_only_when_something_moves(open_page: Open) -> None:
    page = open_page("#box-room&shadow=hard")
    runs = "window.lightbench.runs()"
    before = page.evaluate(runs)
    drag(page, 60, 0)
    page.wait_for_function(f"(n) => {runs}.forward > n", arg=before["forward"])
    assert page.evaluate(runs)["shadow_map"] == before["shadow_map"]
    page.evaluate("location.hash += '&objects.cube.position=0.1,0.5,0'")
    page.wait_for_function(f"(n) => {runs}.shadow_map > n", arg=before["shadow_map"])


def test_reload_restores_picture_and_panel(open_page: Open) -> None:
    page = open_page("#metals&model=blinn_phong&exposure=1&camera.fov=50")
    page.reload()
    page.evaluate("window.lightbench.ready")
    assert settings(page) == {"model": "blinn_phong", "exposure": "1", "camera.fov": "50"}
    expect(page.get_by_label("Lighting model", exact=True)).to_have_value("blinn_phong")
    page.get_by_role("tab", name="Picture").click()
    expect(page.get_by_role("slider", name="Exposure")).to_have_attribute(
        "aria-valuetext", "1 stops"
    )


def test_sliders_by_keyboard_number_and_reset(open_page: Open) -> None:
    page = open_page()
    slider = row(page, ROUGHNESS)
    slider.focus()
    page.keyboard.press("ArrowRight")
    assert settings(page) == {ROUGHNESS: "0.36"}
    page.keyboard.press("Shift+ArrowUp")
    assert settings(page) == {ROUGHNESS: "0.46"}
    page.keyboard.press("Backspace")
    assert settings(page) == {}
    field = page.locator("#page-model").get_by_role("textbox", name="Roughness")
    field.fill("0.755")
    field.press("Enter")
    assert settings(page) == {ROUGHNESS: "0.755"}
    page.locator("#page-model .lil-name", has_text="Roughness").dblclick()
    assert settings(page) == {}
    expect(field).to_have_value("0.35")


def test_a_formula_lights_the_symbol_of_the_slider_in_hand(open_page: Open) -> None:
    page = open_page()
    expect(page.locator("#page-model .formula .katex").first).to_be_visible()
    row(page, ROUGHNESS).focus()
    expect(page.locator('[data-group="distribution"] .lit').first).to_contain_text("α")


def test_lights_show_the_parameters_of_the_falloff_in_use(open_page: Open) -> None:
    page = open_page("#box-room&attenuation=polynomial")
    page.get_by_role("tab", name="Lights").click()
    c2 = row(page, "lights.lamp.c2", "lights")
    expect(c2).to_be_visible()
    c2.focus()
    page.keyboard.press("Shift+ArrowRight")
    assert settings(page)["lights.lamp.c2"] == "1.1"
    page.get_by_label("Falloff with distance", exact=True).select_option("inverse_square")
    expect(c2).to_have_count(0)
    expect(row(page, "lights.lamp.light_radius", "lights")).to_be_visible()


def test_a_material_is_taken_from_the_library(open_page: Open) -> None:
    page = open_page("#single-sphere&materials.surface.roughness=0.9")
    page.get_by_role("tab", name="Material").click()
    fold = page.locator('[data-group="materials.surface"]')
    library = fold.get_by_role("combobox", name="From the library")
    library.select_option("Copper")
    # What was set of the material before is copper's now.
    page.wait_for_function(
        "window.lightbench.link().endsWith('#single-sphere&materials.surface.library=copper')"
    )
    expect(fold).to_contain_text("Source: Rakic et al. 1998")
    expect(fold.get_by_role("textbox", name="Roughness")).to_have_value("0.32")
    expect(fold.get_by_label("Index η, red", exact=True)).to_have_count(0)
    page.get_by_role("tab", name="Model").click()
    page.get_by_label("Fresnel F", exact=True).select_option("conductor")
    page.get_by_role("tab", name="Material").click()
    expect(fold.get_by_role("textbox", name="Index η, green")).to_have_value("0.677")
    green = row(page, "materials.surface.eta/green", "material")
    green.focus()
    page.keyboard.press("ArrowRight")
    assert settings(page)["materials.surface.eta"] == "0.271,0.69,1.316"
    library.select_option("Its own values")
    page.wait_for_function("window.lightbench.link().endsWith('#single-sphere&fresnel=conductor')")


def test_views_stand_under_headings_and_lights_have_names(open_page: Open) -> None:
    page = open_page("#box-room&shadow=hard")
    page.get_by_role("tab", name="Picture").click()
    view = page.get_by_label("View", exact=True)
    headings = view.locator("optgroup").evaluate_all("all => all.map((one) => one.label)")
    assert set(headings) == {"The picture", "The surface, without lights", "Under the lights"}
    expect(view.locator("option", has_text="Overdraw")).to_have_attribute(
        "title", re.compile("shaded when nothing is hidden")
    )
    view.select_option("A light's depth")
    page.get_by_label("Light", exact=True).select_option("Spot")
    page.wait_for_function("window.lightbench.link().includes('depth_light=1')")


def test_auto_shows_the_derived_value_and_can_be_left(open_page: Open) -> None:
    page = open_page("#single-sphere&model=phong")
    auto = page.locator("#page-model").get_by_role("button", name="Shininess: auto")
    expect(auto).to_have_attribute("aria-pressed", "true")
    auto.click()
    assert settings(page)["materials.surface.shininess"] == "76.125"
    auto.click()
    assert settings(page) == {"model": "phong"}


@pytest.mark.parametrize(
    ("link", "sentence"),
    [
        ("#box-room&model=fong", "model: no 'fong'; allowed are: blinn_phong"),
        ("#box-room&modle=phong", "no setting 'modle'"),
        ("#box-room&exposure=99", "exposure: 99"),
        ("#box-room&camera.eye=1,2", "camera.eye"),
        ("#boxroom", "There is no scene 'boxroom'; there is: box-room"),
    ],
)
def test_a_wrong_link_is_a_sentence_and_a_picture(
    open_page: Open, link: str, sentence: str
) -> None:
    page = open_page(f"{link}&camera.fov=60" if "&" in link else link)
    expect(page.locator("#notices")).to_contain_text(sentence)
    assert settings(page) == ({"camera.fov": "60"} if "&" in link else {})
    page.get_by_role("button", name="Dismiss").click()
    expect(page.locator(".notice")).to_have_count(0)


def test_an_edited_address_is_followed(open_page: Open) -> None:
    page = open_page()
    page.evaluate("location.hash = '#metals&model=lambert'")
    expect(page.locator("#summary")).to_have_text("Lambert")
    expect(page).to_have_title("Metals · Lightbench")


def test_scenes_by_menu_and_key_keep_how_they_are_rendered(open_page: Open) -> None:
    page = open_page("#box-room&model=phong&camera.fov=60")
    page.get_by_role("button", name="Box room").click()
    page.get_by_role("button", name="Metals").click()
    expect(page).to_have_title("Metals · Lightbench")
    assert settings(page) == {"model": "phong"}
    page.keyboard.press("1")
    expect(page).to_have_title("Box room · Lightbench")
    page.keyboard.press("h")
    expect(page.locator("#panel")).to_be_hidden()


def test_presets_in_a_folder_have_links_and_a_heading(open_page: Open) -> None:
    page = open_page("#lab/shadows&exposure=1")
    expect(page).to_have_title("Shadows · Lightbench")
    page.get_by_role("button", name="Shadows").click()
    expect(page.get_by_role("dialog").locator("h3")).to_have_text("Lab")
    page.get_by_role("button", name="A checker on a sphere").click()
    expect(page).to_have_title("A checker on a sphere · Lightbench")
    assert page.evaluate("window.lightbench.link()").endswith("#lab/texture&exposure=1")


def test_a_mirrored_picture_follows_the_hand(open_page: Open) -> None:
    """What is under the pointer is found, and a drag to the right turns its front to the right."""
    page = open_page("#lab/shadows")
    box = page.locator("#picture").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] * 0.655, box["y"] + box["height"] / 2)
    expect(page.locator('[data-group="surface"]')).to_contain_text("Material: Green")
    drag(page, 40, 0)
    eye = settings(page)["camera.eye"].split(",")
    assert float(eye[0]) > 1


def test_a_click_shows_the_material_and_a_double_click_goes_there(open_page: Open) -> None:
    page = open_page("#metals")
    box = page.locator("#picture").bounding_box()
    assert box is not None
    cone = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.click(*cone)
    expect(page.locator('[data-group="surface"]')).to_contain_text("Material: Copper")
    page.wait_for_timeout(400)  # or the next two clicks would be three
    page.mouse.dblclick(*cone)
    page.wait_for_function("window.lightbench.link().includes('camera.target=0,0.765,')")


def test_the_server_draws_the_same_picture(open_page: Open) -> None:
    page = open_page("#single-sphere&model=blinn_phong&camera.eye=1,1,4")
    page.get_by_role("button", name="PNG from server").click()
    expect(page.locator(".verdict")).to_contain_text(re.compile(r"^All [\d\s]+ pixels are equal"))
    handle = page.get_by_role("slider", name="Wipe")
    handle.focus()
    page.keyboard.press("Shift+ArrowLeft")
    expect(handle).to_have_attribute("aria-valuenow", "40")


def test_static_files_say_what_the_comparison_needs(open_page: Open) -> None:
    def without_service(page: Page) -> None:
        page.route("**/api/**", lambda route: route.fulfill(status=404, body="no such file"))

    page = open_page("#single-sphere", before=without_service)
    button = page.get_by_role("button", name="PNG from server")
    button.click()
    expect(page.locator("#notices")).to_contain_text("lightbench serve")
    expect(button).to_have_attribute("aria-pressed", "false")


def test_invalid_pixels_are_counted(open_page: Open) -> None:
    def with_nan(route: Route) -> None:
        data = route.fetch().json()
        file = data["files"]["models/lambert.glsl"]
        file["code"] = file["code"].replace("m.base_color * INV_PI", "sqrt(-m.base_color)")
        route.fulfill(body=json.dumps(data), content_type="application/json")

    page = open_page(
        "#single-sphere&model=lambert",
        before=lambda page: page.route("**/manifest.json", with_nan),
    )
    expect(page.locator("#line .invalid")).to_contain_text(re.compile(r"[1-9][\d\s]* NaN pixels"))


@pytest.mark.parametrize(
    ("script", "sentence"),
    [
        ("HTMLCanvasElement.prototype.getContext = () => null", "WebGL2 is missing"),
        (
            "const get = WebGL2RenderingContext.prototype.getExtension;"
            "WebGL2RenderingContext.prototype.getExtension = function (name) {"
            " return name === 'EXT_color_buffer_float' ? null : get.call(this, name) }",
            "EXT_color_buffer_float is missing",
        ),
    ],
)
def test_a_browser_that_cannot_draw_says_so_in_place(
    open_page: Open, script: str, sentence: str
) -> None:
    page = open_page(ready=False, before=lambda page: page.add_init_script(script))
    expect(page.locator("#frame .fatal")).to_contain_text(sentence)


def test_a_lost_context_comes_back(open_page: Open) -> None:
    page = open_page("#single-sphere")
    page.evaluate(
        "window.lost = document.querySelector('#picture').getContext('webgl2')"
        ".getExtension('WEBGL_lose_context'); window.lost.loseContext()"
    )
    expect(page.locator("#notices")).to_contain_text("comes back by itself")
    page.evaluate("window.lost.restoreContext()")
    expect(page.locator(".notice")).to_have_count(0)
    drag(page, 40, 0)
    assert "camera.eye" in settings(page)


def test_everything_has_a_name_and_fits_a_telephone(open_page: Open) -> None:
    page = open_page("#single-sphere&model=phong&attenuation=polynomial")
    page.set_viewport_size({"width": 360, "height": 740})
    for tab in ("Model", "Lights", "Material", "Camera", "Picture"):
        page.get_by_role("tab", name=tab).click()
        nameless = page.evaluate(
            """() => [...document.querySelectorAll('button, input, select')]
              .filter((e) => e.offsetParent && !e.ariaLabel && !e.textContent.trim()
                && !document.getElementById(e.getAttribute('aria-labelledby'))?.textContent)
              .map((e) => e.outerHTML)"""
        )
        assert nameless == []
        assert page.evaluate("document.documentElement.scrollWidth") <= 360
    picture, panel = (page.locator(name).bounding_box() for name in ("#picture", "#panel"))
    assert picture is not None
    assert panel is not None
    assert panel["y"] >= picture["y"] + picture["height"]
