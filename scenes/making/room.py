"""The furnished room: every material, and where everything stands."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from scenes.making import furniture, house, things
from scenes.making.gltf import Matter, Model, Node, Part, write
from scenes.making.solids import place

__all__ = ["MATERIALS", "make_room"]

MATERIALS = {
    "oak_floor": Matter(texture="wood"),
    "plaster": Matter(texture="plaster"),
    "brick": Matter(texture="brick"),
    "brick_soot": Matter((0.12, 0.11, 0.11), "brick"),
    "tiles": Matter(texture="tiles"),
    "walnut": Matter(texture="walnut"),
    "kilim": Matter(texture="kilim"),
    "steel": Matter(texture="brushed_metal"),
    "gold_leaf": Matter(texture="gold_leaf"),
    "painting": Matter(texture="painting", clamp=True),
    "pages": Matter(texture="pages"),
    "seat_linen": Matter((0.62, 0.42, 0.24), "linen"),
    "curtain_linen": Matter((0.95, 0.88, 0.74), "linen", double_sided=True),
    "cloth_red": Matter((0.42, 0.06, 0.05), "linen"),
    "cloth_green": Matter((0.10, 0.22, 0.12), "linen"),
    "cloth_blue": Matter((0.07, 0.14, 0.32), "linen"),
    "cloth_ochre": Matter((0.62, 0.36, 0.09), "linen"),
    "cloth_black": Matter((0.06, 0.055, 0.055), "linen"),
    "cloth_cream": Matter((0.80, 0.68, 0.48), "linen"),
    "paint_white": Matter((0.72, 0.70, 0.65), roughness=0.45),
    "glaze_white": Matter((0.76, 0.74, 0.68), roughness=0.22),
    "glaze_blue": Matter((0.055, 0.13, 0.24), roughness=0.2),
    "tea": Matter((0.16, 0.055, 0.015), roughness=0.12),
    "apple_skin": Matter((0.40, 0.045, 0.03), roughness=0.32),
    "stalk": Matter((0.09, 0.055, 0.03), roughness=0.8),
    "stone": Matter((0.045, 0.043, 0.042), roughness=0.3),
    "bark": Matter((0.55, 0.45, 0.38), "walnut"),
    "shade_inside": Matter((0.85, 0.82, 0.76), roughness=0.5),
    "bulb": Matter((0.9, 0.85, 0.75), roughness=0.4, emissive=(14.0, 9.6, 5.2)),
}


def make_room(path: Path) -> list[Path]:
    """Write the room as `path` (.gltf) with its .bin; return both paths."""
    rng = np.random.Generator(np.random.PCG64(20))
    parts = [
        Node("shell", house.shell()),
        Node("window", house.window(), children=[_on_the_sill()]),
        Node("curtains", house.curtains()),
        _fireside(),
        Node("rug", house.rug(), at=(-0.35, 0, 0.15), turn=-4),
        _laid_table(rng),
        *_chairs(),
        _library(rng),
    ]
    return write(path, [Node("room", children=parts)], MATERIALS)


def _on_the_sill() -> Node:
    return Node("vase", things.vase(), at=(-2.62, 0.882, -0.62))


def _fireside() -> Node:
    chimney = house.chimney()
    picture = Node("picture", house.picture(), at=(0, 1.66, 0.42))
    ornament = Node("ornament_place", at=(0.56, 1.11, 0.53), turn=20, children=[things.knot()])
    return Node("fireside", at=(-0.75, 0, -2.2), children=[chimney, picture, ornament])


def _laid_table(rng: np.random.Generator) -> Node:
    """The table with a lamp, books, a tea set and a bowl of apples on it."""
    cup, apple = things.cup(), things.apple()
    spots = (
        ((-0.045, 0.022, 0.02), 1.0),
        ((0.05, 0.024, 0.035), 0.94),
        ((0.01, 0.024, -0.06), 1.04),
        ((0.012, 0.075, 0.0), 0.9),
    )
    apples = [
        Node(f"apple_{i}", apple, at=at, turn=14 if i % 2 else -18, about=(1, i, 1), size=size)
        for i, (at, size) in enumerate(spots)
    ]
    on_top = [
        Node("bowl", things.bowl(), at=(-0.36, 0.75, -0.06), children=apples),
        Node("teapot", things.teapot(), at=(0.03, 0.75, 0.10), turn=150),
        Node("cup_1", cup, at=(-0.13, 0.75, 0.27), turn=-35),
        Node("cup_2", cup, at=(0.2, 0.75, -0.22), turn=120),
        Node("books_lying", things.stack(rng, 3, "books_lying"), at=(0.33, 0.75, 0.14), turn=65),
        Node("lamp_place", at=(0.6, 0.75, -0.2), turn=-25, children=[furniture.lamp()]),
    ]
    return Node("table", furniture.table(), at=(-0.3, 0.009, 0.1), turn=7, children=on_top)


def _chairs() -> list[Node]:
    chair = furniture.chair()
    places = (
        ((-0.62, 0.009, -0.55), 3),
        ((0.12, 0.009, -0.62), -14),
        ((-1.28, 0.009, 0.3), 104),
        ((-0.02, 0.009, 0.98), 202),
    )
    return [Node(f"chair_{i + 1}", chair, at=at, turn=turn) for i, (at, turn) in enumerate(places)]


def _library(rng: np.random.Generator) -> Node:
    """The bookcase with five shelves of books."""
    parts: list[Part] = []
    for i, (low, high) in enumerate(zip(furniture.SHELVES, furniture.SHELVES[1:], strict=False)):
        length = 1.13 if i in (0, 2, 3) else rng.uniform(0.7, 0.85)
        books = things.shelf_of_books(rng, length, high - low - 0.03)
        parts += [(matter, place(mesh, (-0.565, low, 0.262))) for matter, mesh in books]
    lying = Node(
        "books_on_shelf",
        things.stack(rng, 3, "books_on_shelf"),
        at=(0.40, furniture.SHELVES[1], 0.15),
        turn=90,
    )
    spare = Node("bowl_on_shelf", things.bowl(), at=(0.40, furniture.SHELVES[4], 0.15), size=0.8)
    shelved = Node("books", Model("books", parts))
    case = furniture.bookcase()
    return Node("bookcase", case, at=(1.05, 0, -2.2), children=[shelved, lying, spare])
