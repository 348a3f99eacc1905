"""What each comparison figure states, measured in the linear values of its own cells."""

import itertools
from collections.abc import Mapping
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from lightbench.figures import Cell, figure, picture
from lightbench.image import Image
from lightbench.settings import Setting

Values = NDArray[np.float32]
Mask = NDArray[np.bool_]
# All that the lights alone do not say.
DIRECT: Mapping[str, Setting] = {"ambient": "none", "samples": 1}


def cell(name: str, row: int, column: int = 0) -> Cell:
    return figure(name).grid()[row][column]


def image(of: Cell, size: tuple[int, int], **more: Setting) -> Image:
    shown = picture(of, size, **{"samples": 1, **more})
    assert shown.invalid().total == 0
    return shown


def linear(of: Cell, size: tuple[int, int], **more: Setting) -> Values:
    """(H, W, 3) linear values of a cell, of one sample a pixel unless told otherwise."""
    return image(of, size, **more).linear


def gray(of: Cell, size: tuple[int, int], **more: Setting) -> Values:
    """(H, W) mean of the channels."""
    mean: Values = linear(of, size, **more).mean(axis=2)
    return mean


def half_width(values: Values) -> float:
    """Radius in pixels of the disk as large as what exceeds half of the maximum."""
    return float(np.sqrt((values > values.max() / 2).sum() / np.pi))


def ring(values: Values, radius: float) -> float:
    """The mean a pixel's width about `radius` pixels from the peak."""
    y, x = np.unravel_index(np.argmax(values), values.shape)
    rows, columns = np.indices(values.shape)
    away = np.abs(np.hypot(rows - y, columns - x) - radius)
    return float(values[away < 1].mean())


# Figure 3.1


def highlight(of: Cell, **more: Setting) -> Values:
    only = {**DIRECT, "materials.surface.kd": "0,0,0", "materials.surface.base_color": "0,0,0"}
    shown = gray(of, (400, 400), **{**only, **more})
    shown[shown == shown[0, 0]] = 0  # the background
    return shown


@pytest.mark.parametrize("column", range(4))
def test_a_fourfold_exponent_makes_blinn_phong_s_highlight_as_wide(column: int) -> None:
    blinn, phong = cell("3.1", 0, column), cell("3.1", 1, column)
    exponents = [c.settings["materials.surface.shininess"] for c in (blinn, phong)]
    assert exponents[0] == 4 * exponents[1]  # type: ignore[operator]
    width = half_width(highlight(phong))
    assert half_width(highlight(blinn)) == pytest.approx(width, rel=0.1)
    same = highlight(blinn, **{"materials.surface.shininess": exponents[1]})
    assert half_width(same) > 1.3 * width


# Figure 3.2

ALPHAS = (0.025, 0.05, 0.15, 0.3)


@cache
def density(row: int, column: int) -> Values:
    """(H, W) D on the sphere, in 1/sr."""
    return gray(cell("3.2", row, column), (400, 400))


@pytest.mark.parametrize("row", range(3))
def test_peaks_sink_as_alpha_grows(row: int) -> None:
    for column, alpha in enumerate(ALPHAS):
        assert density(row, column).max() == pytest.approx(1 / (np.pi * alpha**2), rel=0.02)
    widths = [half_width(density(row, column)) for column in range(4)]
    assert widths == sorted(widths)


@pytest.mark.parametrize("column", range(4))
def test_ggx_has_the_long_tail(column: int) -> None:
    """Three half widths out Beckmann is at 2^-9 of its peak, GGX at 1 / (1 + 9 (sqrt 2 - 1))^2."""
    shares = []
    for row in (1, 2):
        values = density(row, column)
        shares.append(ring(values, 3 * half_width(values)) / values.max())
    assert shares[1] > 5 * shares[0]
    assert half_width(density(2, column)) < half_width(density(1, column))


def test_blinn_phong_nears_beckmann_as_alpha_falls() -> None:
    apart = [
        float(np.abs(density(0, column) - density(1, column)).max() / density(1, column).max())
        for column in range(4)
    ]
    assert apart == sorted(apart)
    assert apart[1] < 0.01


# Figure 3.3


