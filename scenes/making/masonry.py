"""Brick, glazed tiles and plaster."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scenes.making.noise import (
    Floats,
    Ints,
    blur,
    grid,
    level,
    mix,
    ridges,
    sample,
    smooth,
    spectral,
    worley,
)
from scenes.making.surface import Surface, hexes, pick, ramp

__all__ = ["brick", "plaster", "tiles"]

Generator = np.random.Generator


class Blocks(NamedTuple):
    """A bond of blocks: each texel's block, and its place in it in metres from the middle."""

    piece: Ints
    x: Floats
    y: Floats
    inside: Floats  # distance to the block's rounded outline, metres, positive inside


def _blocks(
    u: Floats,
    v: Floats,
    edge: float,
    across: int,
    down: int,
    joint: float,
    shift: Floats,
    corner: float,
) -> Blocks:
    """`across` x `down` blocks, `joint` metres apart; row i is moved by shift[i] blocks."""
    row = np.floor(v * down).astype(int)
    along = u * across + shift[row % down]
    index = (row % down) * across + np.floor(along).astype(int) % across
    width, height = edge / across, edge / down
    x = (along - np.floor(along) - 0.5) * width
    y = (v * down - row - 0.5) * height
    qx = np.abs(x) - (width - joint) / 2 + corner
    qy = np.abs(y) - (height - joint) / 2 + corner
    outside = np.hypot(np.maximum(qx, 0), np.maximum(qy, 0)) + np.minimum(np.maximum(qx, qy), 0)
    return Blocks(index, x, y, corner - outside)


def brick(rng: Generator, n: int) -> Surface:
    """A weathered wall, 4 bricks by 12 courses on 0.9 m, in stretcher bond."""
    edge, count = 0.9, 48
    u, v = grid(n)
    sway = [0.0022 * spectral(rng, n, 2.0, high=12) for _ in range(2)]
    shift = np.where(np.arange(12) % 2 == 1, 0.5, 0) + rng.uniform(-0.03, 0.03, 12)
    wall = _blocks(u + sway[0], v + sway[1] * 0.6, edge, 4, 12, 0.011, shift, 0.006)
    grain, coarse = spectral(rng, n, 0.35, low=24), spectral(rng, n, 1.3, low=6, high=90)
    inside = wall.inside + _wear(rng, n, wall, coarse)
    face = smooth(-0.0012, 0.0016, inside)
    stone = _brick_height(rng, wall, inside, coarse, grain, count)
    sand = 0.0011 * spectral(rng, n, 0.6, low=14) + 0.0008 * coarse
    bed = -0.0068 + sand + 0.0022 * smooth(-0.004, 0.001, inside)
    height = np.maximum(mix(bed, stone, face), bed)
    face = face * smooth(-0.001, 0.001, stone - bed)
    pits = _pits(rng, u, v, 56) * face
    height = blur(height - 0.0022 * pits, 0.6)
    albedo = _brick_colour(rng, n, wall, face, coarse, grain, pits)
    rough = mix(0.97 + 0.0 * grain, 0.86 + 0.035 * coarse, face) + 0.05 * pits
    return Surface(edge, height, albedo, np.clip(rough, 0.6, 1), np.zeros_like(u), cavity=0.8)


def _wear(rng: Generator, n: int, wall: Blocks, coarse: Floats) -> Floats:
    """How far the outline of each brick lies off the rounded box, metres: ragged, and chipped."""
    ragged = 0.0011 * coarse + 0.0007 * spectral(rng, n, 0.8, low=20, high=110)
    chip = smooth(1.15, 2.1, spectral(rng, n, 1.0, low=8, high=40))
    lump = smooth(0.2, 1.4, spectral(rng, n, 0.9, low=26, high=80))
    return np.asarray(ragged - chip * (0.004 + 0.006 * lump) * smooth(0.016, 0.002, wall.inside))


def _brick_height(
    rng: Generator, wall: Blocks, inside: Floats, coarse: Floats, grain: Floats, count: int
) -> Floats:
    """Rounded edges, each brick set a little proud and askew, its face rough."""
    proud = rng.normal(0, 0.0009, count)[wall.piece]
    lean = rng.normal(0, 0.008, (2, count))[:, wall.piece]
    rounded = 0.0028 * np.sqrt(np.clip(1 - (1 - np.clip(inside / 0.007, 0, 1)) ** 2, 0, 1))
    rough = 0.00042 * coarse + 0.00016 * grain
    return np.asarray(rounded - 0.0028 + proud + lean[0] * wall.x + 1.6 * lean[1] * wall.y + rough)


