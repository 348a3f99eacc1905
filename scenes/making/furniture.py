"""Table, chair, bookcase and desk lamp. Each stands on y = 0; lengths are metres."""

from __future__ import annotations

from itertools import product

import numpy as np

from scenes.making.gltf import Model, Node
from scenes.making.noise import Floats
from scenes.making.solids import Line, Mesh, Point, box, curve, join, lathe, place, rounded, tube

__all__ = ["SHELVES", "bookcase", "chair", "lamp", "table"]

WALNUT, STEEL = 0.5, 0.3
# Heights of the bookcase's shelves, of which the last is its top.
SHELVES = (0.09, 0.46, 0.83, 1.19, 1.53, 1.86)


def _board(low: Point, high: Point, seed: int, chamfer: float = 0.004) -> Mesh:
    """A walnut board; `seed` moves the grain, so that no two boards show the same."""
    offset = (0.37 * seed % 1, 0.25 * seed % 1)
    return box(low, high, WALNUT, chamfer=chamfer, offset=offset)


def table() -> Model:
    """A table of 1.5 x 0.85 x 0.75 on turned legs."""
    top = _board((-0.75, 0.716, -0.425), (0.75, 0.75, 0.425), 0, 0.006)
    aprons = [
        _board((-0.62, 0.62, z - 0.012), (0.62, 0.716, z + 0.012), seed)
        for seed, z in ((1, -0.34), (2, 0.34))
    ] + [
        _board((x - 0.012, 0.62, -0.31), (x + 0.012, 0.716, 0.31), seed)
        for seed, x in ((3, -0.65), (5, 0.65))
    ]
    legs = [
        place(_turned_leg(seed), (x, 0, z))
        for seed, (x, z) in enumerate(product((-0.65, 0.65), (-0.34, 0.34)))
    ]
    return Model("table", [("walnut", join([top, *aprons, *legs]))])


def _turned_leg(seed: int) -> Mesh:
    """A square block above a turned shaft: bead, vase, bead, foot."""
    block = _board((-0.036, 0.585, -0.036), (0.036, 0.716, 0.036), seed, 0.005)
    outline = [
        (0.020, 0.0),
        (0.024, 0.02),
        (0.019, 0.06),
        (0.024, 0.16),
        (0.031, 0.34),
        (0.033, 0.44),
        (0.026, 0.50),
        (0.020, 0.525),
    ]
    ring = [(0.020, 0.525), (0.033, 0.533), (0.034, 0.545), (0.024, 0.555)]
    neck = [(0.024, 0.555), (0.023, 0.57), (0.031, 0.585)]
    profiles: list[Line] = [
        [(0.0, 0.0), (0.020, 0.0)],
        *(curve(part, 3) for part in (outline, ring, neck)),
    ]
    shaft = lathe(profiles, 16, WALNUT)
    # A turned piece keeps the grain of its length.
    return join([block, shaft._replace(uvs=shaft.uvs[:, ::-1] * (1, 0.6))])


def chair() -> Model:
    """A spindle-back chair, seat 0.46 high, facing +z, with a linen cushion."""
    seat = _board((-0.21, 0.41, -0.2), (0.21, 0.438, 0.22), 1, 0.007)
    cushion = rounded(
        (-0.195, 0.434, -0.18), (0.195, 0.47, 0.205), 0.016, 0.12, cells=5, swell=0.016
    )
    fronts = [
        place(
            box((-0.02, 0, -0.02), (0.02, 0.415, 0.02), WALNUT, chamfer=0.004, taper=0.62),
            (x, 0, 0.185),
        )
        for x in (-0.178, 0.178)
    ]
    posts = [tube(_post(x), _post_radius(), 12, WALNUT) for x in (-0.178, 0.178)]
    rails = [
        tube([(-0.178, 0.19, 0.185), (0.178, 0.19, 0.185)], 0.011, 10, WALNUT),
        *(tube([(x, 0.14, 0.185), (x, 0.14, -0.195)], 0.011, 10, WALNUT) for x in (-0.178, 0.178)),
        tube([(-0.178, 0.14, -0.01), (0.178, 0.14, -0.01)], 0.010, 10, WALNUT),
    ]
    wood = [seat, *fronts, *posts, *rails, *_back()]
    return Model("chair", [("walnut", join(wood)), ("seat_linen", cushion)])


def _post(x: float) -> Floats:
    """The curve of a back leg from the floor to the crest."""
    ends = [(x, 0.0021, -0.225), (x, 0.22, -0.192), (x, 0.44, -0.185), (x, 0.68, -0.215)]
    return curve([*ends, (x * 1.02, 0.9, -0.285)], 4)


def _post_radius() -> Floats:
    return np.interp(np.linspace(0, 1, 17), (0, 0.45, 1), (0.013, 0.020, 0.014))


