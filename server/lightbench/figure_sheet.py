"""A figure as one picture: its cells in rows under their labels, and its caption below."""

from collections.abc import Iterator, Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow
from PIL import ImageDraw, ImageFont

from lightbench.errors import LightbenchError
from lightbench.figures import Cell, Figure, picture

__all__ = ["sheet"]

Codes = NDArray[np.uint8]
# A neutral middle grey, on which light and dark pictures are both seen as they are.
GROUND, INK = "#8c8c8c", "#101010"
MARGIN, GAP = 18, 8
TITLE, LABEL, CAPTION = 21, 15, 15
# From one line of text to the next, as a multiple of its size.
LEADING = 1.4


def sheet(name: str, figure: Figure) -> Codes:
    """Render and lay out a figure: (H, W, 3) display codes. Raises LightbenchError."""
    grid = figure.grid()
    try:
        shown = [[_codes(cell, figure.size) for cell in row] for row in grid]
    except LightbenchError as error:
        raise type(error)(f"figure {name}: {error}") from None
    return _composed(f"Figure {name}   {figure.title}", figure, grid, shown)


def _codes(cell: Cell, size: tuple[int, int]) -> Codes | None:
    return None if cell.blank else picture(cell, size).display


class _Layout:
    """Where everything lies, in pixels from the upper left corner."""

    def __init__(self, figure: Figure, grid: Sequence[Sequence[Cell]]) -> None:
        self.cell = figure.size
        width, height = figure.size
        self.left = MARGIN + _line(LABEL) * any(row.label for row in figure.rows)
        self.width = self.left + len(grid[0]) * (width + GAP) - GAP + MARGIN
        y = MARGIN + _line(TITLE) + GAP // 2
        self.heads = y
        y += _line(LABEL) * any(column.label for column in figure.columns)
        self.tops, self.labels = [], []
        for row in grid:
            self.tops.append(y)
            y += height
            self.labels.append(y + 3)
            y += GAP + _line(LABEL) * any(cell.label for cell in row)
        self.caption = y + GAP // 2
        self.lines = _wrapped(figure.caption, self.width - 2 * MARGIN)
        self.height = self.caption + len(self.lines) * _line(CAPTION) + MARGIN - GAP

    def x(self, column: int) -> int:
        """Of a column's left edge."""
        return self.left + column * (self.cell[0] + GAP)


def _composed(
    title: str,
    figure: Figure,
    grid: Sequence[Sequence[Cell]],
    shown: Sequence[Sequence[Codes | None]],
) -> Codes:
    layout = _Layout(figure, grid)
    page = Pillow.new("RGB", (layout.width, layout.height), GROUND)
    for codes, x, y in _places(layout, shown):
        page.paste(Pillow.fromarray(codes), (x, y))
    _write(page, layout, title, figure, grid)
    return np.asarray(page)


def _places(
    layout: _Layout, shown: Sequence[Sequence[Codes | None]]
) -> Iterator[tuple[Codes, int, int]]:
    for y, row in zip(layout.tops, shown, strict=True):
        for column, codes in enumerate(row):
            if codes is not None:
                yield codes, layout.x(column), y


def _write(
    page: Pillow.Image, layout: _Layout, title: str, figure: Figure, grid: Sequence[Sequence[Cell]]
) -> None:
    draw = ImageDraw.Draw(page)
    middle = layout.cell[0] // 2
    draw.text((MARGIN, MARGIN - 4), title, INK, _font(TITLE))
    for index, column in enumerate(figure.columns):
        draw.text((layout.x(index) + middle, layout.heads), column.label, INK, _font(LABEL), "ma")
    for y, cells in zip(layout.labels, grid, strict=True):
        for index, cell in enumerate(cells):
            draw.text((layout.x(index) + middle, y), cell.label, INK, _font(LABEL), "ma")
    for y, row in zip(layout.tops, figure.rows, strict=True):
        _beside(page, row.label, y + layout.cell[1] // 2)
    for number, line in enumerate(layout.lines):
        y = layout.caption + number * _line(CAPTION)
        draw.text((MARGIN, y), line, INK, _font(CAPTION))


def _beside(page: Pillow.Image, text: str, middle: int) -> None:
    """A row's label, read from below, centred on its pictures."""
    if not text:
        return
    length = int(_font(LABEL).getlength(text)) + 2
    strip = Pillow.new("RGB", (length, _line(LABEL)), GROUND)
    ImageDraw.Draw(strip).text((1, 0), text, INK, _font(LABEL))
    page.paste(strip.transpose(Pillow.Transpose.ROTATE_90), (MARGIN - 4, middle - length // 2))


def _wrapped(text: str, width: int) -> list[str]:
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and _font(CAPTION).getlength(longer) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def _line(size: int) -> int:
    return round(size * LEADING)


@cache
def _font(size: int) -> ImageFont.FreeTypeFont:
    """Pillow's own, laid out alike wherever it is installed."""
    font = ImageFont.load_default(size)
    assert isinstance(font, ImageFont.FreeTypeFont)
    return font.font_variant(layout_engine=ImageFont.Layout.BASIC)
