"""What lies on tables and shelves: books, a tea set, fruit, a vase, an ornament of gold leaf."""

from __future__ import annotations

import numpy as np

from scenes.making.gltf import Model, Node, Part
from scenes.making.solids import Line, Mesh, box, curve, join, lathe, place, tube

__all__ = [
    "CLOTHS",
    "apple",
    "book",
    "bowl",
    "cup",
    "knot",
    "shelf_of_books",
    "stack",
    "teapot",
    "vase",
]

CLOTHS = ("cloth_red", "cloth_green", "cloth_blue", "cloth_ochre", "cloth_black", "cloth_cream")
LINEN, PAGES, GOLD, GLAZE = 0.048 * 2, 0.032, 0.32, 0.3


def book(width: float, height: float, thick: float, cloth: str, bands: int) -> list[Part]:
    """A bound book that stands on y = 0 with its spine at z = 0 facing +z, its fore-edge at -z.

    `width` is its depth along z, `thick` along x; `bands` gilt lines cross the spine.
    """
    board, half = 0.0025, thick / 2
    boards = [
        box((x, 0, -width), (x + board, height, -0.004), LINEN) for x in (-half, half - board)
    ]
    spine = _spine(half, 0.0, height, 0.0)
    inner = half - board
    block = box((-inner, 0.004, -width + 0.005), (inner, height - 0.004, -0.003), PAGES)
    gilt = [_spine(half, y, y + 0.003, 0.0005) for y in height * _BANDS[:bands]]
    gilded = [("gold_leaf", join(gilt))] if gilt else []
    return [(cloth, join([*boards, spine])), ("pages", block), *gilded]


_BANDS = np.array([0.10, 0.86, 0.14, 0.82, 0.62])


