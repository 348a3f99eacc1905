"""The stability atlas: what it sweeps, and what it measures."""

from pathlib import Path

import numpy as np
import pytest

from lightbench.atlas import FINITE, INF, NAN, NEGATIVE, PRECISIONS, UNKNOWN, Map, chart
from lightbench.atlas_report import sentence
from lightbench.exact import FUNCTIONS
from lightbench.library import read_library
from lightbench.sweep import Input, Sweep, points, sweep_of, sweeps
from tests.support import copy_of_shaders, library
from tests.test_formulas import CHOICES

SIZE = 24
GGX = ("distributions/ggx.glsl", "distribution")
# Share of a map on which a form that is used may be off by more than 1 % in float32: rays that
# touch a sphere a million radii away, within a step of its edge.
ALLOWED = {"lib/sphere.glsl": 2e-3}


@pytest.fixture(scope="module")
def maps() -> list[Map]:
    return [chart(library(), sweep, SIZE) for sweep in sweeps(library())]


# Sweeps


def test_every_choice_is_swept() -> None:
    """Each that is a function of numbers alone: a shadow or an outline looks into a picture.

    Levels have no digits to lose; what has a distance for its only input has no second axis; the
    lab's ambient light asks for a scene's lights.
    """
    unswept = ("shadows", "outlines", "quantisations")
    wanted = {c for c in CHOICES if c[0].split("/")[0] not in unswept}
    wanted -= {("attenuations/none.glsl", "attenuation"), ("ambients/lab.glsl", "ambient")}
    assert {(sweep.file, sweep.function) for sweep in sweeps(library())} >= wanted


def test_alpha_and_angle_by_default() -> None:
    for sweep in sweeps(library()):
        if sweep.file.startswith("distributions/"):
            assert (sweep.x, sweep.y) == ("alpha", "theta_h")
    first = sweep_of(library(), "maskings/smith_ggx.glsl", "visibility")
    assert (first.x, first.y) == ("alpha", "NoV")
    assert first.textbook == "maskings/smith_ggx_textbook.glsl"


def test_a_textbook_form_leads_to_the_same_sweep() -> None:
    ours = sweep_of(library(), *GGX)
    assert sweep_of(library(), "distributions/ggx_textbook.glsl", "distribution") == ours


def test_ranges_come_from_front_matter(tmp_path: Path) -> None:
    text = """/*---
title = "Mine"
domain = { alpha = [0.25, 0.5] }
[parameters.sharpness]
default = 1.0
range = [0.5, 2.0]
scale = "log"
---*/
float distribution(vec3 h, float alpha) { return u_sharpness * alpha; }
"""
    folder = copy_of_shaders(tmp_path, {"distributions/mine.glsl": text})
    sweep = sweep_of(read_library(folder), "distributions/mine.glsl", "distribution")
    alpha, sharpness = sweep.axis("alpha"), sweep.axis("sharpness")
    assert (alpha.low, alpha.high, alpha.zero) == (0.25, 0.5, False)
    assert (sharpness.low, sharpness.high, sharpness.at) == (0.5, 2.0, 1.0)
    assert sharpness.log


@pytest.mark.parametrize("domain", ["[0.5, 0.5]", "[-2.0, -1.0]", "[-1.0, 0.5]"])
def test_an_odd_domain_is_swept_all_the_same(domain: str, tmp_path: Path) -> None:
    text = f"""/*---
title = "Mine"
domain = {{ alpha = {domain} }}
[parameters.still]
default = 1.0
range = [1.0, 1.0]
[parameters.below]
default = -1.0
range = [-2.0, 2.0]
scale = "log"
---*/
float distribution(vec3 h, float alpha) {{ return alpha * u_still * u_below; }}
"""
    folder = copy_of_shaders(tmp_path, {"distributions/mine.glsl": text})
    sweep = sweep_of(read_library(folder), "distributions/mine.glsl", "distribution")
    for each in sweep.inputs:
        assert each.low < each.high
        assert np.isfinite(each.samples(32)).all()
    assert "still" not in [each.name for each in sweep.inputs]


def test_an_axis_begins_with_exact_zeros() -> None:
    axis = Input("a", "a", 1e-4, 1.0, 0.5, log=True, zero=True)
    values = axis.samples(28)
    assert (values[:2] == 0.0).all()
    assert values[2:] == pytest.approx(np.geomspace(1e-4, 1.0, 26))
    assert Input("a", "a", -1.0, 1.0, 0.5).samples(5).tolist() == [-1.0, -0.5, 0.0, 0.5, 1.0]


def test_points_run_along_x_first() -> None:
    sweep = sweep_of(library(), *GGX)
    values = points(sweep, 16)
    assert len(set(values["alpha"][:16])) > 10
    assert len(set(values["theta_h"][:16])) == 1
    other = sweep_of(library(), "maskings/smith_ggx.glsl", "masking", "azimuth", "NoL")
    assert set(points(other, 16)["alpha"]) == {other.axis("alpha").at}


