"""The room itself: floor, walls with a window, chimney with a hearth, beams, curtains, rug."""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import numpy as np

from scenes.making.gltf import Model, Node
from scenes.making.solids import Mesh, Point, box, join, place, sheet, tube

__all__ = ["chimney", "curtains", "picture", "rug", "shell", "window"]

WALNUT, FLOOR, BRICK, PLASTER, TILES, KILIM, GOLD = 0.5, 1.2, 0.9, 1.2, 0.6, 0.8, 0.32
LINEN = 0.048 * 3
# The room's inside, from corner to corner, and the opening in its left wall (z and y).
LEFT, RIGHT, BACK, FRONT, TOP = -2.6, 2.4, -2.2, 2.7, 2.7
WINDOW_Z, WINDOW_Y = (-0.95, 0.75), (0.86, 2.2)
WALL = 0.28

_plaster = partial(box, edge=PLASTER, level=True)
_brick = partial(box, edge=BRICK, level=True)
_tiles = partial(box, edge=TILES, level=True, chamfer=0.002)
_walnut = partial(box, edge=WALNUT, chamfer=0.004)


def shell() -> Model:
    """Floor, ceiling with beams, four walls with skirting; the left one is open for the window."""
    floor = box((LEFT, -0.1, BACK), (RIGHT, 0, FRONT), FLOOR)
    x, z, (z0, z1), (y0, y1) = (LEFT - WALL, LEFT), (BACK, FRONT), WINDOW_Z, WINDOW_Y
    walls = [
        _plaster((x[0], -0.1, z[0] - WALL), (x[1], y0, z[1] + WALL)),
        _plaster((x[0], y1, z[0] - WALL), (x[1], TOP, z[1] + WALL)),
        _plaster((x[0], y0, z[0] - WALL), (x[1], y1, z0)),
        _plaster((x[0], y0, z1), (x[1], y1, z[1] + WALL)),
        _plaster((LEFT, -0.1, BACK - WALL), (RIGHT, TOP, BACK)),
        _plaster((LEFT, -0.1, FRONT), (RIGHT, TOP, FRONT + WALL)),
        _plaster((RIGHT, -0.1, BACK - WALL), (RIGHT + WALL, TOP, FRONT + WALL)),
        _plaster((LEFT - WALL, TOP, BACK - WALL), (RIGHT + WALL, TOP + 0.1, FRONT + WALL)),
    ]
    beams = [
        _walnut((LEFT, TOP - 0.16, z - 0.07), (RIGHT, TOP, z + 0.07), chamfer=0.012, offset=(z, z))
        for z in (-1.45, -0.1, 1.25)
    ]
    parts = [
        ("oak_floor", floor),
        ("plaster", join(walls)),
        ("walnut", join([*beams, *_skirting()])),
    ]
    return Model("shell", parts)


def _skirting() -> list[Mesh]:
    rails = (
        ((LEFT, 0, BACK), (LEFT + 0.016, 0.11, FRONT)),
        ((RIGHT - 0.016, 0, BACK), (RIGHT, 0.11, FRONT)),
        ((LEFT, 0, BACK), (RIGHT, 0.11, BACK + 0.016)),
        ((LEFT, 0, FRONT - 0.016), (RIGHT, 0.11, FRONT)),
    )
    return [_walnut(*rail) for rail in rails]


def window() -> Model:
    """Frame, mullion and glazing bars in the wall's opening, and a wide sill."""
    (z0, z1), (y0, y1), x = WINDOW_Z, WINDOW_Y, LEFT - 0.17
    middle = (z0 + z1) / 2
    bars = [
        _bar(x, 0.07, (y0, y1), (z0, z0 + 0.055)),
        _bar(x, 0.07, (y0, y1), (z1 - 0.055, z1)),
        _bar(x, 0.07, (y0, y0 + 0.055), (z0, z1)),
        _bar(x, 0.07, (y1 - 0.055, y1), (z0, z1)),
        _bar(x, 0.06, (y0, y1), (middle - 0.04, middle + 0.04)),
        *(_bar(x, 0.03, (y - 0.011, y + 0.011), (z0, z1)) for y in np.linspace(y0, y1, 4)[1:3]),
        *(
            _bar(x, 0.03, (y0, y1), (z - 0.011, z + 0.011))
            for z in ((z0 + middle) / 2, (middle + z1) / 2)
        ),
    ]
    sill = _walnut((LEFT - 0.14, y0 - 0.01, z0 - 0.06), (LEFT + 0.05, y0 + 0.022, z1 + 0.06))
    return Model("window", [("paint_white", join(bars)), ("walnut", sill)])


def _bar(x: float, deep: float, y: tuple[float, float], z: tuple[float, float]) -> Mesh:
    low, high = (x - deep / 2, y[0], z[0]), (x + deep / 2, y[1], z[1])
    return box(low, high, 1.0, chamfer=0.004)