@pytest.mark.parametrize("column", [1, 2])
def test_correlated_masking_is_brighter_most_of_all_by_the_terminator(column: int) -> None:
    size = (300, 300)
    apart, joint = (gray(cell("3.3", row, column), size) for row in (0, 1))
    assert (joint >= apart - 1e-6).all()
    normal = linear(cell("3.3", 0, column), size, view="normal")
    sphere = np.linalg.norm(normal, axis=2) > 0.99
    light = np.array(cell("3.3", 0, column).settings["lights.key.position"], float)
    to_light = light - normal
    cosine = (normal * to_light).sum(axis=2) / np.linalg.norm(to_light, axis=2)
    lit = sphere & (apart > 1e-3)
    gain = np.where(lit, joint / np.maximum(apart, 1e-3), 1)
    by_edge, away = gain[lit & (cosine < 0.15)], gain[lit & (cosine > 0.45)]
    assert by_edge.mean() > 1.02
    assert by_edge.mean() - 1 > 2 * (away.mean() - 1)


def test_the_difference_is_that_of_its_neighbours() -> None:
    size = (100, 100)
    rows = [linear(cell("3.3", row, 2), size) for row in range(3)]
    assert rows[2] == pytest.approx(8 * (rows[1] - rows[0]), abs=1e-6)


# Figure 3.4


def test_fresnel_whitens_towards_grazing() -> None:
    shown = [linear(cell("3.4", 1, column), (200, 200)) for column in range(5)]
    brightest = [values.reshape(-1, 3)[values.sum(axis=2).argmax()] for values in shown]
    head_on = np.array([0.04, 0.04, 0.04]) / 2 + np.array([0.955, 0.45, 0.24]) / 2
    assert brightest[0] == pytest.approx(head_on, abs=0.01)
    for before, after in itertools.pairwise(brightest):
        assert (after >= before - 1e-6).all()
        assert after.min() / after.max() >= before.min() / before.max() - 1e-6
    assert (brightest[4] > 0.5).all()


# Figures 4.4, 4.5


def halves(values: Values) -> list[Values]:
    """The left and the right sphere."""
    middle = values.shape[1] // 2
    return [values[:, :middle], values[:, middle:]]


def test_the_metal_shows_the_lights_and_nothing_else() -> None:
    """The one light that a metal mirrors to few pixels, a matt surface spreads over all."""
    shown = gray(cell("4.4", 0), (400, 200), **DIRECT)
    background = shown[0, 0]
    plastic, metal = (half[half != background] for half in halves(shown))
    assert np.median(plastic) / plastic.max() > 5 * np.median(metal) / metal.max()


def test_beckmann_ends_and_ggx_thins_out() -> None:
    shown = gray(cell("4.5", 1), (400, 200))
    background = shown[0, 0]
    beckmann, ggx = (half[(half != background) & (half > 0)] for half in halves(shown))
    assert (beckmann < 0.005).mean() > 0.2
    assert (ggx < 0.005).mean() < 0.01
    assert ggx.max() == pytest.approx(beckmann.max(), rel=0.05)


# Figures 4.7, 4.8


@pytest.mark.parametrize("name", ["4.7", "4.8"])
def test_more_triangles_fill_the_outline(name: str) -> None:
    filled = []
    for column in range(4):
        shown = linear(cell(name, 0, column), (200, 200), view="normal")
        filled.append(int((np.linalg.norm(shown, axis=2) > 0.5).sum()))
    assert filled == sorted(set(filled))
    assert filled[3] - filled[2] < (filled[1] - filled[0]) / 2


# Figures 4.9 to 4.11


def test_each_kind_of_light_stands_alone() -> None:
    """A spot leaves most of the room dark, a directional light its wall even, a point light not."""
    shown = [gray(cell("4.9", 0, column), (200, 180), **DIRECT) for column in range(3)]
    wall = np.s_[30:60, 50:150]
    spread = [float(values[wall].std() / values[wall].mean()) for values in shown[:2]]
    assert 5 * spread[1] < 0.03 < spread[0]
    dark = [float((values < 1e-6).mean()) for values in shown]
    assert dark[2] > 0.5 > dark[0]