def _pits(rng: Generator, u: Floats, v: Floats, across: int) -> Floats:
    """1 in small holes, mostly tiny, in about a quarter of the cells of a grid."""
    cells = worley(rng, u, v, across, across)
    size, there = rng.random((2, across * across))[:, cells.cell]
    radius = np.where(there > 0.72, 0.05 + 0.3 * size**4, 1e-9)
    uneven = 1 + 0.35 * np.sin(3 * np.arctan2(cells.dv, cells.du) + 20 * size)
    return smooth(radius, 0.4 * radius, cells.nearest * across * uneven)


def _brick_colour(
    rng: Generator, n: int, wall: Blocks, face: Floats, coarse: Floats, grain: Floats, pits: Floats
) -> Floats:
    """Clay fired to different reds, scorched in places, with lime bloom; sandy mortar."""
    clay = ("6d3a30", "844538", "96503f", "a05c48", "8d4a38", "ab6b52", "774039", "9b5f4e")
    color = pick(rng, 48, clay, 0.025)[wall.piece]
    cloud, fired = spectral(rng, n, 1.6, low=3), spectral(rng, n, 1.4, low=5, high=60)
    color = color * (1 + 0.05 * coarse + 0.05 * grain)[..., None]
    dark = level(1.6 * fired - 2.4 + rng.normal(0, 1.2, 48)[wall.piece])
    color = mix(color, color * hexes("8a7f86")[0], 0.8 * dark)
    bloom = level(2.2 * cloud + 0.9 * coarse + 0.8 * grain - 4.6)
    color = mix(color, hexes("c9b3a2")[0], 0.62 * bloom)
    flecks = smooth(1.9, 2.6, spectral(rng, n, 0.2, low=60))
    color = mix(color, hexes("4a2a26")[0], 0.5 * flecks)
    color = color * (1 - 0.35 * pits)[..., None]
    mortar = ramp(level(0.7 * cloud + 0.5 * coarse), (0, 0.5, 1), ("8a8176", "a2988a", "b5ab9c"))
    mortar = mortar * (1 + 0.07 * grain)[..., None]
    return mix(mortar, color, face)


def tiles(rng: Generator, n: int) -> Surface:
    """Hand-made glazed tiles, 4 x 4 on 0.6 m: no two lie quite level or have quite one green."""
    edge, count = 0.6, 16
    u, v = grid(n)
    sway = [0.0009 * spectral(rng, n, 2.0, high=16) for _ in range(2)]
    shift = rng.uniform(-0.006, 0.006, 4)
    wall = _blocks(u + sway[0], v + sway[1], edge, 4, 4, 0.0042, shift, 0.0035)
    nibble = 0.0016 * smooth(1.2, 2.4, spectral(rng, n, 0.8, low=14, high=70))
    inside = wall.inside - nibble
    face = smooth(-0.0006, 0.0008, inside)
    wave, orange = spectral(rng, n, 2.0, low=3, high=24), spectral(rng, n, 1.2, low=26, high=80)
    grout = -0.0019 + 0.00022 * spectral(rng, n, 0.5, low=30) + 0.0002 * orange
    height = mix(grout, _tile_height(rng, wall, inside, count, wave, orange), face)
    pits = 0.8 * _pits(rng, u, v, 50) * face * smooth(0.4, 1.3, orange)
    height = blur(height - 0.0004 * pits, 0.5)
    albedo = _tile_colour(rng, n, wall, face, inside, wave, pits)
    rough = _tile_roughness(rng, n, wall, face, pits)
    return Surface(edge, height, albedo, rough, np.zeros_like(u), cavity=1.6, steps=(2, 1, 4))