def curtains() -> Model:
    """Two linen curtains in folds on a steel pole."""
    cloths = []
    for z, width in ((WINDOW_Z[0] - 0.1, 0.42), (WINDOW_Z[1] + 0.1, -0.42)):
        t = np.linspace(0, 1, 90)
        across = z - width / 2 + width * t
        fold = 0.04 * np.sin(2 * np.pi * (5.5 * t + 0.25 * np.sin(5 * t)))
        line = np.stack([LEFT + 0.12 + fold, across], axis=-1)
        cloths.append(sheet(line, 0.03, 2.36, LINEN))
    pole = tube([(LEFT + 0.12, 2.37, -1.55), (LEFT + 0.12, 2.37, 1.35)], 0.013, 16, 0.3)
    return Model("curtains", [("curtain_linen", join(cloths)), ("steel", pole)])


def chimney() -> Node:
    """A brick chimney breast with a tiled fireplace and a mantel; its back is the wall, z = 0."""
    deep, half, opening, high = 0.42, 0.82, 0.42, 0.72
    breast = [
        _brick((-half, 0, 0), (-opening, TOP, deep)),
        _brick((opening, 0, 0), (half, TOP, deep)),
        _brick((-opening, high, 0), (opening, TOP, deep)),
    ]
    soot = _brick((-opening, 0, 0), (opening, high, 0.05))
    face = [
        _tiles((side * 0.495 - 0.075, 0.03, deep), (side * 0.495 + 0.075, 0.9, deep + 0.012))
        for side in (-1, 1)
    ]
    face += [_tiles((-0.42, 0.75, deep), (0.42, 0.9, deep + 0.012))]
    hearth = _tiles((-0.75, 0.0, deep), (0.75, 0.03, deep + 0.45))
    mantel = _walnut((-0.95, 1.05, deep - 0.01), (0.95, 1.11, deep + 0.24), chamfer=0.008)
    corbels = [
        _walnut((x - 0.05, 0.93, deep), (x + 0.05, 1.05, deep + 0.17), offset=(0.3, x))
        for x in (-0.66, 0.66)
    ]
    parts = [
        ("brick", join(breast)),
        ("brick_soot", soot),
        ("tiles", join([*face, hearth])),
        ("walnut", join([mantel, *corbels])),
    ]
    return Node(
        "chimney", Model("chimney", parts), children=[Node("logs", _logs(), at=(0, 0, 0.24))]
    )


def _logs() -> Model:
    ends: list[tuple[Point, Point, float]] = [
        ((-0.27, 0.06, -0.06), (0.25, 0.055, -0.05), 0.055),
        ((-0.24, 0.05, 0.07), (0.29, 0.055, 0.06), 0.05),
        ((-0.2, 0.145, 0.02), (0.22, 0.13, -0.02), 0.048),
    ]
    return Model("logs", [("bark", join(tube([a, b], r, 14, 0.3) for a, b, r in ends))])


def rug() -> Model:
    """A kilim of 2.4 x 1.6, 9 mm thick."""
    weave = box((-1.2, 0.0, -0.8), (1.2, 0.009, 0.8), KILIM, chamfer=0.003)
    return Model("rug", [("kilim", weave)])


def picture() -> Model:
    """A painting of 0.72 x 0.54 in a gilt frame, its back on z = 0, facing +z."""
    wide, tall = 0.36, 0.27
    canvas = Mesh(
        np.array(
            [(-wide, -tall, 0.014), (wide, -tall, 0.014), (-wide, tall, 0.014), (wide, tall, 0.014)]
        ),
        np.tile((0.0, 0.0, 1.0), (4, 1)),
        np.array([(0.0, 1.0), (1.0, 1.0), (0.0, 0.0), (1.0, 0.0)]),
        np.array([(0, 1, 2), (2, 1, 3)]),
    )
    sides = [_moulding(2 * wide, tall, turn) for turn in (0, 180)]
    sides += [_moulding(2 * tall, wide, turn) for turn in (90, 270)]
    return Model("picture", [("painting", canvas), ("gold_leaf", join(sides))])


def _moulding(length: float, out: float, turn: float) -> Mesh:
    """One mitred side of the frame: a moulding `length` long inside, turned about the middle."""
    profile = np.array(
        [
            (0, 0),
            (0, 0.018),
            (0.008, 0.024),
            (0.02, 0.020),
            (0.034, 0.034),
            (0.052, 0.040),
            (0.06, 0.034),
            (0.06, 0),
        ]
    )
    strips = []
    for (a, za), (b, zb) in pairwise(profile):
        ends = [(s * (length / 2 + w), out + w, z) for w, z in ((a, za), (b, zb)) for s in (-1, 1)]
        normal = np.array([0.0, za - zb, b - a]) / np.hypot(za - zb, b - a)
        points = np.array(ends)
        uvs = np.stack([points[:, 0], [-a - za, -a - za, -b - zb, -b - zb]], axis=-1) / GOLD
        faces = np.array([(0, 1, 2), (2, 1, 3)])
        strips.append(Mesh(points, np.tile(normal, (4, 1)), uvs, faces))
    return place(join(strips), turn=(0, 0, turn))
