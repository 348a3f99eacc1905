"""A square of material, and its maps: albedo, normal, and occlusion-roughness-metalness.

Everything derives from the height and mask fields of one Surface, so the maps agree.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from scenes.making.noise import Floats, blur

__all__ = ["Surface", "hexes", "maps", "occlusion", "pick", "ramp", "write"]

Pixels = NDArray[np.uint8]

# Codes outside this range are no matt material in daylight: charcoal lies near 50, snow near 243.
DARKEST, BRIGHTEST = 32, 238


@dataclass(frozen=True, eq=False)
class Surface:
    """A texture before it is encoded: n x n texels over `edge` metres.

    `height` (n, n) in metres; `albedo` (n, n, 3) as sRGB 0..1; `roughness` and `metalness` (n, n)
    in 0..1. `cavity` scales how much the height darkens its own hollows. `steps` are the code steps
    that albedo, normal and the rest are rounded to: noise below them would only cost bytes.
    """

    edge: float
    height: Floats
    albedo: Floats
    roughness: Floats
    metalness: Floats
    cavity: float = 1.0
    steps: tuple[int, int, int] = (2, 2, 4)


def hexes(*codes: str) -> Floats:
    """(k, 3) sRGB 0..1 from codes such as "b4523c"."""
    return np.array([[int(code[i : i + 2], 16) / 255 for i in (0, 2, 4)] for code in codes])


def ramp(t: Floats, stops: Sequence[float], codes: Sequence[str]) -> Floats:
    """(..., 3): the colours `codes` at the positions `stops` of t, linear between them."""
    colors = hexes(*codes)
    return np.stack([np.interp(t, stops, colors[:, i]) for i in range(3)], axis=-1)


def pick(rng: np.random.Generator, count: int, codes: Sequence[str], spread: float) -> Floats:
    """(count, 3): for each of `count` pieces a random blend of two neighbours of `codes`.

    `spread` is the deviation of a grey offset on top.
    """
    colors, place = hexes(*codes), rng.random(count) * (len(codes) - 1)
    low = np.floor(place).astype(int)
    t = (place - low)[:, None]
    blend = colors[low] * (1 - t) + colors[low + 1] * t
    return np.asarray(blend + rng.normal(0, spread, (count, 1)))


def normal(height: Floats, edge: float) -> Floats:
    """(n, n, 3) unit normals: x along u, y up the image, z out of it. Wrapped differences."""
    step = 2 * edge / height.shape[0]
    right = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / step
    down = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) / step
    vectors = np.stack([-right, down, np.ones_like(height)], axis=-1)
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def occlusion(height: Floats, edge: float, strength: float) -> Floats:
    """The share of the sky that a texel sees, 0..1: how far it lies under its surroundings.

    A hole as deep as it is wide, at any of four widths, loses half at strength 1.
    """
    open_sky = np.ones_like(height)
    for texels in (1.5, 4, 10, 24):
        depth = np.maximum(blur(height, texels) - height, 0)
        slope = depth / (texels * edge / height.shape[0])
        open_sky = open_sky / (1 + strength * slope)
    return np.clip(open_sky, 0, 1)


def maps(surface: Surface) -> dict[str, Pixels]:
    """`albedo`, `normal` and `orm` of a surface, (n, n, 3) uint8.

    albedo is sRGB; normal is 0.5 + 0.5 n; orm is occlusion, roughness, metalness, linear.
    """
    matt = surface.metalness[..., None] < 0.5
    codes = np.round(surface.albedo * 255)
    albedo = np.where(matt, np.clip(codes, DARKEST, BRIGHTEST), np.clip(codes, 0, 255))
    vectors = normal(surface.height, surface.edge)
    sky = occlusion(surface.height, surface.edge, surface.cavity)
    orm = np.stack([sky, surface.roughness, surface.metalness], axis=-1)
    first, second, third = surface.steps
    return {
        "albedo": _codes(albedo, first),
        "normal": _codes(127.5 + 127.5 * vectors, second, 128),
        "orm": _codes(255 * orm, third, 255),
    }


def _codes(values: Floats, step: int, kept: int = 0) -> Pixels:
    """Rounded to whole steps away from the code `kept`, which stays exact."""
    return np.clip(np.round((values - kept) / step) * step + kept, 0, 255).astype(np.uint8)


def write(name: str, surface: Surface, folder: Path) -> list[Path]:
    """Write the three maps as `NAME_albedo.png` and so on; return their paths."""
    paths = []
    for kind, pixels in maps(surface).items():
        path = folder / f"{name}_{kind}.png"
        Image.fromarray(pixels).save(path, optimize=True, compress_level=9)
        paths.append(path)
    return paths
