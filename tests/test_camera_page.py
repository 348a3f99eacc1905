"""The camera under a person's hands in a browser: orbit and walk, keys, mouse and touch, views."""

import json
import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, CDPSession, Page, Route, expect

from tests.browser import PATIENCE_MS

Open = Callable[..., Page]
SCENE = "#single-sphere"
EYE = (0.0, 0.0, 4.2)
# 0.3 of the scene's extent, which its farthest light makes 5 m.
METRES_PER_SECOND = 1.5


@pytest.fixture
def open_page(browser: Browser, site: str) -> Iterator[Open]:
    """Open the playground; an error on the page that nobody caught fails the test."""
    contexts: list[BrowserContext] = []
    errors: list[str] = []

    def go(link: str = SCENE, before: Callable[[Page], None] | None = None, **options: Any) -> Page:
        context = browser.new_context(viewport={"width": 760, "height": 480}, **options)
        contexts.append(context)
        context.set_default_timeout(PATIENCE_MS)
        page = context.new_page()
        page.on("pageerror", lambda error: errors.append(str(error)))
        if before:
            before(page)
        page.goto(f"{site}/{link}")
        page.evaluate("window.lightbench.ready")
        return page

    yield go
    for context in contexts:
        context.close()
    assert errors == []


def settings(page: Page) -> dict[str, str]:
    """What the page's link holds now."""
    _, _, link = page.evaluate("window.lightbench.link()").partition("#")
    return dict(part.split("=", 1) for part in link.split("&")[1:])


def camera(page: Page) -> tuple[list[float], list[float]]:
    """Eye and target of `single-sphere` as the link has them."""
    found = settings(page)
    eye, target = (
        [float(c) for c in found[name].split(",")] if name in found else list(otherwise)
        for name, otherwise in (("camera.eye", EYE), ("camera.target", (0.0, 0.0, 0.0)))
    )
    return eye, target


def view(page: Page) -> list[float]:
    """Unit vector from eye to target."""
    eye, target = camera(page)
    along = [t - e for e, t in zip(eye, target, strict=True)]
    return [c / math.hypot(*along) for c in along]


def walk(page: Page) -> None:
    """Change to walking by the switch."""
    page.get_by_role("button", name="Walk", exact=True).click()
    expect(page.get_by_role("button", name="Walk", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )


def middle(page: Page) -> tuple[float, float]:
    """A point of the window: the picture's middle."""
    box = page.locator("#picture").bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page: Page, dx: float, dy: float, button: Any = "left") -> None:
    """Drag across the picture from its middle."""
    x, y = middle(page)
    page.mouse.move(x, y)
    page.mouse.down(button=button)
    for share in (0.25, 0.5, 0.75, 1):
        page.mouse.move(x + dx * share, y + dy * share)
    page.mouse.up(button=button)


def rest(page: Page) -> None:
    """Until a burst of keys counts as ended."""
    page.wait_for_timeout(700)


TIMES = """() => {
  window.times = {};
  for (const kind of ['keydown', 'keyup']) window.addEventListener(kind, (event) => {
    if (!event.repeat) window.times[kind + event.code] = event.timeStamp;
  }, { capture: true });
}"""


def hold(page: Page, key: str, milliseconds: int) -> float:
    """Hold a key; how many seconds the page saw it held."""
    page.evaluate(TIMES)
    page.keyboard.down(key)
    page.wait_for_timeout(milliseconds)
    page.keyboard.up(key)
    code = f"Key{key.upper()}"
    seconds = page.evaluate(f"(window.times.keyup{code} - window.times.keydown{code}) / 1000")
    assert isinstance(seconds, float)
    return seconds