def test_strong_falloff_is_brighter_near_and_darker_far() -> None:
    even, steep = (gray(cell("4.10", 0, column), (240, 170), **DIRECT) for column in range(2))
    floor, end = np.s_[140:165, 100:140], np.s_[62:80, 108:132]
    assert steep[floor].mean() > 1.5 * even[floor].mean()
    assert steep[end].mean() < 0.7 * even[end].mean()


def test_a_spot_s_edge_is_soft_or_one_pixel_wide() -> None:
    open_cone: dict[str, Setting] = {"lights.spot.inner": 70, "lights.spot.outer": 70}
    given: dict[str, Setting] = {**DIRECT, "shadow": "none", "model": "lambert"}
    shares = []
    for column in range(2):
        full = gray(cell("4.11", 0, column), (300, 212), **given, **open_cone)
        part = gray(cell("4.11", 0, column), (300, 212), **given)
        shares.append(np.where(full > 1e-4, part / np.maximum(full, 1e-4), 0))
    between = [float(((s > 1e-3) & (s < 0.999)).mean()) for s in shares]
    assert between[0] > 0.05
    assert between[1] == 0
    assert (np.abs(shares[0] - shares[1])[shares[1] == 1] < 1e-3).all()


# Figures 4.12 to 4.16


def test_shadows_only_darken() -> None:
    lit, shadowed = (linear(cell("4.12", 0, column), (200, 150)) for column in range(2))
    assert (shadowed <= lit + 1e-6).all()
    assert (shadowed < 0.9 * lit).all(axis=2).mean() > 0.05


@pytest.mark.parametrize("name", ["4.13", "4.14"])
def test_what_the_light_sees_is_lit(name: str) -> None:
    seen = cell(name, 0, 1)
    drawn = linear(seen, (200, 200), view="normal")
    drawn = np.abs(np.linalg.norm(drawn, axis=2) - 1) < 1e-3
    shares = gray(seen, (200, 200), view="shadow", shadow="hard")
    assert drawn.sum() > 5000
    assert (shares[drawn] == 0).mean() < 0.01
    depth = gray(cell(name, 0, 2), (200, 200))
    assert depth.min() >= 0
    assert depth.max() <= 1
    assert np.ptp(depth[drawn]) > 0.3


def test_a_point_light_s_shadow_lies_away_from_it() -> None:
    """The red ball's shadow is on its far side from the lamp, and two lights cast none."""
    shares = gray(cell("4.15", 0, 0), (424, 318), view="shadow", shadow="hard")
    assert shares[228:240, 275:325] == pytest.approx(2 / 3)
    assert shares[228:240, 190:215] == pytest.approx(1)


def test_acne_without_a_bias_and_none_with_it() -> None:
    size = (212, 159)
    sound = gray(cell("4.16", 0, 0), size, view="shadow", bias="normal_offset")
    dark = []
    for column in range(2):
        shares = gray(cell("4.16", 0, column), size, view="shadow")
        dark.append(float((shares[sound == 1] < 1).mean()))
    assert dark[0] > 0.2
    assert dark[1] < 0.01


# Figures 4.18 to 4.20


def test_cook_torrance_has_the_hottest_cores() -> None:
    phong, blinn, cook = (gray(cell("4.18", row), (380, 125)).max() for row in range(3))
    assert cook > 2 * phong
    assert cook > 2 * blinn


def test_gamma_lifts_the_middle_tones() -> None:
    plain, lifted = (image(cell("4.19", 0, c), (200, 150)).display.astype(int) for c in range(2))
    assert (lifted >= plain).all()
    middle = (plain > 25) & (plain < 128)
    assert middle.mean() > 0.3
    assert (lifted - plain)[middle].min() > 50
    ends = (plain == 0) | (plain == 255)
    assert (lifted == plain)[ends].all()


def test_tone_mapping_keeps_what_is_cut_off_without() -> None:
    cut, kept = (image(cell("4.20", 0, c), (200, 150)).display for c in range(2))
    lost = (cut == 255).all(axis=2)
    assert lost.mean() > 0.1
    assert (kept == 255).all(axis=2).mean() < 0.02
    assert np.unique(kept[lost], axis=0).shape[0] > 50