def _spine(half: float, low: float, high: float, proud: float) -> Mesh:
    """A slice of a round spine, closed above and below; or a band `proud` metres off it."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 7)
    hollow = 0.45 * half
    rim = np.stack([(half + proud) * np.sin(angle), (hollow + proud) * np.cos(angle) - 0.004], -1)
    normals = np.stack([np.sin(angle) / half, 0 * angle, np.cos(angle) / hollow], axis=-1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    rows = [np.stack([rim[:, 0], 0 * angle + y, rim[:, 1]], axis=-1) for y in (low, high)]
    along = np.linspace(0, np.pi * half, 7)
    uvs = [np.stack([along, 0 * along - y], axis=-1) / LINEN for y in (low, high)]
    start = np.arange(6)
    faces = np.concatenate(
        [
            np.stack(f, axis=-1)
            for f in ((start, start + 1, start + 7), (start + 7, start + 1, start + 8))
        ]
    )
    side = Mesh(np.concatenate(rows), np.tile(normals, (2, 1)), np.concatenate(uvs), faces)
    fan = np.stack([np.zeros(5, int), np.arange(1, 6), np.arange(2, 7)], axis=-1)
    ends = [
        Mesh(row, np.tile((0.0, sign, 0.0), (7, 1)), row[:, [0, 2]] / LINEN, fan[:, :: int(sign)])
        for row, sign in zip(rows, (-1, 1), strict=True)
    ]
    return side if proud else join([side, *ends])


def _random_book(rng: np.random.Generator, room: float) -> tuple[float, float, float]:
    """(width, height, thickness) of a book for a shelf `room` metres high."""
    height = min(rng.choice((0.19, 0.22, 0.25, 0.30)) * rng.uniform(0.94, 1.06), room - 0.02)
    return height * rng.uniform(0.62, 0.78), height, rng.uniform(0.014, 0.052)


def shelf_of_books(rng: np.random.Generator, length: float, room: float) -> list[Part]:
    """Books from x = 0 to `length`: runs of one series, gaps, and books that lean on the last."""
    parts: list[Part] = []
    x, gap = 0.0, 0.0
    while x < length - 0.06:
        size, cloth = _random_book(rng, room), str(rng.choice(CLOTHS))
        lean = float(rng.choice((0, 0, 0, 0, 0, 6, 11))) if x > 0 and not gap else 0.0
        for i in range(int(rng.choice((1, 1, 1, 2, 4)))):
            width, height, thick = size
            sweep = 0.0 if i else height * np.sin(np.radians(lean))
            if x + thick + sweep > length:
                return parts
            at = (x + thick / 2 * np.cos(np.radians(lean)) + sweep, 0, rng.uniform(-0.02, 0.004))
            foot = thick / 2 * np.sin(np.radians(lean))
            made = book(min(width, 0.23), height, thick, cloth, int(rng.integers(0, 6)))
            moved = (at[0], foot, at[2])
            parts += [(m, place(mesh, moved, (0, 0, lean))) for m, mesh in made]
            x += thick / max(np.cos(np.radians(lean)), 0.1) + sweep + 0.0012
        gap = float(rng.choice((0, 0, 0, 0.02, 0.09)))
        x += gap
    return parts


def stack(rng: np.random.Generator, count: int, name: str) -> Model:
    """Books that lie on each other, the largest below, each turned a little."""
    parts: list[Part] = []
    y = 0.0
    for i in range(count):
        height, thick = 0.27 - 0.025 * i, rng.uniform(0.022, 0.045)
        made = book(0.72 * height, height, thick, str(rng.choice(CLOTHS)), 4)
        lying = [(m, place(mesh, (height / 2, 0, 0.36 * height), (0, 0, 90))) for m, mesh in made]
        turn = rng.normal(0, 11)
        parts += [(m, place(mesh, (0, y + thick / 2, 0), (0, turn, 0))) for m, mesh in lying]
        y += thick
    return Model(name, parts)


def teapot() -> Model:
    """A round glazed pot, 0.15 high, spout towards +x."""
    body = curve(
        [(0.042, 0.004), (0.068, 0.025), (0.080, 0.062), (0.070, 0.100), (0.038, 0.122)], 6
    )
    lid = curve([(0.040, 0.122), (0.034, 0.132), (0.014, 0.138), (0.006, 0.142)], 3)
    knob = curve([(0.006, 0.142), (0.012, 0.150), (0.010, 0.159), (0.0, 0.162)], 4)
    foot = [(0, 0), (0.042, 0), (0.042, 0.004)]
    turned = lathe(
        [foot[:2], foot[1:], body, [(0.038, 0.122), (0.040, 0.122)], lid, knob], 40, GLAZE
    )
    spout = tube(
        curve([(0.06, 0.04, 0), (0.098, 0.055, 0), (0.118, 0.092, 0), (0.142, 0.116, 0)], 4),
        np.interp(np.linspace(0, 1, 13), (0, 0.4, 1), (0.021, 0.013, 0.0085)),
        16,
        GLAZE,
    )
    ear = curve(
        [
            (-0.058, 0.108, 0),
            (-0.105, 0.122, 0),
            (-0.130, 0.085, 0),
            (-0.108, 0.045, 0),
            (-0.07, 0.034, 0),
        ],
        5,
    )
    return Model("teapot", [("glaze_blue", join([turned, spout, tube(ear, 0.0075, 10, GLAZE)]))])


def cup() -> Model:
    """A cup on its saucer, with tea in it."""
    outside = curve([(0.022, 0.018), (0.034, 0.028), (0.041, 0.050), (0.043, 0.078)], 3)
    inside = curve([(0.0405, 0.078), (0.038, 0.050), (0.030, 0.028), (0.0, 0.024)], 3)
    lip = curve([(0.043, 0.078), (0.0418, 0.0792), (0.0405, 0.078)], 2)
    pot: list[Line] = [[(0.0, 0.012), (0.022, 0.012), (0.022, 0.018)], outside, lip, inside]
    rise = curve([(0.032, 0.0), (0.052, 0.006), (0.074, 0.016)], 3)
    dish = curve([(0.073, 0.018), (0.050, 0.009), (0.030, 0.006), (0.0, 0.006)], 3)
    saucer: list[Line] = [[(0, 0), (0.032, 0)], rise, [(0.074, 0.016), (0.073, 0.018)], dish]
    ear = curve([(0.040, 0.068, 0), (0.060, 0.066, 0), (0.062, 0.044, 0), (0.037, 0.036, 0)], 4)
    china = join([lathe(pot, 32, GLAZE), lathe(saucer, 36, GLAZE), tube(ear, 0.0038, 8, GLAZE)])
    tea = lathe([[(0.0, 0.066), (0.0395, 0.066)]], 32, GLAZE)
    upward = tea._replace(normals=-tea.normals, faces=tea.faces[:, ::-1])
    return Model("cup", [("glaze_white", china), ("tea", upward)])


def bowl() -> Model:
    """A wide bowl, 0.3 across."""
    outside = curve([(0.055, 0.0), (0.058, 0.012), (0.105, 0.035), (0.150, 0.085)], 5)
    inside = curve([(0.146, 0.086), (0.100, 0.041), (0.060, 0.022), (0.0, 0.018)], 5)
    rim = curve([(0.150, 0.085), (0.149, 0.0875), (0.146, 0.086)], 2)
    return Model(
        "bowl", [("glaze_white", lathe([[(0, 0), (0.055, 0)], outside, rim, inside], 36, GLAZE))]
    )


def apple() -> Model:
    """An apple about 75 mm wide, with its stalk; it lies on y = 0."""
    skin = curve(
        [
            (0.0, 0.008),
            (0.012, 0.001),
            (0.028, 0.010),
            (0.0375, 0.040),
            (0.030, 0.064),
            (0.013, 0.068),
            (0.0, 0.058),
        ],
        4,
    )
    stalk = tube([(0, 0.056, 0), (0.002, 0.07, 0.001), (0.006, 0.082, 0.002)], 0.0013, 6, GLAZE)
    return Model("apple", [("apple_skin", lathe([skin], 20, GLAZE)), ("stalk", stalk)])


def vase() -> Model:
    """A tall glazed vase, 0.34 high, with bare twigs that lean towards +x."""
    outside = curve(
        [(0.045, 0.0), (0.070, 0.07), (0.078, 0.15), (0.045, 0.25), (0.030, 0.29), (0.042, 0.34)], 4
    )
    inside = outside[::-1][:14] - (0.003, 0)
    pot = lathe([[(0, 0), (0.045, 0)], outside, [(0.042, 0.34), (0.039, 0.34)], inside], 36, GLAZE)
    return Model("vase", [("glaze_blue", pot), ("walnut", join(_twigs()))])


def _twigs() -> list[Mesh]:
    """Seven twigs from the vase's neck, which is 0.03 wide, each bent three times."""
    rng = np.random.Generator(np.random.PCG64(8))
    twigs = []
    for _ in range(7):
        around = rng.uniform(0, 2 * np.pi)
        neck = np.array((0.019 * np.sin(around), 0.32, 0.019 * np.cos(around)))
        reach = rng.normal((0.05, 0.31, 0), (0.05, 0.05, 0.11))
        bend = rng.normal(0, 0.022, (3, 3)) * (1, 0.3, 1)
        stops = neck + np.array([0.3, 0.55, 0.8])[:, None] * reach + bend
        path = curve(np.vstack([(0, 0.1, 0), neck, stops, neck + reach]), 2)
        twigs.append(tube(path, np.linspace(0.0032, 0.0012, len(path)), 5, 0.5))
    return twigs


def knot() -> Node:
    """A trefoil knot of gold leaf, 0.22 high, on a stone foot."""
    t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    ring = 2 + np.cos(3 * t)
    path = np.stack([ring * np.cos(2 * t), ring * np.sin(2 * t), 1.2 * np.sin(3 * t)], axis=-1)
    gold = Model("knot", [("gold_leaf", tube(0.036 * path, 0.021, 16, GOLD, closed=True))])
    foot = lathe(
        [
            [(0, 0), (0.055, 0)],
            [(0.055, 0), (0.055, 0.012)],
            curve([(0.055, 0.012), (0.035, 0.02), (0.028, 0.04), (0.040, 0.055)], 5),
            [(0.040, 0.055), (0, 0.055)],
        ],
        36,
        GLAZE,
    )
    return Node(
        "ornament",
        Model("foot", [("stone", foot)]),
        children=[Node("knot", gold, at=(0, 0.165, 0))],
    )