def _back() -> list[Mesh]:
    """A bowed crest rail, a lower rail, and five spindles between them."""
    bow = np.linspace(-1, 1, 13)
    crest, lower = (
        np.stack([0.18 * bow, np.full(13, y), z + dz * (bow**2 - 1)], axis=-1)
        for y, z, dz in ((0.865, -0.272, 0.028), (0.53, -0.192, 0.012))
    )
    rails = [_flattened(crest, 0.011, 0.045), _flattened(lower, 0.010, 0.02)]
    at = np.linspace(2, 10, 5).astype(int)
    spindles = [tube(np.stack([lower[i], crest[i]]), 0.0065, 8, WALNUT) for i in at]
    return [*rails, *spindles]


def _flattened(path: Floats, thin: float, tall: float) -> Mesh:
    """A rail along `path`, `thin` deep and `tall` high from its middle."""
    pipe = tube(path, thin, 12, WALNUT)
    middle = path[:, 1].mean()
    stretched = pipe.positions * (1, tall / thin, 1)
    stretched[:, 1] += middle * (1 - tall / thin)
    normals = pipe.normals * (1, thin / tall, 1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return pipe._replace(positions=stretched, normals=normals)


def bookcase() -> Model:
    """An open bookcase of 1.2 x 0.3 x 1.95 with its back against z = 0, facing +z."""
    sides = [
        _board((x - 0.014, 0.0, 0.0), (x + 0.014, 1.9, 0.3), 7 + i)
        for i, x in enumerate((-0.586, 0.586))
    ]
    shelves = [
        _board((-0.572, y - 0.024, 0.012), (0.572, y, 0.29), i) for i, y in enumerate(SHELVES)
    ]
    back = _board((-0.572, 0.06, 0.0), (0.572, 1.86, 0.01), 3, 0.001)
    plinth = _board((-0.572, 0.0, 0.24), (0.572, 0.066, 0.27), 4)
    crown = _board((-0.63, 1.9, -0.0), (0.63, 1.93, 0.335), 6, 0.006)
    bead = _board((-0.612, 1.878, 0.0), (0.612, 1.9, 0.318), 5, 0.006)
    return Model("bookcase", [("walnut", join([*sides, *shelves, back, plinth, crown, bead]))])


def lamp() -> Node:
    """A jointed desk lamp: each part turns with the one that carries it."""
    head = Node("lamp_head", _shade(), at=(0, 0.27, 0), turn=103, about=(0, 0, 1))
    upper = Node(
        "lamp_upper_arm",
        _arm("upper_arm", 0.27),
        at=(0, 0.30, 0),
        turn=72,
        about=(0, 0, 1),
        children=[head],
    )
    lower = Node(
        "lamp_lower_arm",
        _arm("lower_arm", 0.30),
        at=(0, 0.045, 0),
        turn=-22,
        about=(0, 0, 1),
        children=[upper],
    )
    return Node("lamp", _foot(), children=[lower])


def _foot() -> Model:
    dome = curve([(0.086, 0.012), (0.080, 0.020), (0.030, 0.027), (0.016, 0.034), (0.012, 0.05)], 4)
    rim = curve([(0.084, 0.0), (0.087, 0.006), (0.086, 0.012)], 2)
    profile: list[Line] = [[(0, 0), (0.084, 0)], rim, dome, [(0.012, 0.05), (0, 0.05)]]
    return Model("lamp_foot", [("steel", lathe(profile, 36, STEEL))])


def _arm(name: str, length: float) -> Model:
    """Two thin rods and the knuckle that the next part turns on."""
    rods = [tube([(0, 0, z), (0, length, z)], 0.0035, 10, STEEL) for z in (-0.011, 0.011)]
    pins = [tube([(0, y, -0.019), (0, y, 0.019)], 0.010, 16, STEEL) for y in (0.0, length)]
    return Model(name, [("steel", join([*rods, *pins]))])


def _shade() -> Model:
    """A spun shade that opens along +y, its cap, and the bulb inside."""
    outside = curve([(0.024, -0.03), (0.030, 0.0), (0.046, 0.045), (0.078, 0.105)], 5)
    inside = np.stack([outside[::-1, 0] - 0.002, outside[::-1, 1] + 0.001], axis=-1)
    cap: list[Line] = [[(0, -0.03), (0.024, -0.03)], outside, [(0.078, 0.105), (0.076, 0.106)]]
    bulb = curve([(0.011, 0.0), (0.015, 0.015), (0.022, 0.035), (0.018, 0.055), (0.0, 0.064)], 4)
    parts = [("steel", lathe(cap, 36, STEEL)), ("shade_inside", lathe([inside], 36, STEEL))]
    return Model("lamp_head", [*parts, ("bulb", lathe([bulb], 16, STEEL))])
