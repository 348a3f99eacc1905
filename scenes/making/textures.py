"""All texture sets by name, written as NAME_albedo.png, NAME_normal.png and NAME_orm.png."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np

from scenes.making import cloth, masonry, metals, timber
from scenes.making.surface import Surface, write

__all__ = ["SETS", "make", "make_all"]

# The maker of each set and its size in texels.
SETS: dict[str, tuple[Callable[[np.random.Generator, int], Surface], int]] = {
    "brick": (masonry.brick, 512),
    "wood": (timber.wood, 512),
    "walnut": (timber.walnut, 512),
    "brushed_metal": (metals.brushed_metal, 512),
    "gold_leaf": (metals.gold_leaf, 512),
    "tiles": (masonry.tiles, 512),
    "plaster": (masonry.plaster, 256),
    "linen": (cloth.linen, 256),
    "kilim": (cloth.kilim, 512),
    "pages": (cloth.pages, 128),
    "painting": (cloth.painting, 256),
}


def make(name: str) -> Surface:
    """The surface `name`; its random numbers depend on nothing but that name."""
    maker, n = SETS[name]
    return maker(np.random.Generator(np.random.PCG64(zlib.crc32(name.encode()))), n)


def make_all(folder: Path) -> list[Path]:
    """Write every set into `folder` and return the files' paths."""
    folder.mkdir(parents=True, exist_ok=True)
    return [path for name in SETS for path in write(name, make(name), folder)]