@pytest.mark.parametrize(
    ("key", "axis", "sign"),
    [("w", 2, -1), ("s", 2, 1), ("a", 0, -1), ("d", 0, 1), ("r", 1, 1), ("f", 1, -1)],
)
def test_each_key_moves_eye_and_target_its_way(
    open_page: Open, key: str, axis: int, sign: int
) -> None:
    page = open_page()
    page.keyboard.press("f")  # walk
    assert camera(page) == (list(EYE), [0, 0, 0])
    seconds = hold(page, key, 300)
    eye, target = camera(page)
    moved = [e - was for e, was in zip(eye, EYE, strict=True)]
    assert target == pytest.approx(moved, abs=1e-4)
    assert moved[axis] == pytest.approx(sign * METRES_PER_SECOND * seconds, rel=1e-2, abs=1e-3)
    assert [c for at, c in enumerate(moved) if at != axis] == [0, 0]


def test_a_slow_page_walks_as_far_in_a_second(open_page: Open) -> None:
    page = open_page()
    walk(page)
    page.context.new_cdp_session(page).send("Emulation.setCPUThrottlingRate", {"rate": 6})
    seconds = hold(page, "s", 900)
    eye, _ = camera(page)
    assert eye[2] - EYE[2] == pytest.approx(METRES_PER_SECOND * seconds, rel=2e-2)


def test_two_keys_are_no_faster_and_shift_is(open_page: Open) -> None:
    page = open_page()
    walk(page)
    page.keyboard.down("d")
    seconds = hold(page, "s", 300)
    page.keyboard.up("d")
    eye, _ = camera(page)
    both = (eye[2] - EYE[2]) * math.sqrt(2)
    assert both == pytest.approx(METRES_PER_SECOND * seconds, rel=0.02, abs=1e-3)
    page.keyboard.press("Home")
    page.wait_for_function("!window.lightbench.link().includes('camera')")
    page.keyboard.down("Shift")
    seconds = hold(page, "s", 300)
    page.keyboard.up("Shift")
    eye, _ = camera(page)
    fast = 3 * METRES_PER_SECOND * seconds
    assert eye[2] - EYE[2] == pytest.approx(fast, rel=0.02, abs=1e-3)


def test_the_mouse_turns_the_view_and_never_to_the_pole(open_page: Open) -> None:
    page = open_page()
    walk(page)
    drag(page, 80, 0)
    eye, _ = camera(page)
    assert eye == list(EYE)
    x, y, z = view(page)
    assert x > 0.2
    assert y == pytest.approx(0, abs=1e-4)
    assert z < 0
    for _ in range(4):
        drag(page, 0, -150)
        assert abs(view(page)[1]) < 0.995
    assert view(page)[1] > 0.99
    for _ in range(6):
        drag(page, 0, 150)
        assert abs(view(page)[1]) < 0.995
    assert view(page)[1] < -0.99


def test_forward_goes_where_the_mouse_has_turned_the_view(open_page: Open) -> None:
    page = open_page()
    walk(page)
    drag(page, 120, -60)
    ahead = view(page)
    seconds = hold(page, "w", 300)
    moved = [(e - was) / seconds for e, was in zip(camera(page)[0], EYE, strict=True)]
    assert moved == pytest.approx([c * METRES_PER_SECOND for c in ahead], rel=2e-2, abs=1e-2)


def test_a_walk_is_one_step_to_undo_and_so_is_a_look(open_page: Open) -> None:
    page = open_page()
    walk(page)
    drag(page, 90, 30)
    looked = settings(page)
    page.keyboard.down("w")
    page.keyboard.down("d")
    drag(page, 40, 0)  # looking while walking is part of the walk
    page.keyboard.up("w")
    page.wait_for_timeout(60)
    page.keyboard.up("d")
    rest(page)
    assert settings(page).keys() == {"camera.eye", "camera.target"}
    page.keyboard.press("Control+z")
    assert settings(page) == looked
    page.keyboard.press("Control+z")
    assert settings(page) == {}


@pytest.mark.parametrize(
    "event", ["window.dispatchEvent(new Event('blur'))", "document.querySelector('#help').click()"]
)
def test_what_takes_the_page_away_stops_the_walk(open_page: Open, event: str) -> None:
    page = open_page()
    walk(page)
    page.keyboard.down("s")
    page.wait_for_function("window.lightbench.link().includes('camera')")
    page.evaluate(event)
    page.wait_for_timeout(100)
    there = camera(page)
    page.wait_for_timeout(300)
    assert camera(page) == there
    page.keyboard.up("s")
    assert camera(page) == there


