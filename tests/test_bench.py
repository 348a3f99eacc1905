"""What the benchmark of rays counts and compares; no time is measured to be judged."""

import math

import numpy as np
import pytest
from playwright.sync_api import Browser, Page

import lightbench as lb
from bench import mitsuba_rays, rays
from bench.mitsuba_rays import Ball, Triangles, shapes
from bench.offline import linear_only
from bench.rates import Costs, Row, growth, table
from bench.works import LEVELS, Work, ball, directions, hits, planned, settings, works
from lightbench.image import Image
from lightbench.plan_types import Plan
from lightbench.render import on_gl_thread, renderer

SIZE = (96, 64)


def drawn(made: Plan) -> Image:
    return on_gl_thread(lambda: renderer().run(made))


@pytest.mark.parametrize("level", LEVELS)
def test_the_ball_has_as_many_triangles_as_its_row_says(level: int) -> None:
    found = shapes(ball(level))["ball"]
    assert isinstance(found, Triangles)
    assert found.faces.shape == (20 * 4**level, 3)
    assert found.faces.max() == len(found.points) - 1
    lengths = np.linalg.norm(found.points, axis=1)
    np.testing.assert_allclose(lengths, 1, atol=1e-6)


def test_the_peer_gets_the_spheres_and_triangles_of_a_scene() -> None:
    found = shapes(lb.load("lab/shadows"))
    assert found["red_ball"] == Ball([0, 0, 0], 1.6)
    assert [type(shape) for shape in found.values()].count(Triangles) == 2
    wall = found["wall_left"]
    assert isinstance(wall, Triangles)
    np.testing.assert_array_equal(wall.points, [[5, 5, -5], [-5, 5, -5], [-5, -5, -5]])
    np.testing.assert_array_equal(wall.faces, [[0, 1, 2]])


def test_rays_that_meet_the_ball_are_as_many_as_its_disc_has_pixels() -> None:
    size = (256, 256)
    # From 3 m, a ball of 1 m reaches to tan = 1 / sqrt(8); the picture to tan 22.5 degrees.
    radius = size[1] / 2 / math.sqrt(8) / math.tan(math.radians(22.5))
    assert hits(ball(6), size) == pytest.approx(math.pi * radius**2, rel=5e-3)


def test_hits_are_the_pixels_whose_direction_meets_a_sphere() -> None:
    scene = lb.load("lab/sphere-intersection")
    eye = np.array(scene.camera.eye, float)
    found = directions(scene, SIZE).astype(float)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1, atol=1e-6)
    met = np.zeros(len(found), bool)
    for sphere in shapes(scene).values():
        assert isinstance(sphere, Ball)
        offset = np.array(sphere.center) - eye
        along = found @ offset
        met |= (along > 0) & (offset @ offset - along**2 < sphere.radius**2)
    assert hits(scene, SIZE) == pytest.approx(np.count_nonzero(met), abs=2)


def test_each_hit_sends_a_ray_to_each_lamp() -> None:
    found = {work.name: work for work in works(SIZE)}
    assert all(work.primary == SIZE[0] * SIZE[1] for work in found.values())
    assert found["lab/sphere-intersection"].shadow == 0
    mirror = found["lab/reflectance2"]
    assert mirror.shadow == 2 * hits(mirror.scene, SIZE) > 0
    assert found["81920 triangles"].shadow == hits(ball(6), SIZE) > 0


def test_the_linear_part_is_the_tracing_pass_and_gives_the_picture() -> None:
    made = planned(ball(0), SIZE, shadows=True)
    part = linear_only(made)
    assert [one["name"] for one in part["passes"]] == ["trace"]
    assert len(made["passes"]) > 1
    whole = drawn(made).linear
    drawn(planned(ball(0), SIZE, shadows=False))  # another picture in the same targets
    np.testing.assert_array_equal(drawn(part).linear, whole)


def test_shadow_rays_take_what_the_picture_takes_longer_with_them() -> None:
    answers = {(False, False): [5.0, 4.0, 90.0], (True, False): [7.0], (True, True): [9.0]}
    lit = Work("ball", ball(0), SIZE, 1000, 400, 20)
    made = rays.costs(lit, lambda *asked: answers[asked])
    assert made == {"primary": 5, "both": 7, "shadow": 2, "frame": 9}
    dark = lit._replace(shadow=0)
    assert rays.costs(dark, lambda *_: [3.0]) == {"primary": 3, "frame": 3}


