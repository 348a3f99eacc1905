"""Figures as data and as sheets: what is read, refused, laid out, written; and their goldens."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

from lightbench.errors import LightbenchError, NotFoundError, SceneError
from lightbench.figure_sheet import sheet
from lightbench.figures import Figure, figure, names, picture
from lightbench.golden import Golden
from tests.support import GOLDEN, PINNED, SCENES, driver
from tests.test_cli import lightbench, refusal
from tests.test_golden import LOOSE

# All of the thesis's that compare pictures; 4.17 is a panel of buttons.
THESIS = [f"3.{n}" for n in range(1, 5)] + [f"4.{n}" for n in range(2, 24) if n != 17]
# Of the lab: all its tables, and its figure of rays.
LAB = ["lab-tables", "lab-1.6"]
SMALL = """
title = "Two"
caption = "Left dark, right light."
scene = "single-sphere"
size = [40, 30]
columns = [{ label = "a", settings.exposure = -2 }, { label = "b", settings.exposure = 1 }]
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of scenes with one preset and the figure "1"."""
    root = tmp_path / "scenes"
    (root / "figures").mkdir(parents=True)
    (root / "single-sphere.json").write_text((SCENES / "single-sphere.json").read_text())
    (root / "figures" / "1.toml").write_text(SMALL)
    monkeypatch.setenv("LIGHTBENCH_SCENES", str(root))
    return root


def test_every_figure_is_there() -> None:
    assert names() == [*LAB, *THESIS]
    assert {path.stem for path in (GOLDEN / "figures").glob("*.png")} == {*LAB, *THESIS}


@pytest.mark.parametrize("name", [*LAB, *THESIS])
def test_golden(name: str, golden: Golden) -> None:
    own = dataclasses.replace(golden, folder=golden.folder / "figures")
    codes = sheet(name, figure(name))
    assert codes.shape[1] <= 920
    own(codes, name, **({} if driver() == PINNED else LOOSE))


def test_a_cell_is_figure_then_column_then_row_then_itself() -> None:
    made = Figure.model_validate({
        "title": "t", "caption": "c", "size": [32, 32], "scene": "spheres",
        "settings": {"samples": 2, "lights": {"key": {"intensity": 1}}},
        "columns": [{"settings": {"samples": 3}}, {"scene": "metals"}],
        "rows": [{"settings": {"tonemap": "none"}}, {"cells": [{}, {"settings": {"samples": 4}}]}],
    })  # fmt: skip
    grid = made.grid()
    assert grid[0][0].settings == {"samples": 3, "lights.key.intensity": 1, "tonemap": "none"}
    assert grid[1][1].settings == {"samples": 4, "lights.key.intensity": 1}
    assert [cell.scene for cell in grid[0]] == ["spheres", "metals"]


def test_a_figure_dropped_in_is_drawn(folder: Path, tmp_path: Path) -> None:
    """The pictures stand side by side as they are rendered, the second one lighter."""
    assert names() == ["1"]
    assert lightbench("figures", str(tmp_path / "out" / "deep"), "--scenes", str(folder)) == 0
    [path] = (tmp_path / "out" / "deep").iterdir()
    assert path.name == "figure-1.png"
    codes = np.asarray(Pillow.open(path))
    left, right = (picture(cell, (40, 30)).display for cell in figure("1").grid()[0])
    assert right.mean() > 2 * left.mean()
    for shown in (left, right):
        windows = np.lib.stride_tricks.sliding_window_view(codes, shown.shape)
        assert (windows == shown).all(axis=(3, 4, 5)).any()


def test_the_list_and_the_captions(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    assert lightbench("figures", "--list") == 0
    assert capsys.readouterr().out == "1       Two\n"
    assert lightbench("figures", str(folder / "out"), "--only", "1") == 0
    assert capsys.readouterr().out.endswith("figure-1.png  Left dark, right light.\n")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("title = [", "figures/1.toml: not a TOML file"),
        (SMALL + "colour = 3", "figures/1.toml: colour: Extra inputs are not permitted"),
        (SMALL.replace("30]", "9999]"), "figures/1.toml: size.1: Input should be less than"),
        (SMALL.replace('scene = "single-sphere"', ""), "figures/1.toml: scene: each picture needs"),
        (SMALL.replace("Two", "Două"), "figures/1.toml: title: the font of the sheets has no 'ă'"),
        (SMALL + "[[rows]]\ncells = [{}]", "figures/1.toml: rows.0.cells: 1 cells where 2 columns"),
    ],
)
def test_what_is_wrong_in_a_figure_is_said(folder: Path, text: str, message: str) -> None:
    (folder / "figures" / "1.toml").write_text(text)
    with pytest.raises(SceneError) as refused:
        figure("1")
    assert str(refused.value).startswith(message)


def test_what_cannot_be_drawn_names_the_figure(
    capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    (folder / "figures" / "1.toml").write_text(SMALL.replace("exposure = 1 ", "exposed = 1 "))
    error = refusal(capsys, "figures", str(folder / "out"))
    assert "figure 1: no setting 'exposed'" in error
    assert not (folder / "out").exists()
    assert "no figure '9'; there is: 1" in refusal(capsys, "figures", "--only", "9")
    with pytest.raises(NotFoundError):
        figure("../1")


def test_a_difference_is_scaled_and_shown_as_it_is() -> None:
    data = {"scene": "single-sphere", "settings": {"samples": 1}, "minus": {"exposure": 1}}
    cell = Figure.model_validate(
        {"title": "t", "caption": "c", "size": [20, 20], "rows": [data]}
    ).grid()[0][0]
    assert (picture(cell, (20, 20)).display == 0).all()  # exposure is of the display alone
    darker = cell.model_copy(update={"minus": {"lights.key.intensity": 0}, "gain": 0.5})
    shown = picture(darker, (20, 20))
    assert shown.display == pytest.approx(np.clip(shown.linear, 0, 1) * 255, abs=0.51)
    assert shown.linear.max() > 0.1


def test_blank_cells_stay_ground() -> None:
    made = Figure.model_validate({
        "title": "t", "caption": "c", "size": [40, 40], "scene": "single-sphere",
        "rows": [{"cells": [{"blank": True}, {}]}],
    })  # fmt: skip
    codes = sheet("0", made)
    assert (codes[60:80, 20:50] == codes[0, 0]).all()
    with pytest.raises(LightbenchError, match="figure 0: "):
        sheet("0", made.model_copy(update={"scene": "nowhere"}))
