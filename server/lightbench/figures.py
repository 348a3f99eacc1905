"""Comparison figures: pictures side by side that make one statement, each a TOML file.

The folder is the list: `figures/3.1.toml` among the scenes is figure 3.1. A figure has rows and
columns; what a cell shows is what the figure says, then its column, its row, and the cell itself.
"""

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationError,
    model_validator,
)

from lightbench.errors import NotFoundError, SceneError
from lightbench.image import Image
from lightbench.paths import scenes_folder
from lightbench.scene import Scene
from lightbench.scene_file import read_scene
from lightbench.settings import Setting

__all__ = ["Cell", "Figure", "figure", "names", "picture"]


def _flat(value: object) -> object:
    """Nested tables as settings: `lights.key.intensity = 3` names one setting."""
    if not isinstance(value, dict):
        return value
    found: dict[str, object] = {}
    for name, given in value.items():
        inner = _flat(given)
        if isinstance(given, dict) and isinstance(inner, dict):
            found |= {f"{name}.{rest}": below for rest, below in inner.items()}
        else:
            found[name] = given
    return found


def _legible(text: str) -> str:
    """Text that the sheets' font has all characters of."""
    if lacking := re.findall(r"[^ -~°·]", text):
        raise ValueError(f"the font of the sheets has no {lacking[0]!r}")
    return text


Settings = Annotated[dict[str, Setting], BeforeValidator(_flat)]
Text = Annotated[str, AfterValidator(_legible)]
Side = Annotated[int, Field(ge=16, le=2048)]


class Cell(BaseModel):
    """A picture, or what several have in common.

    `scene` is a preset's name or a scene's own data. With `minus`, what is shown is `gain` times
    the linear difference to the same picture under these settings too. `blank` leaves it out.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    label: Text = ""
    scene: str | dict[str, Any] | None = None
    settings: Settings = {}
    minus: Settings | None = None
    gain: Annotated[float, Field(gt=0, le=1e6)] = 1.0
    blank: bool = False

    def under(self, outer: "Cell") -> "Cell":
        """This cell with what `outer` says wherever it says nothing itself."""
        given = {name: getattr(self, name) for name in self.model_fields_set}
        both = {**outer.settings, **self.settings}
        return outer.model_copy(update={**given, "settings": both, "label": self.label})


class Row(Cell):
    """Cells from left to right; none are as many as the columns."""

    cells: tuple[Cell, ...] = ()


class Figure(BaseModel):
    """A titled grid of pictures of `size` (width, height) pixels; `caption` says what to see."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    title: Text
    caption: Text
    size: tuple[Side, Side]
    scene: str | dict[str, Any] | None = None
    settings: Settings = {}
    columns: tuple[Cell, ...] = ()
    rows: tuple[Row, ...] = (Row(),)

    @model_validator(mode="after")
    def _whole(self) -> Self:
        counts = {len(self.columns) or len(row.cells) or 1 for row in self.rows}
        for index, row in enumerate(self.rows):
            if len(counts) > 1 or (row.cells and len(row.cells) not in counts):
                raise ValueError(
                    f"rows.{index}.cells: {len(row.cells)} cells where "
                    f"{len(self.columns) or max(counts)} columns are"
                )
        if any(cell.scene is None for row in self.grid() for cell in row):
            raise ValueError("scene: each picture needs one")
        return self

    def grid(self) -> list[list[Cell]]:
        """The cells of each row, complete."""
        base = Cell(scene=self.scene, settings=self.settings)
        return [self._row(row, base) for row in self.rows]

    def _row(self, row: Row, base: Cell) -> list[Cell]:
        cells = row.cells or (Cell(),) * (len(self.columns) or 1)
        columns = self.columns or (Cell(),) * len(cells)
        shared = Cell.model_validate(row.model_dump(exclude_unset=True, exclude={"cells"}))
        pairs = zip(cells, columns, strict=True)
        return [cell.under(shared.under(column.under(base))) for cell, column in pairs]


def names() -> list[str]:
    """Every figure's name, in the order of their numbers."""
    found = [path.stem for path in (scenes_folder() / "figures").glob("*.toml")]
    return sorted(found, key=lambda name: [int(n) for n in re.findall(r"\d+", name)] or [0])


def figure(name: str) -> Figure:
    """The figure of that name.

    Raises NotFoundError naming those there are, SceneError naming the field that does not hold.
    """
    if name not in names():
        raise NotFoundError(f"no figure '{name}'; there is: {', '.join(names())}")
    return _read(scenes_folder() / "figures" / f"{name}.toml")


def _read(path: Path) -> Figure:
    where = f"figures/{path.name}"
    try:
        return Figure.model_validate(tomllib.loads(path.read_text(encoding="utf-8")))
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        message = first["msg"].removeprefix("Value error, ")
        raise SceneError(f"{where}: {place + ': ' if place else ''}{message}") from None
    except (OSError, ValueError) as error:
        raise SceneError(f"{where}: not a TOML file: {error}") from None


def picture(cell: Cell, size: tuple[int, int], **more: Setting) -> Image:
    """What a cell shows, at `size` (width, height) pixels; `more` stands above its settings.

    A difference has no transfer: 0 to 1 are the display codes 0 to 255. Raises LightbenchError.
    """
    from lightbench import render

    scene = _scene(cell)
    shown = render(scene, size, **_above(cell.settings, more))
    if cell.minus is None:
        return shown
    other = render(scene, size, **_above(cell.settings, cell.minus, more))
    linear = (shown.linear - other.linear) * cell.gain
    return Image(linear, shown.display, shown.milliseconds, shown.renderer, True).as_stored()


def _scene(cell: Cell) -> Scene:
    if isinstance(cell.scene, str):
        return read_scene(cell.scene, scenes_folder())
    return Scene.parse(cell.scene)


def _above(*layers: Mapping[str, Setting]) -> dict[str, Setting]:
    """Settings under settings, the last one on top."""
    return {name: value for layer in layers for name, value in layer.items()}
