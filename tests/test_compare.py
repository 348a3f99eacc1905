"""Error metrics against closed forms, and pictures that no metric may swallow."""

import sys

import flip_evaluator
import numpy as np
import pytest

from lightbench.compare import Picture, code_difference, codes, compare, flip_map, linear
from lightbench.errors import LightbenchError


def even(value: float, kind: type = np.float32) -> Picture:
    return np.full((24, 32, 3), value, kind)


def test_a_picture_equals_itself() -> None:
    picture = np.random.default_rng(1).random((24, 32, 3), np.float32)
    for each in (picture, codes(picture)):
        difference = compare(each, each)
        assert (difference.largest, difference.rmse, difference.relmse) == (0, 0.0, 0.0)
        assert difference.flip_max == pytest.approx(0, abs=1e-6)


def test_linear_metrics_of_even_pictures() -> None:
    difference = compare(even(0.5), even(0.25))
    assert difference.rmse == pytest.approx(0.25)
    assert difference.relmse == pytest.approx(0.0625 / (0.0625 + 1e-3))
    assert difference.largest_linear == pytest.approx(0.25)
    # sRGB of 0.5 and 0.25 is 0.735357 and 0.537099.
    assert difference.largest == 188 - 137
    assert difference.share_above_one == 1


def test_codes_are_decoded_as_srgb() -> None:
    difference = compare(even(188, np.uint8), even(137, np.uint8))
    assert difference.largest == 51
    assert difference.rmse == pytest.approx(0.25, abs=0.004)
    every = np.arange(256, dtype=np.uint8).repeat(3).reshape(16, 16, 3)
    assert np.array_equal(codes(linear(every)), every)


def test_the_share_of_pixels_over_one_code() -> None:
    reference = even(100, np.uint8)
    actual = reference.copy()
    actual[0, :8, 1] += 2
    actual[1] += 1
    assert compare(actual, reference).share_above_one == 8 / (24 * 32)
    assert code_difference(actual, reference).max() == 2


@pytest.mark.parametrize("kind", [np.uint8, np.float32])
def test_flip_sees_a_missing_highlight(kind: type) -> None:
    scale = 255 if kind == np.uint8 else 8
    reference = even(0.2 * scale, kind)
    reference[10:13, 10:13] = scale
    difference = compare(even(0.2 * scale, kind), reference)
    assert difference.flip_max > 0.3
    assert difference.flip_mean < 0.1 < difference.flip_max


def test_flip_is_the_same_beside_a_bright_pixel() -> None:
    """Fixed exposures: one pixel shifts nothing far from it."""
    calm, brighter = even(0.25), even(0.25)
    brighter[0, 0] = 1000
    plain = flip_map(even(0.3), calm)
    beside = flip_map(np.where(brighter == 1000, brighter, even(0.3)), brighter)
    assert np.allclose(plain[-1, -1], beside[-1, -1], atol=1e-5)


def test_flip_in_colours() -> None:
    shown = flip_map(even(0.0), even(1.0), magma=True)
    assert shown.shape == (24, 32, 3)
    assert shown.min() >= 0
    assert shown.max() <= 1


@pytest.mark.parametrize(
    ("actual", "expected", "what"),
    [
        (even(np.nan), even(0.0), "actual: 768 pixels hold a NaN or an infinity"),
        (even(0.0), even(np.inf), "reference: 768 pixels"),
        (even(0.0), even(0.0)[:3], "actual is 32x24 pixels, the reference 32x3"),
        (even(0.0), even(0, np.uint8), "actual is float32, the reference uint8"),
        (even(0.0)[..., 0], even(0.0)[..., 0], "a picture is (H, W, 3), not (24, 32)"),
        (even(0, np.int32), even(0, np.int32), "not int32"),
    ],
)
def test_what_cannot_be_compared(actual: Picture, expected: Picture, what: str) -> None:
    for metric in (compare, code_difference, flip_map):
        with pytest.raises(LightbenchError) as caught:
            metric(actual, expected)
        assert what in str(caught.value)


def test_flip_that_exits(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        print("Something is wrong.\nExiting.")
        sys.exit(1)

    monkeypatch.setattr(flip_evaluator, "evaluate", refuse)
    with pytest.raises(LightbenchError, match="Something is wrong"):
        flip_map(even(0.0), even(0.0))
