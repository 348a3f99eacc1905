"""Random fields that tile, on a square grid of n x n texels.

Every field is a float64 array (n, n). Rows grow downward with v, columns to the right with u, both
running from 0 to 1 over the texture. Randomness comes only from the generator that is passed in.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Cells",
    "Floats",
    "Ints",
    "blur",
    "grid",
    "level",
    "mix",
    "ridges",
    "sample",
    "smooth",
    "spectral",
    "strokes",
    "worley",
]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class Cells(NamedTuple):
    """Worley cells: distances to the nearest and second nearest point, and the nearest's number.

    `nearest` and `second` are in units of the texture's edge; `cell` counts along rows.
    `du` and `dv` lead from the nearest point to the texel.
    """

    nearest: Floats
    second: Floats
    cell: Ints
    du: Floats
    dv: Floats


def grid(n: int) -> tuple[Floats, Floats]:
    """(u, v) of the texel centres, each (n, n) in 0..1."""
    centres = (np.arange(n) + 0.5) / n
    u, v = np.meshgrid(centres, centres)
    return u, v


def smooth(low: float | Floats, high: float | Floats, x: Floats) -> Floats:
    """The cubic step from 0 at `low` to 1 at `high`; falls where `low` lies above `high`."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t))


def mix(a: Floats | float, b: Floats | float, t: Floats) -> Floats:
    """a where t is 0, b where t is 1; the fields a and b may carry a last axis of channels."""
    wide = max(np.ndim(a), np.ndim(b)) > np.ndim(t) or (np.ndim(a) == 1 or np.ndim(b) == 1)
    weight = t[..., None] if wide else t
    return np.asarray(a * (1 - weight) + b * weight)


def level(field: Floats) -> Floats:
    """A field of mean 0 and deviation 1 spread about evenly over 0..1 (logistic curve)."""
    return np.asarray(1 / (1 + np.exp(-1.702 * field)))


def spectral(
    rng: np.random.Generator,
    n: int,
    slope: float,
    *,
    low: float = 1.0,
    high: float | None = None,
    stretch: tuple[float, float] = (1.0, 1.0),
) -> Floats:
    """Gaussian noise of mean 0, deviation 1 and amplitude 1 / f^slope between two frequencies.

    `low` and `high` (n / 3 unless given) count periods across the texture. `stretch` says how many
    times longer a feature is along u and along v. It tiles because its spectrum is discrete.
    """
    fu = np.fft.rfftfreq(n, 1 / n) * stretch[0]
    fv = np.fft.fftfreq(n, 1 / n)[:, None] * stretch[1]
    f = np.hypot(fu, fv)
    f[0, 0] = np.inf
    gain = f**-slope * np.exp(-((0.7 * low / f) ** 4) - (f / (high or n / 3)) ** 4)
    gain[0, 0] = 0
    field = np.fft.irfft2(np.fft.rfft2(rng.standard_normal((n, n))) * gain, (n, n))
    return np.asarray(field / field.std())


def ridges(field: Floats, width: float = 1.0) -> Floats:
    """1 along the zero lines of a field of deviation 1, falling to 0 within `width` of it."""
    return np.asarray(np.clip(1 - np.abs(field) / width, 0, 1))


def blur(field: Floats, across: float, down: float | None = None) -> Floats:
    """The field under a wrapped Gaussian of these deviations, in texels along u and along v."""
    n = field.shape[0]
    fu = np.fft.rfftfreq(n)
    fv = np.fft.fftfreq(n)[:, None]
    along = across if down is None else down
    gain = np.exp(-2 * np.pi**2 * ((fu * across) ** 2 + (fv * along) ** 2))
    return np.asarray(np.fft.irfft2(np.fft.rfft2(field) * gain, field.shape))


def sample(field: Floats, u: Floats, v: Floats) -> Floats:
    """The field at (u, v), bilinear between texel centres and wrapped at the edges."""
    n = field.shape[0]
    x, y = u * n - 0.5, v * n - 0.5
    left, top = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = x - left, y - top
    x0, x1, y0, y1 = left % n, (left + 1) % n, top % n, (top + 1) % n
    above = field[y0, x0] * (1 - fx) + field[y0, x1] * fx
    below = field[y1, x0] * (1 - fx) + field[y1, x1] * fx
    return np.asarray(above * (1 - fy) + below * fy)


def worley(
    rng: np.random.Generator,
    u: Floats,
    v: Floats,
    across: int,
    down: int,
    *,
    jitter: float = 1.0,
) -> Cells:
    """One point in each of `across` x `down` boxes, up to `jitter` from its middle to its wall."""
    points = 0.5 + (rng.random((down, across, 2)) - 0.5) * jitter
    shape = u.shape
    nearest, second = np.full(shape, np.inf), np.full(shape, np.inf)
    index, du, dv = np.zeros(shape, dtype=np.int64), np.zeros(shape), np.zeros(shape)
    column, row = np.floor(u * across).astype(int), np.floor(v * down).astype(int)
    for i, j in _neighbours():
        c, r = column + i, row + j
        point = points[r % down, c % across]
        x, y = u - (c + point[..., 0]) / across, v - (r + point[..., 1]) / down
        distance = np.hypot(x, y)
        closer = distance < nearest
        second = np.where(closer, nearest, np.minimum(second, distance))
        nearest = np.where(closer, distance, nearest)
        index = np.where(closer, (r % down) * across + c % across, index)
        du, dv = np.where(closer, x, du), np.where(closer, y, dv)
    return Cells(nearest, second, index, du, dv)


def _neighbours() -> Iterator[tuple[int, int]]:
    return ((i, j) for j in (-1, 0, 1) for i in (-1, 0, 1))


def strokes(
    rng: np.random.Generator,
    n: int,
    count: int,
    *,
    length: tuple[float, float],
    angle: tuple[float, float],
    width: float,
) -> Floats:
    """The strongest of `count` straight scratches at each texel, 0..1, wrapped at the edges.

    `length` is a range in texture edges, `angle` the mean and deviation from u in radians, `width`
    in texels. A scratch fades out at its ends.
    """
    field = np.zeros((n, n))
    for _ in range(count):
        start, turn = rng.random(2) * n, rng.normal(*angle)
        reach, strength = rng.uniform(*length) * n, rng.uniform(0.2, 1.0)
        steps = np.arange(0, reach, 0.5)
        x, y = start[0] + steps * np.cos(turn), start[1] + steps * np.sin(turn)
        fade = strength * np.sin(np.pi * (steps + 0.5) / (reach + 1)) ** 0.5
        for offset in range(-2, 3):
            rows = np.floor(y).astype(int) + offset
            inside = np.exp(-(((rows + 0.5 - y) / width) ** 2)) * fade
            np.maximum.at(field, (rows % n, np.floor(x).astype(int) % n), inside)
    return field