def rows() -> list[Row]:
    """20 and 80 triangles: twice the time for primary rays, four times for both."""
    made = []
    for triangles, slow in ((20, 1.0), (80, 2.0)):
        work = Work(f"{triangles} triangles", ball(0), SIZE, 6000, 2000, triangles)
        shadow = 2.0 * (2 * slow - 1)
        ours: list[Costs] = [
            {"primary": 3 * slow, "shadow": shadow, "both": 4 * slow**2, "frame": 8 * slow}
        ] * 3
        peer: list[Costs] = [{"primary": 6 * slow, "shadow": 0.5, "both": 2 * slow}] * 3
        made.append(Row(work, {"ours": ours, "peer_rgb": peer}))
    return made


def test_a_row_has_rates_and_ratios() -> None:
    small, _ = rows()
    assert small.rates("ours", "primary") == pytest.approx([2, 2, 2])
    assert small.rates("ours", "shadow") == pytest.approx([1, 1, 1])
    assert small.rates("ours", "frame") == pytest.approx([1, 1, 1])
    assert small.ratio("ours", "peer_rgb", "primary") == pytest.approx(2)
    lines = table("Title", "ours", rows(), ["peer_rgb"]).splitlines()
    assert lines[0] == "Title"
    assert lines[2].split() == ["primary", "/", "peer", "both", "/", "peer", "shadow", "frame"]
    expected = "20 triangles 2 (2 to 2) 2.00 x 2 (2 to 2) 0.50 x 1 1"
    assert " ".join(lines[3].split()) == expected
    assert len(lines[4]) == len(lines[2])
    assert "frame" not in table("Title", "peer_rgb", rows())


def test_shadow_rays_that_took_no_time_have_no_rate() -> None:
    small, large = rows()
    lost: list[Costs] = [{"primary": 3, "both": 2, "shadow": -1, "frame": 8}] * 3
    row = Row(small.work, {"ours": lost})
    assert row.rates("ours", "shadow")[0] == math.inf
    lines = table("Title", "ours", [row, large]).splitlines()
    assert lines[3].split()[-4:] == ["(4", "to", "4)", "1"]
    assert len(lines[3]) == len(lines[2])


def test_the_last_line_says_how_the_time_grows() -> None:
    assert growth("ours", rows()) == (
        "  From 20 to 80 triangles: primary 3 to 6 ms (2.00 x), both 4 to 16 ms (4.00 x); "
        "the logarithm 1.46 x"
    )


def test_what_is_missing_of_the_peer_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mitsuba_rays, "find_spec", lambda _: None)
    names, missing = mitsuba_rays.available()
    assert names == []
    assert "pip install -e '.[bench]'" in missing
    report = rays.report((), SIZE, rounds=2)
    assert missing in report
    assert "Rays offline" in report
    assert "From 20 to 81920 triangles" in report


@pytest.fixture
def page(browser: Browser, site: str) -> Page:
    page = browser.new_page()
    page.goto(f"{site}/")
    page.evaluate("lightbench.ready")
    return page


def test_the_page_measures_a_scene_that_it_is_given(page: Page) -> None:
    work = Work("ball", ball(0), SIZE, 6144, 1, 20)
    made = rays.in_page(page)(work)()
    assert set(made) == {"primary", "both", "shadow", "frame"}
    assert 0 < made["primary"] < math.inf
    assert 0 < made["frame"] < math.inf


@pytest.mark.parametrize("call", ["measure", "measureLinear"])
def test_the_page_measures_as_many_frames_as_asked(page: Page, call: str) -> None:
    for scene in ("lab/shadows", lb.load("lab/shadows").data()):
        given = [scene, settings(shadows=True), SIZE, 2]
        answer = page.evaluate(f"(given) => lightbench.{call}(...given)", given)
        assert len(answer["milliseconds"]) == 2
        assert "llvmpipe" in answer["renderer"]
