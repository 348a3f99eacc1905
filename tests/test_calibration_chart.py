"""The calibration chart: each of its five levels is exactly the code of the lab script."""

import math

import numpy as np
import pytest

import lightbench as lb
from tests.browser import BACKENDS, browsing, render_in, serving
from tests.support import planned

CHART = "lab/calibration-chart"
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)
CODES = [math.floor(share * 255.0) for share in SHARES]


@pytest.mark.parametrize("size", [(500, 400), (300, 700), (1920, 1080), (5, 1), (101, 37)])
def test_every_level_is_exact(size: tuple[int, int]) -> None:
    """Five bars of one width over the whole picture, of any shape; nothing between them."""
    width, height = size
    image = lb.render(CHART, size)
    bar = np.minimum((np.arange(width) + 0.5) * 5 / width, 4.999).astype(int)
    # A pixel whose middle lies on an edge belongs to either side.
    sure = np.abs((np.arange(width) + 0.5) * 5 / width % 1 - 0.5) < 0.499
    want = np.array(CODES)[bar]
    for row in image.display[:: max(height // 7, 1)]:
        assert np.array_equal(row[sure], np.stack([want[sure]] * 3, axis=1))
    assert set(np.unique(image.display)) == set(CODES)
    assert set(np.unique(image.linear)) == set(SHARES)


def test_it_needs_no_light() -> None:
    made = planned(CHART, {})
    assert [each["name"] for each in made["passes"]] == ["forward", "display"]
    assert made["settings"] == ["view", "tonemap", "transfer", "quantisation"]
    assert made["textures"] == {}


def test_a_gamma_brightens_what_is_between() -> None:
    """As the chart is shown again after the correction: black and white stay."""
    image = lb.render(CHART, (50, 40), transfer="gamma", gamma=2.4)
    want = [math.floor(share ** (1 / 2.4) * 255.0) for share in SHARES]
    assert np.array_equal(image.display[20, 5::10, 0], want)


@pytest.mark.parametrize("backend", BACKENDS)
def test_the_browser_shows_the_same_codes(backend: str) -> None:
    with serving() as address, browsing(backend) as browser:
        page = browser.new_page()
        page.goto(address)
        page.evaluate("window.lightbench.ready")
        for quantisation in ("truncate", "round", "ordered"):
            given = {"quantisation": quantisation}
            _, display, _ = render_in(page, CHART, given, (250, 200))
            offline = lb.render(CHART, (250, 200), quantisation=quantisation)
            if quantisation == "truncate":
                assert display[100, 25::50, 0].tolist() == CODES
            # A code halfway between two levels is rounded as the driver likes.
            tie = (quantisation == "round") & (offline.linear == 0.5)
            assert np.array_equal(display[~tie], offline.display[~tie])
