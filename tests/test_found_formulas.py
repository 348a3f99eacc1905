"""Hypothesis looks for arguments at which a shader function leaves its float64 reference."""

# ruff: noqa: E741  (l is the direction to the light)

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests import samples
from tests.samples import single
from tests.support import library
from tests.test_formulas import EXTREME, assert_within

MENU = library()
# From exactly grazing to exactly normal, and between them by decades from either end.
SMALL = st.floats(-7.0, 0.0).map(lambda decade: 10.0**decade)
COSINES = st.one_of(st.just(0.0), st.just(1.0), SMALL, st.floats(1e-7, 1.0))
AZIMUTHS = st.floats(0.0, 2.0 * math.pi)
DIRECTIONS = st.builds(
    lambda cosine, azimuth: samples.direction(np.array([cosine]), np.array([azimuth])),
    COSINES,
    AZIMUTHS,
)
# Half vectors near the normal are where a distribution has its peak: drawn by their angle.
HALVES = st.builds(
    lambda angle, azimuth: single(
        [
            [
                math.sin(angle) * math.cos(azimuth),
                math.sin(angle) * math.sin(azimuth),
                math.cos(angle),
            ]
        ]
    ),
    st.floats(-4.0, math.log10(math.pi / 2)).map(lambda decade: 10.0**decade),
    AZIMUTHS,
)
ALPHAS = st.floats(-4.0, 0.0).map(lambda decade: single([10.0**decade]))
SEARCH = settings(max_examples=80, deadline=None, derandomize=True, database=None)


@pytest.mark.parametrize("name", MENU.stable("distributions"))
@SEARCH
@given(h=HALVES, alpha=ALPHAS)
def test_distributions(name: str, h: samples.Single, alpha: samples.Single) -> None:
    assert_within(f"distributions/{name}.glsl", "distribution", (h, alpha), {}, EXTREME)


@pytest.mark.parametrize("name", MENU.stable("maskings"))
@SEARCH
@given(l=DIRECTIONS, v=DIRECTIONS, alpha=ALPHAS)
def test_maskings(name: str, l: samples.Single, v: samples.Single, alpha: samples.Single) -> None:
    path = f"maskings/{name}.glsl"
    arguments = (l, v, samples.halves(l, v), alpha)
    assert_within(path, "masking", arguments, {}, EXTREME)


@pytest.mark.parametrize("name", MENU.choices("models"))
@SEARCH
@given(
    l=DIRECTIONS,
    v=DIRECTIONS,
    roughness=st.floats(0.01, 1.0),
    shininess=st.floats(0.0, 6.0).map(lambda decade: 10.0**decade),
)
def test_models(
    name: str, l: samples.Single, v: samples.Single, roughness: float, shininess: float
) -> None:
    arguments = (samples.material([roughness], [shininess]), l, v)
    function = "brdfCos" if "brdfCos" in MENU.files[f"models/{name}.glsl"].functions else "brdf"
    assert_within(f"models/{name}.glsl", function, arguments, {}, EXTREME)


@pytest.mark.parametrize("name", MENU.choices("fresnels"))
@SEARCH
@given(cosine=COSINES)
def test_fresnels(name: str, cosine: float) -> None:
    arguments = (samples.material([0.5], [10.0]), single([cosine]))
    assert_within(f"fresnels/{name}.glsl", "fresnel", arguments, {}, EXTREME)
