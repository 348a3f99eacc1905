"""Values as constants in what rays run: the same picture, nothing left to set."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from playwright.sync_api import Browser, expect

import lightbench as lb
from lightbench.constants import with_constants
from lightbench.library import read_library
from lightbench.paths import shaders_folder
from lightbench.plan import plan
from lightbench.plan_types import Plan, Program
from lightbench.settings import Setting
from tests.browser import PATIENCE_MS
from tests.support import presets

SIZE = (80, 64)
PROGRAMS = "window.lightbench.programs().map((program) => program.fragment).join('')"


@given(st.floats(width=32, allow_nan=False, allow_infinity=False))
def test_a_constant_is_the_value_itself(value: float) -> None:
    line = with_constants("uniform float u_a;", {"u_a": [value]})
    found = re.fullmatch(r"const float u_a = float\((\S+)\);", line)
    assert found is not None, line
    # A decimal point or an exponent: GLSL has no other floats.
    assert re.fullmatch(r"-?\d(\.\d+)?e[+-]\d+", found[1]), line
    assert np.float32(found[1]) == np.float32(value)


def test_only_what_has_a_value_and_line_for_line() -> None:
    source = (
        "\n\nuniform highp vec2 u_a;\n  uniform mat3 u_b;\nuniform sampler2D u_c;\nfloat u_a2;\n"
    )
    made = with_constants(source, {"u_a": [0.25, -3], "u_b": [float(i) for i in range(9)]})
    assert made.splitlines() == [
        "",
        "",
        "const vec2 u_a = vec2(2.5e-1, -3e+0);",
        "  const mat3 u_b = mat3(0e+0, 1e+0, 2e+0, 3e+0, 4e+0, 5e+0, 6e+0, 7e+0, 8e+0);",
        "uniform sampler2D u_c;",
        "float u_a2;",
    ]


def planned(scene: str, **settings: Setting) -> Plan:
    return plan(read_library(shaders_folder()), lb.load(scene), settings, SIZE)


def tracing(made: Plan) -> Program:
    """The program that rays begin in; its uniforms are in the plan as its source says."""
    (batch,) = next(p for p in made["passes"] if p["name"] == "trace")["batches"]
    program = made["programs"][batch["program"]]
    declared = re.findall(r"^uniform (?:highp )?(?!i?sampler)\w+ (\w+);", program["fragment"], re.M)
    assert sorted(declared) == sorted(batch["uniforms"])
    return program


@pytest.mark.parametrize("scene", ["lab/sphere-intersection", "lab/reflectance2", "box-room"])
def test_rays_have_no_uniform(scene: str) -> None:
    constant = tracing(planned(scene, technique="whitted"))["fragment"]
    free = tracing(planned(scene, technique="whitted", constants=False))["fragment"]
    assert not re.search(r"^uniform (?!highp i?sampler)", constant, re.M)
    assert re.search(r"^uniform vec", free, re.M)
    assert len(constant.splitlines()) == len(free.splitlines())


def test_what_rays_do_not_run_keeps_its_uniforms() -> None:
    """Exposure is of the display's pass: its slider compiles nothing, whatever traced the light."""
    made = planned("lab/reflectance2", exposure=1)
    (display,) = next(p for p in made["passes"] if p["name"] == "display")["batches"]
    assert display["uniforms"]
    assert made["programs"] == planned("lab/reflectance2", exposure=2)["programs"]
    assert planned("box-room") == planned("box-room", constants=False)


@pytest.mark.parametrize("scene", presets())
def test_the_picture_is_the_same(scene: str) -> None:
    """But for roundings of what a compiler folds: a pixel at an edge may fall to its other side."""
    constant = lb.render(scene, SIZE, technique="whitted").linear
    free = lb.render(scene, SIZE, technique="whitted", constants=False).linear
    differs = np.abs(constant - free).max(axis=2) > 1e-5 * (1 + np.abs(free).max(axis=2))
    assert differs.mean() < 4e-3


def test_a_value_that_moves_compiles_once(browser: Browser, site: str) -> None:
    """While a slider moves its values are uniforms; at rest they are constants again."""
    context = browser.new_context(viewport={"width": 700, "height": 500})
    context.set_default_timeout(PATIENCE_MS)
    page = context.new_page()
    page.goto(f"{site}/#lab/shadows")
    page.evaluate("window.lightbench.ready")
    assert "const vec3 u_light0_position" in page.evaluate(PROGRAMS)
    page.get_by_role("tab", name="Light").click()
    slider = page.get_by_role("slider", name="Intensity").first
    slider.focus()
    uniform = "uniform vec3 u_light0_position"
    page.evaluate(
        "([shown, part]) => { window.seen = []; const look = () => { const now = eval(shown);"
        " if (now !== window.seen.at(-1)) window.seen.push(now); requestAnimationFrame(look); };"
        " look(); }",
        [PROGRAMS, uniform],
    )
    for _ in range(8):
        slider.press("ArrowRight")
    page.wait_for_function(
        "() => window.seen.length > 2 && !window.seen.at(-1).includes('uniform vec3 u_light0')"
    )
    first, *_, last = page.evaluate("window.seen")
    assert uniform not in first
    assert uniform not in last
    assert first != last
    # One program for all that moves, however often the slider moved.
    assert len({text for text in page.evaluate("window.seen") if uniform in text}) == 1
    expect(page.locator("#notices")).to_be_empty()
    context.close()
