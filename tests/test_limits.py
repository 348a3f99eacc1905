"""What functions tend to: at the horizon, at black and white, and for what is no number."""
# ruff: noqa: E741  (l is the direction to the light)

import itertools
import math

import numpy as np
import pytest

from lightbench.exact import display
from lightbench.exact.facets import lambda_beckmann_exact
from tests import samples
from tests.samples import direction, evaluate, single
from tests.support import library
from tests.test_formulas import variants

# Limits


def test_nothing_below_the_horizon() -> None:
    """A model that is not turned to its viewer is dark for light from below alone."""
    down, up = single([[0.6, 0.0, -0.8]]), single([[0.0, 0.0, 1.0]])
    m, alpha = samples.material([0.5], [10.0]), single([0.3])
    for name in library().stable("distributions"):
        for h in (down, single([[1.0, 0.0, 0.0]])):
            assert evaluate(f"distributions/{name}.glsl", "distribution", (h, alpha), {}) == 0.0
    for name in library().choices("models"):
        turned = "unflipped" not in library().files[f"models/{name}.glsl"].functions
        seen = [(up, down)] * turned
        for l, v in (*seen, (down, up), (down, down), (single([[1.0, 0.0, 0.0]]), up)):
            assert not evaluate(f"models/{name}.glsl", "brdf", (m, l, v), {}).any(), name


def masked(name: str, cosine_l: float, cosine_v: float, alpha: float) -> float:
    """G of a masking at two cosines, with l and v a right angle apart in azimuth."""
    l, v = (direction(np.array([c]), np.array([a])) for c, a in ((cosine_l, 0.0), (cosine_v, 1.6)))
    arguments = (l, v, samples.halves(l, v), single([alpha]))
    return float(evaluate(f"maskings/{name}.glsl", "masking", arguments, {})[0])


@pytest.mark.parametrize(
    ("name", "slope"),
    [
        ("smith_ggx", 2.0), ("smith_ggx_fast", 2.0),
        ("smith_beckmann", 3.535), ("smith_beckmann_exact", 2.0 * math.sqrt(math.pi)),
        ("smith_ggx_uncorrelated", 2.0), ("smith_beckmann_uncorrelated", 3.535),
    ],
)  # fmt: skip
def test_smith_falls_linearly_to_the_horizon(name: str, slope: float) -> None:
    """G / n.l goes to slope / alpha, whatever v for the correlated form; to half of that where
    n.v = n.l, of which the separable form keeps nothing."""
    near = 1e-6
    for alpha in (0.05, 0.5, 1.0):
        assert masked(name, near, 1.0, alpha) / near == pytest.approx(slope / alpha, rel=2e-4)
        both = masked(name, near, near, alpha) / near
        expected = near * (slope / alpha) ** 2 if "un" in name else slope / alpha / 2.0
        assert both == pytest.approx(expected, rel=2e-4)


def test_fitted_beckmann_masking_is_near_the_exact_one() -> None:
    """G1 within 0.31 % of the one with erf()."""
    cosine = np.linspace(0.001, 1.0, 1000)
    v, alpha = direction(cosine, np.zeros(1000)), single(np.full(1000, 0.5))
    n = single([[0.0, 0.0, 1.0]])
    got = evaluate("maskings/smith_beckmann.glsl", "masking", (n, v, n, alpha), {})
    exact = 1.0 / (1.0 + lambda_beckmann_exact(v.astype(np.float64), alpha.astype(np.float64)))
    off = np.abs(got / exact - 1.0)
    assert 0.0025 < off.max() < 0.0032


# Display


@pytest.mark.parametrize("name", library().choices("transfers"))
def test_transfer_ends(name: str) -> None:
    """Black, white and beyond; rising between; a NaN is loud."""
    ramp = np.repeat(np.linspace(0.0, 1.0, 4096)[:, None], 3, axis=1)
    code = evaluate(f"transfers/{name}.glsl", "transfer", (single(ramp),), {})
    assert not code[0].any()
    assert (code[-1] == 1.0).all()
    assert (np.diff(code, axis=0) > 0.0).all()
    odd = single([[-2.0, 1e30, math.inf], [math.nan, 0.5, 0.5]])
    got = evaluate(f"transfers/{name}.glsl", "transfer", (odd,), {})
    assert got.tolist() == [[0.0, 1.0, 1.0], [1.0, 0.0, 1.0]]


@pytest.mark.parametrize("name", library().stable("tonemaps"))
def test_tonemap_hides_nothing(name: str) -> None:
    """What is NaN, infinite or negative is so after the curve."""
    odd = single(samples.ODD)
    for settings in variants(f"tonemaps/{name}.glsl"):
        got = evaluate(f"tonemaps/{name}.glsl", "tonemap", (odd,), settings)
        for test in (np.isnan, np.isinf, lambda x: x < 0.0):
            assert (test(got) == test(odd)).all()


def test_reinhard_reaches_white_at_l_white() -> None:
    path = "tonemaps/reinhard_extended.glsl"
    for white in (0.5, 1.0, 4.0):
        grey = single([[white] * 3])
        got = evaluate(path, "tonemap", (grey,), {"L_white": white})
        assert got == pytest.approx(1.0, rel=1e-6)
    same = evaluate(path, "tonemap", (single([[0.2, 3.0, 9.0]]),), {"L_white": 1.0})
    assert same == pytest.approx(np.array([[0.2, 3.0, 9.0]]), rel=1e-6)


def test_invalid_view_is_loud() -> None:
    odd = single(samples.ODD)
    want = display.invalid_view(odd.astype(np.float64))
    got = evaluate("views/invalid.glsl", "view", (odd,), {})
    assert np.abs(got - want).max() < 1e-6
    for tonemap, transfer in itertools.product(*map(library().stable, ("tonemaps", "transfers"))):
        settings = {"tonemap": tonemap, "transfer": transfer}
        got = evaluate("views/final.glsl", "view", (odd,), settings)
        assert (got[np.isnan(odd).any(axis=1)] == [1.0, 0.0, 1.0]).all()
