"""How two pictures differ: linear metrics, 8-bit codes, and FLIP as a viewer sees it.

A picture is an array (H, W, 3), row 0 at the top: uint8 holds display codes (sRGB), a float type
holds linear Rec. 709. Either is turned into the other where a metric asks for it.
"""

import contextlib
import io
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import LightbenchError

__all__ = [
    "Difference",
    "Picture",
    "check",
    "code_difference",
    "codes",
    "compare",
    "flip_map",
    "linear",
    "relative_mse",
    "rmse",
]

Picture = NDArray[Any]
# Added to the squared reference in relMSE, so that black pixels weigh finitely.
RELMSE_EPSILON = 1e-3
# FLIP's viewing distance: a 0.7 m wide display of 3840 pixels, 0.7 m away.
PIXELS_PER_DEGREE = 67.0
# HDR-FLIP takes the worst of these exposures (in stops). They are fixed, since by itself it
# derives them from the reference, and one bright pixel would then change what is measured.
EXPOSURES = {"startExposure": -4.0, "stopExposure": 4.0, "numExposures": 5, "tonemapper": "aces"}


@dataclass(frozen=True)
class Difference:
    """How far a picture is from its reference.

    `largest` counts 8-bit codes and `share_above_one` is the share of pixels (0 to 1) with a
    channel more than one code away. `rmse`, `relmse` and `largest_linear` are of linear values.
    FLIP is 0 (alike) to 1: its mean, 99th percentile and maximum over the pixels.
    """

    largest: int
    share_above_one: float
    rmse: float
    relmse: float
    largest_linear: float
    flip_mean: float
    flip_p99: float
    flip_max: float


def compare(actual: Picture, expected: Picture) -> Difference:
    """Every metric of `actual` against the reference `expected`.

    Raises LightbenchError where the two are no pictures of one size and kind, or hold a NaN or an
    infinity, which the metrics would hide.
    """
    apart = code_difference(actual, expected)
    error_map = flip_map(actual, expected)
    return Difference(
        largest=int(apart.max()),
        share_above_one=float((apart > 1).mean()),
        rmse=rmse(actual, expected),
        relmse=relative_mse(actual, expected),
        largest_linear=float(np.abs(linear(actual) - linear(expected)).max()),
        flip_mean=float(error_map.mean()),
        flip_p99=float(np.percentile(error_map, 99)),
        flip_max=float(error_map.max()),
    )


def rmse(actual: Picture, expected: Picture) -> float:
    """Root of the mean squared error of the linear values."""
    check(actual, expected)
    return float(np.sqrt(((linear(actual) - linear(expected)) ** 2).mean()))


def relative_mse(actual: Picture, expected: Picture) -> float:
    """relMSE = mean((I - R)^2 / (R^2 + 1e-3)) of the linear values."""
    check(actual, expected)
    reference = linear(expected)
    return float(((linear(actual) - reference) ** 2 / (reference**2 + RELMSE_EPSILON)).mean())


def code_difference(actual: Picture, expected: Picture) -> NDArray[np.int64]:
    """(H, W): of each pixel, the largest distance of a channel in 8-bit codes."""
    check(actual, expected)
    apart = codes(actual).astype(np.int64) - codes(expected)
    return np.asarray(np.abs(apart).max(axis=2), np.int64)


def flip_map(actual: Picture, expected: Picture, *, magma: bool = False) -> NDArray[np.float32]:
    """FLIP error, 0 to 1, as (H, W); with `magma` its usual colours, (H, W, 3) sRGB in 0 to 1.

    Display codes are compared as shown, linear pictures over fixed exposures (HDR-FLIP), where
    a negative value counts as 0.
    """
    import flip_evaluator

    check(actual, expected)
    pair = [_flip_input(picture) for picture in (expected, actual)]
    shown = actual.dtype == np.uint8
    parameters = {"ppd": PIXELS_PER_DEGREE, **({} if shown else EXPOSURES)}
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said):
            error_map, _, _ = flip_evaluator.evaluate(
                *pair, "LDR" if shown else "HDR", applyMagma=magma, parameters=parameters
            )
    except SystemExit:  # its answer to any argument that it refuses
        raise LightbenchError(f"FLIP: {said.getvalue().strip()}") from None
    return np.asarray(error_map, np.float32).reshape(*actual.shape[:2], *([3] if magma else []))


def _flip_input(picture: Picture) -> NDArray[np.float32]:
    if picture.dtype == np.uint8:
        return np.asarray(picture / np.float32(255), np.float32)
    return np.ascontiguousarray(np.maximum(picture, 0), np.float32)


def check(actual: Picture, expected: Picture | None = None) -> None:
    """Refuse what is no picture, not finite, or not of one size and kind.

    Raises LightbenchError.
    """
    for name, picture in (("actual", actual), ("reference", expected)):
        if picture is not None:
            _check_one(name, picture)
    if expected is None:
        return
    if actual.shape != expected.shape:
        sizes = [f"{p.shape[1]}x{p.shape[0]}" for p in (actual, expected)]
        raise LightbenchError(f"actual is {sizes[0]} pixels, the reference {sizes[1]}")
    if (actual.dtype == np.uint8) != (expected.dtype == np.uint8):
        raise LightbenchError(f"actual is {actual.dtype}, the reference {expected.dtype}")


def _check_one(name: str, picture: Picture) -> None:
    kind = picture.dtype
    if picture.ndim != 3 or picture.shape[2] != 3 or 0 in picture.shape:
        raise LightbenchError(f"{name}: a picture is (H, W, 3), not {picture.shape}")
    if kind != np.uint8 and kind not in (np.float16, np.float32, np.float64):
        raise LightbenchError(f"{name}: a picture is uint8 codes or linear floats, not {kind}")
    if broken := int((~np.isfinite(picture)).any(axis=2).sum()):
        raise LightbenchError(f"{name}: {broken} pixels hold a NaN or an infinity")


def linear(picture: Picture) -> NDArray[np.float64]:
    """Linear values; display codes are decoded as sRGB (IEC 61966-2-1)."""
    values = picture.astype(np.float64)
    if picture.dtype != np.uint8:
        return values
    code = values / 255
    return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)


def codes(picture: Picture) -> NDArray[np.uint8]:
    """Display codes; linear values are clipped to 0 to 1 and encoded as sRGB."""
    if picture.dtype == np.uint8:
        return np.asarray(picture, np.uint8)
    value = np.clip(picture.astype(np.float64), 0, 1)
    encoded = np.where(value <= 0.0031308, value * 12.92, 1.055 * value ** (1 / 2.4) - 0.055)
    return np.asarray(np.round(encoded * 255), np.uint8)
