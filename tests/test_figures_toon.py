"""What the figures of drawings state, measured: the normals, the lines, the tones."""

import numpy as np
import pytest

from lightbench.settings import Setting
from tests.test_figures import Mask, Values, cell, gray, linear

SIZE = (430, 270)


def near(mask: Mask) -> Mask:
    """What is in the mask or a pixel away from it."""
    padded = np.pad(mask, 1)
    rows, columns = mask.shape
    shifted = [padded[y : y + rows, x : x + columns] for y in range(3) for x in range(3)]
    grown: Mask = np.any(shifted, axis=0)
    return grown


def lines(row: int) -> Mask:
    """Where figure 4.22 has a line: black on white."""
    shown = gray(cell("4.22", row), SIZE)
    lit = gray(cell("4.22", row), SIZE, outline="none")
    drawn: Mask = (shown == 0) & (lit > 0)
    return drawn


def jumps(share: float) -> Mask:
    """Pixels whose right or lower neighbour is nearer or farther by a share at least."""
    away = np.log(np.maximum(gray(cell("4.21", 0), SIZE, view="depth"), 1e-3))
    return changes(away[..., None], np.log1p(share))


def changes(values: Values, least: float) -> Mask:
    """Pixels that differ from their right or lower neighbour by more than `least`."""
    found = np.zeros(values.shape[:2], bool)
    for axis in (0, 1):
        step = np.abs(np.diff(values, axis=axis)).max(axis=2) > least
        found |= np.pad(step, [(0, int(axis == 0)), (0, int(axis == 1))])
    return found


def test_normals_are_unit() -> None:
    lengths = np.linalg.norm(linear(cell("4.21", 0), SIZE), axis=2)
    sky = lengths[0, 0]
    assert (np.abs(lengths - 1) < 1e-3).mean() > 0.6
    assert ((np.abs(lengths - 1) < 1e-3) | (lengths == sky)).all()


def test_lines_lie_on_silhouettes() -> None:
    """Where the distance jumps by a third there is a line; the normals alone miss some."""
    silhouette = jumps(1 / 3)
    assert silhouette.sum() > 500
    by_normals, by_both = (near(lines(row)) for row in (0, 1))
    assert by_both[silhouette].mean() > 0.99
    assert by_normals[silhouette].mean() < by_both[silhouette].mean()


def test_there_are_no_lines_where_nothing_turns_or_jumps() -> None:
    """A line is at most two pixels from where the normal or the distance changes."""
    turns = changes(linear(cell("4.21", 0), SIZE), 0.05)
    by = near(near(turns)), near(near(turns | jumps(0.04)))
    for row in (0, 1):
        drawn = lines(row)
        assert 0.01 < drawn.mean() < 0.2
        assert by[row][drawn].mean() > 0.99
        assert by[row].mean() < 0.5


@pytest.mark.parametrize("tones", [2, 3, 5])
def test_each_colour_has_as_many_tones_as_asked(tones: int) -> None:
    given: dict[str, Setting] = {"outline": "none", "tones": tones}
    shown = linear(cell("4.23", 0), SIZE, **given)
    base = linear(cell("4.23", 0), SIZE, **given, view="base_color")
    things = (base != base[0, 0]).any(axis=2)
    shares = (shown[things] / base[things])[:, 0]
    assert np.unique(shares.round(4)).size == tones
