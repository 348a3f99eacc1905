"""One picture: the browser renders what the offline renderer renders, on both ANGLE backends."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Page

import lightbench as lb
from lightbench.compare import compare
from lightbench.image import Image
from tests.browser import BACKENDS, browsing, render_in, serving
from tests.support import alternatives, assert_sound, planned, presets

# Outlines are a smaller share of a larger picture; that share is what the 99.9 % are about.
SIZE = (480, 360)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with serving() as url:
        yield url


@pytest.fixture(scope="module", params=list(BACKENDS))
def page(request: pytest.FixtureRequest, address: str) -> Iterator[Page]:
    with browsing(request.param) as browser:
        page = browser.new_page()
        page.goto(address)
        page.evaluate("window.lightbench.ready")
        yield page


def cases() -> Iterator[tuple[str, dict[str, Any]]]:
    for preset in presets():
        yield preset, {}
        yield preset, {"model": "phong", "samples": 2}
    for settings in alternatives():
        yield "box-room", dict(settings)


def check(page: Page, scene: str, settings: dict[str, Any]) -> None:
    linear, display, renderer = render_in(page, scene, settings, SIZE)
    offline = lb.render(scene, SIZE, **settings)
    assert_sound(offline)
    # The same rasteriser must agree in every bit; a difference is one between our two runtimes.
    if "llvmpipe" in renderer and "llvmpipe" in offline.renderer:
        assert np.array_equal(linear, offline.linear)
        assert np.array_equal(display, offline.display)
    else:
        assert_alike(display, offline)


def assert_alike(display: NDArray[np.uint8], offline: Image) -> None:
    """Equal but for single codes, and for outlines that fall on the next pixel."""
    difference = compare(display, offline.display)
    assert difference.share_above_one <= 1e-3, difference
    assert difference.flip_mean <= 0.02, difference
    assert difference.flip_p99 <= 0.05, difference
    # Beside an outline a pixel may hold the other side of it, shaded one pixel further on; in a
    # smooth place its neighbours span a few codes, and so may it.
    low, high = neighbours(offline.display)
    span = high - low + 1
    assert ((display >= low - span) & (display <= high + span)).all()


def neighbours(display: NDArray[np.uint8]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Least and largest code of each pixel's 3 x 3 neighbourhood, per channel."""
    padded = np.pad(display.astype(int), ((1, 1), (1, 1), (0, 0)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, (3, 3), axis=(0, 1))
    return windows.min(axis=(3, 4)), windows.max(axis=(3, 4))


@pytest.mark.parametrize(("scene", "settings"), list(cases()), ids=str)
def test_same_picture(page: Page, scene: str, settings: dict[str, Any]) -> None:
    check(page, scene, settings)


def test_same_sources(page: Page) -> None:
    """Byte for byte, what the browser compiles is what moderngl compiles."""
    for scene, settings in cases():
        made = page.evaluate(
            "([s, o, z]) => window.lightbench.plan(s, o, z)", [scene, settings, list(SIZE)]
        )
        expected = planned(scene, settings, SIZE)
        for ours, theirs in zip(expected["programs"], made["programs"], strict=True):
            assert ours["vertex"] == theirs["vertex"]
            assert ours["fragment"] == theirs["fragment"]


def test_a_missing_highlight_would_be_seen() -> None:
    """The gates above tell pictures apart that differ by one lobe."""
    rough = lb.render("single-sphere", SIZE, model="lambert").display
    with pytest.raises(AssertionError):
        assert_alike(rough, lb.render("single-sphere", SIZE))
