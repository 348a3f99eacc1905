"""Quantisation: the levels that a picture keeps, and the error that each choice makes."""

import numpy as np
import pytest

import lightbench as lb
from lightbench.exact.directions import Array
from lightbench.exact.display import bayer
from tests.samples import evaluate, single
from tests.support import library

# Codes with 64 to a level and more, ends included; three of them a pixel.
RAMP = np.linspace(0.0, 1.0, 3 * 255 * 81 + 3).reshape(-1, 3)
HERE = np.zeros((1, 2))
TILE = np.stack(np.meshgrid(np.arange(8.0), np.arange(8.0)), axis=-1).reshape(-1, 2)


def quantised(name: str, code: Array, pixel: Array) -> Array:
    return evaluate(f"quantisations/{name}.glsl", "quantise", (single(code), single(pixel)), {})


def levels(name: str, code: Array, pixel: Array = HERE) -> Array:
    """The level, 0 to 255, that a code becomes in a pixel, once it is seen to be a whole number."""
    got = 255.0 * quantised(name, code, pixel)
    assert np.abs(got - np.rint(got)).max() < 1e-4
    return np.rint(got)


def stored(name: str) -> tuple[Array, Array]:
    """Codes of a picture before and after its 8-bit target, row 0 at the top."""
    image = lb.render("spheres", (96, 72), tonemap="none", transfer="linear", quantisation=name)
    return np.clip(image.linear, 0.0, 1.0), image.display.astype(np.float64)


def test_rounding_is_left_to_the_target() -> None:
    """What the default hands on is the code itself; the picture has the nearest level."""
    assert np.array_equal(quantised("round", RAMP, HERE), single(RAMP))
    assert library().folders["quantisations"].default == "round"
    code, level = stored("round")
    assert np.abs(255.0 * code - level).max() <= 0.5 + 1e-4
    assert np.array_equal(
        level, lb.render("spheres", (96, 72), tonemap="none", transfer="linear").display
    )


def test_truncation_is_half_a_level_too_dark() -> None:
    off = levels("truncate", RAMP) - 255.0 * RAMP
    assert off.max() < 1e-4
    assert off.min() > -1.0 - 1e-4
    assert off.mean() == pytest.approx(-0.5, abs=0.003)
    rounded = np.rint(255.0 * RAMP) - 255.0 * RAMP
    assert abs(rounded.mean()) < 1e-3
    code, level = stored("truncate")
    assert np.array_equal(level, np.floor(np.float32(255.0) * code.astype(np.float32)))
    assert np.mean(level - 255.0 * code) < -0.3


@pytest.mark.parametrize("level", [0, 3, 127, 254])
def test_a_dithered_tile_keeps_its_mean(level: int) -> None:
    """Within 1/128 of a level; with two levels at most."""
    for share in np.linspace(0.0, 1.0, 41):
        value = level + share
        code = np.full((64, 3), value / 255.0)
        found = levels("ordered", code, TILE)
        assert set(np.unique(found)) <= {level, level + 1}
        assert found.mean() == pytest.approx(value, abs=1 / 128 + 1e-4)


def test_a_level_is_not_dithered() -> None:
    codes = np.repeat(np.arange(256.0) / 255.0, 64)[:, None] * np.ones(3)
    assert np.array_equal(levels("ordered", codes, np.tile(TILE, (256, 1))), 255.0 * codes)


def test_the_thresholds_are_bayer_s() -> None:
    """64 different ones, each at its place in the matrix."""
    above = np.zeros((8, 8))
    for rank in range(64):
        code = np.full((64, 3), (63.5 - rank + 0.25) / 64.0 / 255.0)
        above += levels("ordered", code, TILE)[:, 0].reshape(8, 8)
    # A pixel of rank r goes up for the codes of ranks 0 to r.
    ranks = above - 1.0
    assert np.array_equal(ranks, bayer(8))
    assert sorted(ranks.ravel()) == list(range(64))


def test_a_dithered_picture() -> None:
    """Each pixel is one of the two levels about it, by its place from the bottom left."""
    code, level = stored("ordered")
    rows, columns = np.indices(code.shape[:2])
    rank = bayer(8)[(code.shape[0] - 1 - rows) % 8, columns % 8]
    want = np.floor(255.0 * code + (rank[..., None] + 0.5) / 64.0)
    assert (level != want).mean() < 1e-4
    assert np.abs(level - 255.0 * code).max() < 1.0
    assert abs(np.mean(level - 255.0 * code)) < 0.02


def gamma_of(code: Array) -> Array:
    return evaluate("transfers/gamma.glsl", "transfer", (single(code),), {"gamma": 2.2})


def test_gamma_stands_before_the_quantisation() -> None:
    """All 256 levels are used; the other way round 184 of them are."""
    before = levels("truncate", gamma_of(RAMP**2.2))
    after = levels("truncate", gamma_of(levels("truncate", RAMP) / 255.0))
    assert len(np.unique(before)) == 256
    assert len(np.unique(after)) == 184


def test_gamma_is_a_setting() -> None:
    """Of the plain power alone, and within what displays have."""
    parameter = library().files["transfers/gamma.glsl"].meta.parameters["gamma"]
    assert (parameter.kind, parameter.default, parameter.range) == ("float", 2.2, (1.0, 4.0))
    grey = single(np.full((1, 3), 0.5))
    for gamma in (1.0, 1.8, 2.4, 4.0):
        got = evaluate("transfers/gamma.glsl", "transfer", (grey,), {"gamma": gamma})
        assert got == pytest.approx(0.5 ** (1 / gamma), rel=1e-6)
    with pytest.raises(lb.LightbenchError, match=r"gamma: 0\.5"):
        lb.render("spheres", (8, 8), transfer="gamma", gamma=0.5)
