"""From radiance to display code, in float64: tone curves, transfers, levels, views."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lightbench.exact.directions import Array, column


def luminance(color: Array) -> Array:
    """ITU-R BT.709-6, item 3.2."""
    return np.asarray(color @ np.array([0.2126, 0.7152, 0.0722]))


def identity(color: Array) -> Array:
    """The colour itself."""
    return color


def reinhard(radiance: Array) -> Array:
    """L_d = L / (1 + L), rgb L_d / L where L > 0: Reinhard et al. 2002, eq. 3."""
    L = column(luminance(radiance))
    safe = np.where(L > 0.0, L, 1.0)
    return np.where(L > 0.0, radiance * (safe / (1.0 + safe)) / safe, radiance)


def reinhard_extended(radiance: Array, L_white: float | Array = 4.0) -> Array:
    """L_d = L (1 + L / L_w^2) / (1 + L), L_w at least 1e-6, at most float32's largest value."""
    L = column(luminance(radiance))
    safe = np.where(L > 0.0, L, 1.0)
    white = column(np.maximum(L_white, 1e-6))
    L_d = safe * (1.0 + safe / white**2) / (1.0 + safe)
    largest = float(np.finfo(np.float32).max)
    return np.clip(np.where(L > 0.0, radiance * (L_d / safe), radiance), -largest, largest)


def displayed(linear: Array) -> Array:
    """Clamped to what a display can show."""
    return np.clip(linear, 0.0, 1.0)


def gamma_code(linear: Array, gamma: float | Array = 2.2) -> Array:
    """c^(1 / gamma)."""
    return displayed(linear) ** column(1.0 / np.asarray(gamma))


def srgb_code(linear: Array) -> Array:
    """IEC 61966-2-1: 12.92 c up to 0.0031308, then 1.055 c^(1 / 2.4) - 0.055."""
    c = displayed(linear)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1.0 / 2.4) - 0.055)


def white_above_1(radiance: Array) -> Array:
    """White where a channel is above 1 and all are a picture's light."""
    over = (np.max(radiance, axis=-1) > 1.0) & (invalid(radiance) == 0.0)
    return np.where(column(over), 1.0, radiance)


TONEMAPS: dict[str, Callable[..., Array]] = {
    "lab_white": white_above_1,
    "none": identity,
    "reinhard": reinhard,
    "reinhard_extended": reinhard_extended,
}
TRANSFERS: dict[str, Callable[..., Array]] = {
    "gamma": gamma_code,
    "linear": displayed,
    "srgb": srgb_code,
    "srgb_pow": srgb_code,
}


def rounded(code: Array, pixel: Array) -> Array:
    """The code as it is: the target rounds it."""
    return code


def truncated(code: Array, pixel: Array) -> Array:
    """floor(255 c) / 255."""
    return np.floor(255.0 * code) / 255.0


def bayer(side: int) -> Array:
    """Ranks 0 to side^2 - 1, [y, x], by M_2n = [[4M, 4M + 2], [4M + 3, 4M + 1]]: Bayer 1973."""
    if side == 1:
        return np.zeros((1, 1))
    part = 4.0 * bayer(side // 2)
    return np.block([[part, part + 2.0], [part + 3.0, part + 1.0]])


def dithered(code: Array, pixel: Array) -> Array:
    """floor(255 c + (M + 1/2) / 64) / 255, M of the pixel in the 8 x 8 matrix."""
    x, y = pixel.astype(int).T % 8
    threshold = (bayer(8)[y, x] + 0.5) / 64.0
    return np.asarray(np.floor(255.0 * code + threshold[:, None]) / 255.0)


QUANTISATIONS: dict[str, Callable[..., Array]] = {
    "ordered": dithered,
    "round": rounded,
    "truncate": truncated,
}


def final_view(
    radiance: Array, tonemap: str = "none", transfer: str = "srgb", exposure: float | Array = 0.0
) -> Array:
    """transfer(tonemap(radiance 2^exposure))."""
    return TRANSFERS[transfer](TONEMAPS[tonemap](radiance * column(2.0 ** np.asarray(exposure))))


def flag_invalid(radiance: Array, otherwise: Array) -> Array:
    """NaN magenta, infinite yellow, negative cyan, in this order."""
    flags = [
        np.isnan(radiance).any(axis=-1, keepdims=True),
        np.isinf(radiance).any(axis=-1, keepdims=True),
        (radiance < 0.0).any(axis=-1, keepdims=True),
    ]
    loud = [np.array(color) for color in ([1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0])]
    return np.select(flags, loud, otherwise)


def invalid_view(radiance: Array) -> Array:
    """The loud colours over a grey of sqrt(L / (1 + L)) / 4."""
    with np.errstate(invalid="ignore"):
        L = luminance(radiance)
        grey = column(0.25 * np.sqrt(L / (1.0 + L)))
    return flag_invalid(radiance, np.repeat(grey, 3, axis=-1))


def invalid(radiance: Array) -> Array:
    """1 where a channel is NaN, infinite or negative."""
    bad = ~np.isfinite(radiance) | (radiance < 0.0)
    return np.where(bad.any(axis=-1), 1.0, 0.0)


def has_tone(Y: Array) -> Array:
    """1 for a finite luminance above 0."""
    return (np.isfinite(Y) & (Y > 0.0)).astype(np.float64)


def display_range(linear: Array) -> Array:
    """Clamped to [0, 1]; magenta where a channel is NaN."""
    magenta = np.array([1.0, 0.0, 1.0])
    nan = np.isnan(linear).any(axis=-1, keepdims=True)
    return np.where(nan, magenta, np.clip(linear, 0.0, 1.0))