def test_letters_typed_in_a_field_move_nothing(open_page: Open) -> None:
    page = open_page()
    walk(page)
    field = page.locator("#page-model input[type=text]").first
    field.focus()
    hold(page, "w", 150)
    hold(page, "f", 50)
    assert settings(page) == {}
    page.keyboard.press("Escape")
    expect(page.get_by_role("button", name="Walk", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )


def test_f_enters_escape_leaves_but_not_from_a_dialog(open_page: Open) -> None:
    page = open_page()
    orbit = page.get_by_role("button", name="Orbit", exact=True)
    picture = page.locator("#picture")
    expect(orbit).to_have_attribute("aria-pressed", "true")
    page.keyboard.press("w")
    assert settings(page) == {}
    page.keyboard.press("f")
    expect(orbit).to_have_attribute("aria-pressed", "false")
    expect(page.locator("#walk-hint")).to_be_visible()
    expect(picture).to_have_attribute("aria-label", "The picture. W, A, S and D walk, R and F go"
        " up and down, drag or arrow keys turn the view, Escape ends.")  # fmt: skip
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Help")
    expect(dialog).to_contain_text("back to orbit")
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    expect(orbit).to_have_attribute("aria-pressed", "false")
    page.keyboard.press("Escape")
    expect(orbit).to_have_attribute("aria-pressed", "true")
    expect(page.locator("#walk-hint")).to_be_hidden()


def test_after_a_walk_the_orbit_is_about_what_is_seen(open_page: Open) -> None:
    page = open_page()
    walk(page)
    hold(page, "w", 400)
    eye, target = camera(page)
    assert target[2] < 0  # carried along, into the sphere
    page.keyboard.press("Escape")
    drag(page, 60, 0)
    _, target = camera(page)
    assert target == pytest.approx([0, 0, 1], abs=1e-3)  # the sphere's front
    rest(page)
    page.keyboard.press("Control+z")
    assert camera(page)[0] == eye


def touch(cdp: CDPSession, kind: str, *points: tuple[float, float]) -> None:
    """One touch event of all fingers that are down."""
    fingers = [{"x": x, "y": y, "id": at} for at, (x, y) in enumerate(points)]
    cdp.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})


def swipe(page: Page, *paths: tuple[tuple[float, float], tuple[float, float]]) -> None:
    """Move fingers from and to points that count from the picture's middle."""
    cdp = page.context.new_cdp_session(page)
    x, y = middle(page)
    for share in (0, 0.2, 0.4, 0.6, 0.8, 1):
        at = [
            (x + a[0] + (b[0] - a[0]) * share, y + a[1] + (b[1] - a[1]) * share) for a, b in paths
        ]
        touch(cdp, "touchMove" if share else "touchStart", *at)
    touch(cdp, "touchEnd")


def test_fingers_orbit_zoom_and_pan(open_page: Open) -> None:
    page = open_page(has_touch=True)
    swipe(page, ((0, 0), (80, 0)))
    eye, target = camera(page)
    assert eye[0] < -0.5
    assert target == [0, 0, 0]
    page.keyboard.press("Control+z")
    assert settings(page) == {}
    swipe(page, ((-30, 0), (-70, 0)), ((30, 0), (70, 0)))
    eye, target = camera(page)
    assert eye[2] == pytest.approx(4.2 * 30 / 70, rel=0.1)
    page.keyboard.press("Control+z")
    swipe(page, ((-40, 0), (-40, 60)), ((40, 0), (40, 60)))
    eye, target = camera(page)
    assert eye[1] == target[1]
    assert eye[1] > 0.2
    assert eye[2] == pytest.approx(4.2, rel=1e-2)