def _tile_height(
    rng: Generator, wall: Blocks, inside: Floats, count: int, wave: Floats, orange: Floats
) -> Floats:
    """A cushion that rounds off at the rim, leaning and dished differently for each tile."""
    lean = rng.normal(0, 0.011, (2, count))[:, wall.piece]
    dish = rng.normal(0.0006, 0.0006, count)[wall.piece] / 0.075**2
    rim = 0.0011 * np.sqrt(np.clip(1 - (1 - np.clip(inside / 0.005, 0, 1)) ** 2, 0, 1)) - 0.0011
    bowed = -dish * (wall.x**2 + wall.y**2)
    skin = 0.00010 * wave + 0.000012 * orange
    return np.asarray(rim + bowed + lean[0] * wall.x + lean[1] * wall.y + skin)


def _tile_colour(
    rng: Generator, n: int, wall: Blocks, face: Floats, inside: Floats, wave: Floats, pits: Floats
) -> Floats:
    """Green glaze, pooled dark in the middle, thin and pale at the rim, over a cream body."""
    glaze = ("1f5a55", "2a6f66", "347f73", "2c6a70", "3f8a78", "24605f")
    color = pick(rng, 16, glaze, 0.018)[wall.piece]
    middle = 1 - (np.hypot(wall.x, wall.y) / 0.085) ** 2
    run = spectral(rng, n, 1.6, low=5, high=90, stretch=(1.0, 2.0))
    pooled = level(0.7 * wave + 0.45 * run + 1.1 * middle - 0.6)
    color = color * (1.18 - 0.34 * pooled)[..., None]
    thin = smooth(0.0045, 0.0008, inside + 0.0006 * spectral(rng, n, 1.0, low=10, high=70))
    color = mix(color, hexes("b9a684")[0], 0.62 * thin)
    color = mix(color, hexes("d8c8a6")[0], 0.7 * pits)
    crackle = worley(rng, *grid(n), 46, 46)
    craze = smooth(0.0016, 0.0, crackle.second - crackle.nearest)
    color = mix(color, color * 0.78, 0.55 * craze * level(2 * wave - 0.6))
    grout = ramp(level(spectral(rng, n, 0.8, low=6)), (0, 1), ("8f887c", "b4ab9b"))
    return mix(grout, color, face)


def _tile_roughness(rng: Generator, n: int, wall: Blocks, face: Floats, pits: Floats) -> Floats:
    """Gloss that differs from tile to tile, dulled by wiped smears and a few matt spots."""
    smear = spectral(rng, n, 1.3, low=2, stretch=(3.0, 1.0))
    smear = sample(smear, *(c + 0.03 * spectral(rng, n, 2.2, high=6) for c in grid(n)))
    own = rng.uniform(0.2, 0.3, 16)[wall.piece]
    gloss = own + 0.16 * level(1.7 * smear - 1.2) + 0.35 * pits
    return mix(0.92 + 0.0 * smear, np.clip(gloss, 0.1, 0.9), face)


def plaster(rng: Generator, n: int) -> Surface:
    """Lime plaster as the trowel left it, on 1.2 m."""
    edge = 1.2
    u, v = grid(n)
    wind = [0.05 * spectral(rng, n, 2.2, high=8) for _ in range(2)]
    sweep = sample(spectral(rng, n, 1.5, low=2, stretch=(2.2, 1.0)), u + wind[0], v + wind[1])
    lip = ridges(sample(spectral(rng, n, 1.9, low=2, high=18), u + wind[1], v + wind[0]), 0.10)
    sand, bumps = spectral(rng, n, 0.5, low=20), spectral(rng, n, 1.6, low=3)
    crack = ridges(sample(spectral(rng, n, 1.6, low=2, high=30), u, v + wind[0]), 0.02)
    crack = crack * level(3 * spectral(rng, n, 2, high=6) - 5)
    height = 0.0019 * bumps + 0.0007 * sweep + 0.0014 * lip**2 + 0.00022 * sand - 0.002 * crack
    stain = spectral(rng, n, 1.8, low=1)
    color = ramp(level(stain + 0.35 * bumps), (0, 0.5, 1), ("d0c7b8", "d9d1c3", "dfd8cc"))
    color = color * (1 + 0.016 * sand + 0.008 * sweep - 0.25 * crack)[..., None]
    rough = np.clip(0.9 + 0.03 * sand - 0.1 * lip**2, 0.7, 1)
    return Surface(edge, height, color, rough, np.zeros_like(u), cavity=0.8)