def test_sweeps_are_plain_data() -> None:
    for sweep in sweeps(library()):
        assert isinstance(sweep, Sweep)
        assert {sweep.x, sweep.y} <= {each.name for each in sweep.inputs}
        for each in sweep.inputs:
            assert each.low < each.high
            assert not each.log or each.low > 0.0
            assert each.low <= each.at <= each.high or (each.zero and each.at == 0.0)


# Measurement


def panel_of(
    got: float, want: float, tmp_path: Path, precision: str = "float32"
) -> tuple[float, int]:
    """The error and kind of one point of a transfer that returns `got` where `want` is exact."""
    number = {"nan": "log(-1.0)", "inf": "1.0 / 0.0"}.get(str(got), repr(got))
    code = f"vec3 transfer(vec3 linear) {{ return vec3({number} + 0.0 * linear.x); }}\n"
    path = "transfers/linear.glsl"
    folder = copy_of_shaders(tmp_path, {path: f'/*---\ntitle = "T"\n---*/\n{code}'})
    found = read_library(folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(FUNCTIONS, (path, "transfer"), lambda c: np.full_like(c, want))
        panel = chart(found, sweep_of(found, path, "transfer"), 16, folder).panel(path, precision)
    assert len(set(panel.kind[8])) == 1
    return float(panel.ulp[8, 8]), int(panel.kind[8, 8])


@pytest.mark.parametrize(
    ("got", "want", "ulp", "kind"),
    [
        (1.0, 1.0, 0.0, FINITE),
        (1.0, 1.0 - 2.0**-24, 1.0, FINITE),
        (1.5, 1.5 + 2.0**-24, 0.5, FINITE),
        (2.0, 1.0, 2.0**23, FINITE),
        (1e-35, 0.0, 0.0, FINITE),
        (-1.0, 1.0, 0.0, NEGATIVE),
        (-1.0, -1.0, 0.0, FINITE),
        (float("nan"), 1.0, 0.0, NAN),
        (float("inf"), 1.0, 0.0, INF),
        (1.0, float("inf"), 0.0, UNKNOWN),
        (1.0, 1e39, 0.0, UNKNOWN),
    ],
)
def test_an_error_in_steps(got: float, want: float, ulp: float, kind: int, tmp_path: Path) -> None:
    assert panel_of(got, want, tmp_path) == (ulp, kind)


def test_an_error_in_steps_of_a_half(tmp_path: Path) -> None:
    assert panel_of(1.5, 1.5 + 2.0**-10, tmp_path / "a", "half") == (1.0, FINITE)
    assert panel_of(65536.0, 65536.0, tmp_path / "b", "half") == (0.0, INF)
    assert panel_of(6e-8, 0.0, tmp_path / "c", "half") == (1.0, FINITE)


def test_what_is_used_holds_everywhere(maps: list[Map]) -> None:
    """In float32 no map of a form that is used has a NaN, an infinity or a negative value, at the
    horizon and at alpha 1e-4 as elsewhere; nothing is off by more than 1 %."""
    for each in maps:
        panel = each.panel(each.sweep.file, "float32")
        figures = panel.summary()
        allowed = ALLOWED.get(each.sweep.file, 0.0)
        assert figures["wrong"] <= allowed, each.sweep
        assert figures["nan"] == figures["inf"] == 0.0, each.sweep
        assert figures["negative"] <= allowed, each.sweep
        assert each.exact


def test_the_textbook_fails_where_ours_does_not(maps: list[Map]) -> None:
    worst: dict[str, float] = {}
    for each in maps:
        if each.sweep.textbook:
            wrong = each.panel(each.sweep.textbook, "float32").summary()["wrong"]
            worst[each.sweep.textbook] = max(wrong, worst.get(each.sweep.textbook, 0.0))
    assert len(worst) == 7
    assert min(worst.values()) > 0.02, worst


def test_half_precision_is_worse(maps: list[Map]) -> None:
    """Its ULP are 8192 times as wide, and its range ends at 65504."""
    for each in maps:
        single, half = (each.panel(each.sweep.file, p.name) for p in PRECISIONS)
        assert single.summary()["wrong"] <= half.summary()["wrong"]
    narrow = chart(library(), sweep_of(library(), *GGX), SIZE).panel(GGX[0], "half")
    assert narrow.share(INF) > 0.05
    assert (narrow.kind[:, -SIZE // 4 :] == FINITE).all()


def test_a_dropped_in_file_is_mapped_without_an_exact_form(tmp_path: Path) -> None:
    code = "float distribution(vec3 h, float alpha) { return 1.0 / (alpha - alpha * h.z); }\n"
    folder = copy_of_shaders(
        tmp_path, {"distributions/mine.glsl": f'/*---\ntitle = "Mine"\n---*/\n{code}'}
    )
    found = read_library(folder)
    each = chart(found, sweep_of(found, "distributions/mine.glsl", "distribution"), SIZE, folder)
    assert not each.exact
    single, half = (each.panel("distributions/mine.glsl", p.name) for p in PRECISIONS)
    assert single.summary()["max_ulp"] == 0.0
    assert np.isin(single.kind, [INF, NAN, UNKNOWN]).any()
    assert half.summary()["wrong"] > 0.0
    assert "No exact form" in sentence(each)
