"""The atlas as pictures: heat maps on neutral grey, drawn by Matplotlib."""

import io
import itertools
import math
from collections.abc import Iterator, Sequence
from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure, SubFigure
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray
from PIL import Image as Pillow

from lightbench.atlas import INF, NAN, NEGATIVE, PRECISIONS, UNKNOWN, Map, Panel, Precision
from lightbench.sweep import Input

__all__ = ["INK", "LOUD", "PAGE", "legend", "overview", "stacked", "strip"]

PAGE, INK, LINE = "#b8b8b8", "#161616", "#5a5a5a"
# From exact to no digit right, lightness rising evenly, so that grey eyes and printers see it too;
# its hue leaves magenta, yellow and cyan to what is no valid value, as in the view `invalid`.
RAMP = LinearSegmentedColormap.from_list(
    "ulp", ["#10131c", "#1d2a52", "#2c568d", "#5d8dbd", "#a8c1d9", "#f6f7f8"], N=160
)
LOUD = {NAN: "#ff00ff", INF: "#ffff00", NEGATIVE: "#00ffff", UNKNOWN: "#8a8a8a"}
LOUD_NAMES = {NAN: "NaN", INF: "infinite", NEGATIVE: "negative", UNKNOWN: "infinite in truth"}
DPI = 110
SIDE = 2.15  # inches of a panel
SMALL, LARGE = 7.0, 9.5
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def strip(each: Map) -> bytes:
    """A PNG of one map: the textbook form and ours in float32, then both in half precision."""
    panels = [p for precision in PRECISIONS for p in each.panels if p.precision is precision]
    side = SIDE + 0.62
    figure = _figure(side * len(panels), SIDE + 0.85)
    grid = figure.subplots(
        1, len(panels), squeeze=False,
        gridspec_kw={"left": 0.62 / side / len(panels), "right": 1.0 - 0.1 / side / len(panels),
                     "top": 0.81, "bottom": 0.16, "wspace": 0.62 / SIDE},
    )[0]  # fmt: skip
    for axes, panel in zip(grid, panels, strict=True):
        _panel(axes, each, panel, x_labels=True)
        form = ""
        if each.sweep.textbook:
            form = "textbook, " if panel.file == each.sweep.textbook else "ours, "
        axes.set_title(form + panel.precision.name, fontsize=SMALL + 1.0, pad=3)
    grid[0].set_ylabel(_label(each.sweep.axis(each.sweep.y)), fontsize=SMALL + 0.5)
    figure.text(
        0.1 / side / len(panels), 0.93, f"{each.title}: {each.sweep.function}",
        fontsize=LARGE, weight="bold", color=INK,
    )  # fmt: skip
    return _png(figure)


def stacked(pictures: Sequence[bytes]) -> bytes:
    """PNGs one below the other, and beside one another where there is room."""
    images = [Pillow.open(io.BytesIO(picture)).convert("RGB") for picture in pictures]
    width = max(image.width for image in images)
    places, left, top, bottom = [], 0, 0, 0
    for image in images:
        if left + image.width > width:
            left, top = 0, bottom
        places.append((left, top))
        left, bottom = left + image.width, max(bottom, top + image.height)
    whole = Pillow.new("RGB", (width, bottom), PAGE)
    for image, place in zip(images, places, strict=True):
        whole.paste(image, place)
    return _encoded(whole)


