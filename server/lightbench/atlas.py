"""The stability atlas: how far each shader function is from the truth, over two of its inputs.

Every point of a sweep is computed on the GPU in float32 and in emulated half precision and compared
with the exact form in float64. An error is given in ULP, the step between neighbouring numbers of
that precision at the true value: 0.5 is the best there is.
"""

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.exact import Array, reference
from lightbench.glsl import call
from lightbench.library import Library
from lightbench.options import version
from lightbench.render import on_gl_thread, renderer
from lightbench.sweep import Input, Sweep, points
from lightbench.sweep_arguments import arguments, doubled

__all__ = ["KINDS", "PRECISIONS", "Map", "Panel", "Precision", "as_json", "chart"]

# What a point of a panel is; the last is where the truth is infinite too.
KINDS = ("finite", "nan", "inf", "negative", "unknown")
FINITE, NAN, INF, NEGATIVE, UNKNOWN = range(5)
# From this relative error on a result is called wrong.
WRONG = 0.01


@dataclass(frozen=True)
class Precision:
    """A floating-point format: its significant bits and its smallest normal number.

    What is below `negligible` may be anything as small: no light that a picture could show.
    """

    name: str
    bits: int
    tiny: float
    negligible: float
    half: bool

    @property
    def full(self) -> float:
        """ULP in the value itself: from this error on no digit is right."""
        return float(2.0 ** (self.bits - 1))

    def ulp(self, want: Array) -> Array:
        """The step between neighbouring numbers at a value."""
        _, exponent = np.frexp(np.maximum(np.abs(want), self.tiny))
        return np.asarray(np.ldexp(1.0, exponent - self.bits))


PRECISIONS = (
    Precision("float32", 24, 2.0**-126, 1e-30, half=False),
    Precision("half", 11, 2.0**-14, 0.0, half=True),
)


@dataclass(frozen=True)
class Panel:
    """One form in one precision: `ulp` and `kind` are (size, size), row 0 at the lowest y.

    `ulp` is the error where `kind` is FINITE, else 0; `wrong` says where it is beyond 1 %.
    """

    file: str
    precision: Precision
    ulp: Array
    kind: NDArray[np.uint8]
    wrong: NDArray[np.bool_]

    def share(self, *kinds: int) -> float:
        """The part of the points with a finite truth that are of these kinds."""
        known = self.kind != UNKNOWN
        return float(np.isin(self.kind[known], kinds).mean()) if known.any() else 0.0

    def summary(self) -> dict[str, float]:
        """Median and largest error in ULP, and the shares of what is wrong or not a valid value."""
        finite = self.ulp[self.kind == FINITE]
        known = self.kind != UNKNOWN
        return {
            "median_ulp": float(np.median(finite)) if finite.size else 0.0,
            "max_ulp": float(finite.max()) if finite.size else 0.0,
            "wrong": float(self.wrong[known].mean()) if known.any() else 0.0,
            **{name: self.share(code) for code, name in enumerate(KINDS[:UNKNOWN]) if code},
        }


@dataclass(frozen=True)
class Map:
    """A sweep and its panels: for each form, the textbook's first, one for each precision.

    `exact` says whether an exact form is known. Without one float32 shows only what is no valid
    value, and half precision is compared with float32.
    """

    sweep: Sweep
    title: str
    panels: tuple[Panel, ...]
    exact: bool

    def panel(self, file: str, precision: str) -> Panel:
        """The panel of a form in a precision."""
        found = (p for p in self.panels if (p.file, p.precision.name) == (file, precision))
        return next(found)