def test_one_finger_looks_and_two_walk(open_page: Open) -> None:
    page = open_page(has_touch=True)
    walk(page)
    swipe(page, ((0, 0), (60, -30)))
    x, y, _ = view(page)
    assert camera(page)[0] == list(EYE)
    assert x > 0.1
    assert y > 0.1
    page.keyboard.press("Control+z")
    assert settings(page) == {}
    swipe(page, ((-40, 0), (-40, -60)), ((40, 0), (40, -60)))
    eye, _ = camera(page)
    assert eye[2] < EYE[2] - 0.2
    assert eye[:2] == pytest.approx([0, 0], abs=1e-3)
    page.keyboard.press("Control+z")
    assert settings(page) == {}
    swipe(page, ((-40, 0), (20, 0)), ((40, 0), (100, 0)))
    eye, _ = camera(page)
    assert eye[0] > 0.2
    assert view(page) == pytest.approx([0, 0, -1], abs=1e-4)


def test_the_stick_walks_while_another_finger_looks(open_page: Open) -> None:
    page = open_page(has_touch=True)
    stick, up = page.locator(".stick"), page.get_by_role("button", name="Up", exact=True)
    expect(stick).to_be_hidden()
    walk(page)
    cdp = page.context.new_cdp_session(page)
    x, y = middle(page)
    touch(cdp, "touchStart", (x, y))  # a finger on the picture brings the stick
    touch(cdp, "touchEnd")
    expect(stick).to_be_visible()
    box = stick.bounding_box()
    assert box is not None
    thumb = box["x"] + box["width"] / 2, box["y"] + 4
    touch(cdp, "touchStart", thumb)
    touch(cdp, "touchStart", thumb, (x, y))
    for pixels in (10, 20, 40):
        touch(cdp, "touchMove", thumb, (x + pixels, y))
    page.wait_for_timeout(400)
    touch(cdp, "touchEnd")
    page.wait_for_timeout(100)
    there = camera(page)
    assert there[0][2] < EYE[2] - 0.1
    assert view(page)[0] > 0.1
    page.wait_for_timeout(200)
    assert camera(page) == there
    box = up.bounding_box()
    assert box is not None
    touch(cdp, "touchStart", (box["x"] + 10, box["y"] + 10))
    page.wait_for_timeout(200)
    touch(cdp, "touchEnd")
    page.wait_for_timeout(100)
    assert camera(page)[0][1] > there[0][1] + 0.1


def test_a_scene_is_as_it_was_left(open_page: Open) -> None:
    page = open_page()
    drag(page, 100, 20)
    left = settings(page)
    page.keyboard.press("1")
    expect(page).to_have_title("Box room · Lightbench")
    assert settings(page) == {}
    page.get_by_role("button", name="Box room").click()
    page.get_by_role("button", name="Single sphere").click()
    expect(page).to_have_title("Single sphere · Lightbench")
    assert settings(page) == left


def test_keys_held_into_another_scene_leave_its_camera_alone(open_page: Open) -> None:
    page = open_page()
    walk(page)
    page.keyboard.down("w")
    page.wait_for_function("window.lightbench.link().includes('camera')")
    page.keyboard.press("1")
    expect(page).to_have_title("Box room · Lightbench")
    page.wait_for_timeout(300)
    page.keyboard.up("w")
    assert settings(page) == {}


def with_camera(**changes: Any) -> Callable[[Page], None]:
    """Serve `single-sphere` with these fields of the scene in the place of its own."""

    def answer(route: Route) -> None:
        scene = route.fetch().json()
        for name, value in changes.items():
            scene[name] = {**scene[name], **value} if name == "camera" else value
        route.fulfill(body=json.dumps(scene), content_type="application/json")

    def before(page: Page) -> None:
        page.route("**/scenes/single-sphere.json", answer)

    return before