def overview(maps: Sequence[Map]) -> bytes:
    """A PNG with a column for each textbook form, above ours, where it is wrong most."""
    pairs = list(_worst(maps))
    kinds = [(textbook, precision) for precision in PRECISIONS for textbook in (True, False)]
    side, foot = 1.45, 0.75
    height = (side + 0.12) * len(kinds) + 1.05
    figure = _figure((side + 0.5) * len(pairs) + 0.6, height + foot)
    (body,), (below,) = figure.subfigures(2, 1, squeeze=False, height_ratios=[height, foot])
    grid = body.subplots(
        len(kinds), len(pairs), squeeze=False,
        gridspec_kw={"left": 0.065, "right": 0.99, "top": 0.93, "bottom": 0.085,
                     "wspace": 0.42, "hspace": 0.1},
    )  # fmt: skip
    body.set_facecolor(PAGE)
    for (row, (textbook, precision)), (column, each) in itertools.product(
        enumerate(kinds), enumerate(pairs)
    ):
        axes = grid[row, column]
        file = each.sweep.textbook if textbook else each.sweep.file
        _panel(axes, each, each.panel(file, precision.name), x_labels=row == len(kinds) - 1)
        axes.set_ylabel(_label(each.sweep.axis(each.sweep.y)), fontsize=SMALL, labelpad=1)
        if not row:
            name = each.title.partition(" (")[0]
            axes.set_title(f"{name}\n{each.sweep.function}", fontsize=LARGE - 1.0)
        if not column:
            axes.annotate(
                f"{'textbook' if textbook else 'ours'}\n{precision.name}", (-0.52, 0.5),
                xycoords="axes fraction", rotation=90, ha="center", va="center",
                fontsize=LARGE - 1.0, weight="bold",
            )  # fmt: skip
    _legend(below)
    return _png(figure)


def _worst(maps: Sequence[Map]) -> Iterator[Map]:
    """For each textbook form the map on which it is wrong most in float32."""
    for textbook in dict.fromkeys(each.sweep.textbook for each in maps if each.sweep.textbook):
        pair = [each for each in maps if each.sweep.textbook == textbook]
        yield max(pair, key=lambda each: each.panel(textbook, "float32").summary()["wrong"])


def legend() -> bytes:
    """A PNG with both scales and the loud colours."""
    figure = _figure(11.0, 0.75)
    _legend(figure)
    return _png(figure)


def _figure(width: float, height: float) -> Figure:
    return Figure(figsize=(width, height), dpi=DPI, facecolor=PAGE)


def _png(figure: Figure) -> bytes:
    canvas = FigureCanvasAgg(figure)
    canvas.draw()  # type: ignore[no-untyped-call]
    pixels = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    return _encoded(Pillow.fromarray(pixels).convert("RGB"))


def _encoded(image: Pillow.Image) -> bytes:
    """A PNG of the 256 colours that the atlas has: the ramp, the loud ones, and greys to write."""
    palette = _palette()
    # One number a colour, so that each that occurs is looked up once.
    codes = np.asarray(image).astype(np.int32) @ [1 << 16, 1 << 8, 1]
    found, where = np.unique(codes, return_inverse=True)
    colors = found[:, None] >> [16, 8, 0] & 255
    nearest = np.square(colors[:, None] - palette).sum(axis=-1).argmin(axis=-1).astype(np.uint8)
    indexed = Pillow.fromarray(nearest[where.reshape(codes.shape)])
    indexed.putpalette(palette.astype(np.uint8).tobytes())
    buffer = io.BytesIO()
    indexed.save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


@cache
def _palette() -> NDArray[np.int64]:
    ramp = RAMP(np.arange(RAMP.N), bytes=True)[:, :3]
    loud = [_rgb(name) for name in LOUD.values()]
    greys = np.linspace(_rgb(INK), _rgb(PAGE), 256 - len(ramp) - len(loud)).round()
    return np.concatenate([ramp, loud, greys]).astype(np.int64)


def _rgb(name: str) -> list[int]:
    return [int(name[at : at + 2], 16) for at in (1, 3, 5)]


def _panel(axes: Axes, each: Map, panel: Panel, *, x_labels: bool) -> None:
    size = len(panel.ulp)
    axes.imshow(colors(panel), origin="lower", extent=(0, size, 0, size), aspect="auto")
    for axis, name, set_ticks, line in (
        (axes.xaxis, each.sweep.x, axes.set_xticks, axes.axvline),
        (axes.yaxis, each.sweep.y, axes.set_yticks, axes.axhline),
    ):
        swept = each.sweep.axis(name)
        places, texts = zip(*_ticks(swept, size), strict=True)
        shown = x_labels or axis is axes.yaxis
        set_ticks(places, texts if shown else [""] * len(texts), fontsize=SMALL)
        axis.set_tick_params(length=2, width=0.5, color=LINE, labelcolor=INK, pad=1.5)
        if swept.zero:
            line(_band(swept, size), color=PAGE, linewidth=1.2)
    if x_labels:
        axes.set_xlabel(_label(each.sweep.axis(each.sweep.x)), fontsize=SMALL + 0.5, labelpad=1)
    for spine in axes.spines.values():
        spine.set(color=LINE, linewidth=0.5)