def chart(library: Library, sweep: Sweep, size: int, shaders: Path | None = None) -> Map:
    """Compute the panels of a sweep on a grid of size x size points."""
    values = points(sweep, size)
    panels = []
    exact = reference(library, sweep.file, sweep.function)
    for file in filter(None, (sweep.textbook, sweep.file)):
        given = arguments(library, sweep, file, values)
        results = {
            p.name: call(
                file, sweep.function, *given[0], settings=given[1], shaders=shaders, half=p.half
            ).astype(np.float64)
            for p in PRECISIONS
        }
        want = results["float32"]
        if exact is not None:
            first, settings = doubled(given)
            with np.errstate(all="ignore"):
                want = np.asarray(exact(*first, **settings))
        panels += [_panel(file, p, results[p.name], want, size) for p in PRECISIONS]
    meta = library.files[sweep.file].meta
    return Map(sweep, meta.title or sweep.file, tuple(panels), exact is not None)


def _grid(values: Array, size: int) -> Array:
    """Values (N,) or (N, K) as (size, size, K); of a constant there is one row."""
    return np.broadcast_to(values, (size * size, *values.shape[1:])).reshape(size, size, -1)


def _panel(file: str, precision: Precision, got: Array, want: Array, size: int) -> Panel:
    """Compare; of a vector's components the worst counts."""
    got, want = _grid(got, size), _grid(want, size)
    known = np.isfinite(want) & (np.abs(want) <= np.finfo(np.float32).max)
    truth = np.where(known, want, 0.0)
    with np.errstate(all="ignore"):
        off = np.where(np.isfinite(got) & known, np.abs(got - truth), 0.0)
        negative = (got < 0.0) & (truth >= 0.0)
    off[np.maximum(np.abs(truth), np.abs(got)) < precision.negligible] = 0.0
    kind = np.select(
        [~known.all(axis=-1), np.isnan(got).any(axis=-1), np.isinf(got).any(axis=-1),
         negative.any(axis=-1)],
        [UNKNOWN, NAN, INF, NEGATIVE], FINITE,
    ).astype(np.uint8)  # fmt: skip
    ulp = np.where(kind == FINITE, (off / precision.ulp(truth)).max(axis=-1), 0.0)
    beyond = (off > WRONG * np.maximum(np.abs(truth), precision.tiny)).any(axis=-1)
    wrong = beyond | (kind == NAN) | (kind == INF) | (kind == NEGATIVE)
    return Panel(file, precision, ulp, kind, wrong)


def as_json(maps: Iterable[Map]) -> dict[str, Any]:
    """Everything for machines: versions, renderer, and for each map its axes, figures and grids.

    A grid is a list of rows, the lowest y first; a point is its error in ULP to three digits, or
    "nan", "inf", "negative", or null where the truth is not finite.
    """
    name, gl = on_gl_thread(lambda: (renderer().name, renderer().version))
    return {
        "lightbench": version(),
        "numpy": np.__version__,
        "renderer": name,
        "opengl": gl,
        "precisions": [asdict(p) for p in PRECISIONS],
        "maps": [_map_json(each) for each in maps],
    }


def _map_json(each: Map) -> dict[str, Any]:
    sweep, size = each.sweep, len(each.panels[0].ulp)
    return {
        "file": sweep.file,
        "function": sweep.function,
        "title": each.title,
        "textbook": sweep.textbook or None,
        "exact": each.exact,
        "x": _axis_json(sweep.axis(sweep.x), size),
        "y": _axis_json(sweep.axis(sweep.y), size),
        "fixed": {i.name: i.at for i in sweep.inputs if i.name not in (sweep.x, sweep.y)},
        "panels": [
            {"file": p.file, "precision": p.precision.name, **p.summary(), "grid": _grid_json(p)}
            for p in each.panels
        ],
    }


def _axis_json(axis: Input, size: int) -> dict[str, Any]:
    return asdict(axis) | {"values": axis.samples(size).tolist()}


def _grid_json(panel: Panel) -> list[list[float | str | None]]:
    names: list[str | None] = [*KINDS[:UNKNOWN], None]
    return [
        [float(f"{u:.3g}") if k == FINITE else names[k] for u, k in zip(ulps, kinds, strict=True)]
        for ulps, kinds in zip(panel.ulp.tolist(), panel.kind.tolist(), strict=True)
    ]