def test_the_camera_tab_offers_the_views_of_the_scene(open_page: Open) -> None:
    above = {"eye": [0, 4, 1], "target": [0, 0, 0], "up": [0, 1, 0], "fov": 30}
    page = open_page(before=with_camera(views={"from_above": above}))
    page.get_by_role("tab", name="Camera").click()
    menu = page.get_by_label("Seen from", exact=True)
    expect(menu.locator("option:checked")).to_have_text("The scene's view")
    menu.select_option("From above")
    page.wait_for_function("window.lightbench.link().includes('camera.eye=0,4,1')")
    assert settings(page) == {"camera.eye": "0,4,1", "camera.fov": "30"}
    expect(menu.locator("option:checked")).to_have_text("From above")
    drag(page, 50, 0)
    expect(page.locator(".lil-option", has=menu).locator(".lil-display")).to_have_text("Elsewhere")
    page.keyboard.press("Control+z")
    expect(menu.locator("option:checked")).to_have_text("From above")
    page.keyboard.press("Control+z")
    assert settings(page) == {}


def test_a_light_is_a_place_to_see_from(open_page: Open) -> None:
    page = open_page("#box-room")
    page.get_by_role("tab", name="Camera").click()
    camera = page.locator('[data-group="camera"]')
    menu = page.get_by_label("Seen from", exact=True)
    assert menu.locator("optgroup").evaluate_all("all => all.map((one) => one.label)") == [
        "Cameras",
        "Lights",
    ]
    expect(camera.get_by_role("slider")).not_to_have_count(0)
    menu.select_option("Light: Spot")
    page.wait_for_function("window.lightbench.link().endsWith('#box-room&camera.light=spot')")
    expect(camera).to_contain_text("Seen from the light")
    expect(camera.get_by_role("slider")).to_have_count(0)
    page.reload()
    page.evaluate("window.lightbench.ready")
    expect(menu.locator("option:checked")).to_have_text("Light: Spot")
    drag(page, 20, 0)  # leaves it from where it stands
    eye = settings(page)["camera.eye"]
    assert "camera.light" not in settings(page)
    spot = page.evaluate("fetch('data/scenes/box-room.json').then((answer) => answer.json())")
    place = spot["lights"]["spot"]["position"]
    assert [float(c) for c in eye.split(",")] == pytest.approx(place, abs=0.5)
    page.keyboard.press("Control+z")
    expect(menu.locator("option:checked")).to_have_text("Light: Spot")
    menu.select_option("The scene's view")
    page.wait_for_function("window.lightbench.link().endsWith('#box-room')")


def test_there_is_no_walking_without_perspective(open_page: Open) -> None:
    flat = with_camera(camera={"projection": "orthographic", "height": 3})
    page = open_page(before=flat)
    button = page.get_by_role("button", name="Walk", exact=True)
    expect(button).to_be_disabled()
    expect(button).to_have_attribute("title", "Walking needs a camera with perspective")
    page.keyboard.press("f")
    expect(page.get_by_role("button", name="Orbit", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )


def test_motion_that_is_not_welcome_is_left_out(open_page: Open) -> None:
    page = open_page(f"{SCENE}&camera.eye=0,3,3", reduced_motion="reduce")
    page.evaluate(
        "window.seen = []; setInterval(() => window.seen.push(window.lightbench.link()), 4)"
    )
    page.keyboard.press("Home")
    page.wait_for_function("!window.lightbench.link().includes('camera')")
    assert page.evaluate("new Set(window.seen).size") <= 2


def test_the_switch_fits_a_telephone(open_page: Open) -> None:
    page = open_page(has_touch=True, is_mobile=True)
    page.set_viewport_size({"width": 360, "height": 740})
    walk(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    picture = page.locator("#picture").bounding_box()
    assert picture is not None
    parts = ["#modes", ".stick", ".heights", "#walk-hint"]
    boxes = [page.locator(part).bounding_box() for part in parts]
    for box in boxes:
        assert box is not None
        assert box["x"] >= picture["x"]
        assert box["x"] + box["width"] <= picture["x"] + picture["width"]
        assert box["y"] >= picture["y"]
        assert box["y"] + box["height"] <= picture["y"] + picture["height"]
    for at, a in enumerate(boxes):
        for b in boxes[:at]:
            assert a is not None
            assert b is not None
            apart_x = a["x"] >= b["x"] + b["width"] or b["x"] >= a["x"] + a["width"]
            apart_y = a["y"] >= b["y"] + b["height"] or b["y"] >= a["y"] + a["height"]
            assert apart_x or apart_y
