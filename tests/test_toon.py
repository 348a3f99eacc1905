"""Toon shading: which tone a light has, and how the lights of a point agree on one."""

import itertools

import numpy as np
import pytest

from tests import samples
from tests.samples import evaluate, single

TOON = "models/toon.glsl"
WHITE = samples.material([0.5], [1.0]) | {"base_color": single([[1.0, 1.0, 1.0]])}
# What no default of the file is.
DARK, LIT = (0.1, 0.3, 0.5), (0.9, 0.6, 0.2)
COLORS = {"toon_dark": list(DARK), "toon_lit": list(LIT)}


def level(cosine: float, tones: int) -> float:
    """The tone of one light."""
    return float(evaluate(TOON, "toneLevel", (single([cosine]),), {"tones": tones})[0])


@pytest.mark.parametrize("tones", range(2, 9))
def test_tones_divide_the_cosine_evenly(tones: int) -> None:
    for tone in range(tones):
        for share in (0.01, 0.5, 0.99):
            assert level((tone + share) / tones, tones) == tone
    assert level(0.0, tones) == level(-1.0, tones) == 0.0
    assert level(1.0, tones) == tones - 1


def test_the_brighter_of_two_tones_begins_at_half_the_cosine() -> None:
    assert level(0.5, 2) == 1.0
    assert level(np.nextafter(np.float32(0.5), np.float32(0.0)), 2) == 0.0


@pytest.mark.parametrize("lights", range(1, 7))
def test_two_tones_go_by_majority(lights: int) -> None:
    """Lit where more lights light it fully than partly, and dark on a tie."""
    for full in range(lights + 1):
        mean = single([full / lights])
        got = evaluate(TOON, "toned", (WHITE, mean), COLORS)[0]
        assert got == pytest.approx(LIT if full > lights - full else DARK, rel=1e-6)


@pytest.mark.parametrize("tones", range(2, 9))
def test_the_colours_run_from_dark_to_lit(tones: int) -> None:
    levels = single(np.arange(tones))
    got = evaluate(TOON, "toned", (WHITE, levels), {"tones": tones, **COLORS})
    share = np.linspace(0.0, 1.0, tones)[:, None]
    assert got == pytest.approx((1.0 - share) * DARK + share * LIT, rel=1e-6)


def test_halves_are_rounded_down() -> None:
    for tones, low in itertools.product((3, 8), (0, 1)):
        settings = {"tones": tones, **COLORS}
        means = single([low + 0.25, low + 0.5, low + 0.75])
        levels = single([low, low, low + 1])
        got, want = (evaluate(TOON, "toned", (WHITE, each), settings) for each in (means, levels))
        assert np.array_equal(got, want)


def test_the_material_tints_the_tones() -> None:
    red = WHITE | {"base_color": single([[0.5, 0.0, 0.25]])}
    got = evaluate(TOON, "toned", (red, single([0.0, 1.0])), COLORS)
    assert got == pytest.approx(np.array([DARK, LIT]) * [0.5, 0.0, 0.25], rel=1e-6)


def test_one_light_alone_is_its_tone() -> None:
    """brdf times cosine, under the illuminance that lights a white matt surface to 1."""
    l = samples.direction(np.array([0.2, 0.499, 0.501, 1.0]), np.zeros(4))  # noqa: E741
    v = single([[0.6, 0.0, 0.8]])
    tone = evaluate(TOON, "brdfCos", (WHITE, l, v), COLORS) * np.pi
    assert tone == pytest.approx(np.array([DARK, DARK, LIT, LIT]), rel=1e-6)
    f = evaluate(TOON, "brdf", (WHITE, l, v), COLORS) * l[:, 2:] * np.pi
    assert f == pytest.approx(tone, rel=1e-6)