def colors(panel: Panel) -> NDArray[np.uint8]:
    """The colours of a panel, (size, size, 4), row 0 at the lowest y."""
    shade = np.log10(np.maximum(panel.ulp, 1.0)) / math.log10(panel.precision.full)
    found: NDArray[np.uint8] = RAMP(np.minimum(shade, 1.0), bytes=True)
    for kind, name in LOUD.items():
        found[panel.kind == kind, :3] = _rgb(name)
    return found


def _label(axis: Input) -> str:
    return f"{axis.label} [{axis.unit}]" if axis.unit else axis.label


def _band(axis: Input, size: int) -> int:
    return int(np.count_nonzero(axis.samples(size) == 0.0))


def _ticks(axis: Input, size: int) -> Iterator[tuple[float, str]]:
    """Places along an axis of `size` points and what to write there."""
    band = _band(axis, size) if axis.zero else 0
    if axis.zero:
        yield band / 2, "0"
    low, high = (math.log10(axis.low), math.log10(axis.high)) if axis.log else (axis.low, axis.high)

    def place(value: float) -> float:
        return band + (value - low) / (high - low) * (size - band)

    if not axis.log:
        for value in MaxNLocator(4).tick_values(low, high):
            if low <= value <= high:
                yield place(float(value)), f"{value:g}"
        return
    decades = range(math.ceil(low - 1e-9), math.floor(high + 1e-9) + 1)
    for decade in decades[:: -max(1, math.ceil(len(decades) / 5))]:
        if not axis.zero or place(float(decade)) - band / 2 > 0.09 * size:
            yield place(float(decade)), _power(decade)


def _power(decade: int) -> str:
    return f"{10.0**decade:g}" if -2 <= decade <= 2 else "10" + str(decade).translate(SUPERSCRIPT)


def _legend(figure: Figure | SubFigure) -> None:
    """Both scales over one ramp, and the loud colours beside it."""
    figure.set_facecolor(PAGE)
    ramp = figure.add_axes((0.1, 0.42, 0.42, 0.2))
    ramp.imshow(RAMP(np.linspace(0.0, 1.0, 256))[None], aspect="auto", extent=(0, 1, 0, 1))
    ramp.set_yticks([])
    below = ramp
    above = ramp.secondary_xaxis("top")
    for axes, precision in ((below, PRECISIONS[0]), (above, PRECISIONS[1])):
        places, texts = zip(*_scale(precision), strict=True)
        axes.set_xticks(places, texts, fontsize=SMALL)
        axes.tick_params(length=2, width=0.5, color=LINE, labelcolor=INK, pad=1.5)
    figure.text(0.085, 0.17, "ULP in float32", fontsize=SMALL, ha="right", color=INK)
    figure.text(0.085, 0.7, "ULP in half", fontsize=SMALL, ha="right", color=INK)
    handles = [Patch(facecolor=LOUD[k], edgecolor=LINE, label=t) for k, t in LOUD_NAMES.items()]
    figure.legend(
        handles=handles, loc="center left", bbox_to_anchor=(0.56, 0.5), ncols=4, fontsize=SMALL + 1,
        frameon=False, handlelength=1.2, handleheight=1.2, columnspacing=1.2,
    )  # fmt: skip


def _scale(precision: Precision) -> Iterator[tuple[float, str]]:
    digits = math.log10(precision.full)
    for decade in range(math.floor(digits) + 1):
        yield decade / digits, _power(decade) if decade else "≤ 1"
    if digits - math.floor(digits) > 0.5:
        yield 1.0, "no digit"
