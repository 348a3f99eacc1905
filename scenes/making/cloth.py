"""Woven linen, a kilim, the edges of pages, and a small oil painting."""

from __future__ import annotations

import numpy as np

from scenes.making.noise import (
    Floats,
    Ints,
    blur,
    grid,
    level,
    mix,
    sample,
    smooth,
    spectral,
    worley,
)
from scenes.making.surface import Surface, hexes, ramp

__all__ = ["kilim", "linen", "pages", "painting"]

Generator = np.random.Generator


def linen(rng: Generator, n: int) -> Surface:
    """Undyed plain weave, 32 threads each way on 48 mm: thick and thin yarn, slubs, fluff."""
    edge, threads = 0.048, 32
    u, v = grid(n)
    warp = u + 0.0045 * spectral(rng, n, 1.5, low=3, high=40, stretch=(1.0, 2.0))
    weft = v + 0.0045 * spectral(rng, n, 1.5, low=3, high=40, stretch=(2.0, 1.0))
    column, row = np.floor(warp * threads).astype(int), np.floor(weft * threads).astype(int)
    thick = 0.42 + 0.05 * rng.standard_normal((2, threads)).clip(-1.5, 1.5)
    across_warp = (warp * threads - column - 0.5) / thick[0][column % threads]
    across_weft = (weft * threads - row - 0.5) / thick[1][row % threads]
    over = np.sin(np.pi * warp * threads) * np.sin(np.pi * weft * threads)
    wave = np.where((column + row) % 2 == 0, 1, -1) * np.abs(over)
    up = np.sqrt(np.clip(1 - across_warp**2, 0, 1)) + 0.75 * wave
    side = np.sqrt(np.clip(1 - across_weft**2, 0, 1)) - 0.75 * wave
    is_warp = smooth(-0.12, 0.12, up - side)
    twist = np.where(is_warp > 0.5, 1, -1) * 0.5 * (u + v * np.where(is_warp > 0.5, 1, -1))
    yarn = np.sin(2 * np.pi * 4 * threads * twist) * 0.06
    fluff = spectral(rng, n, 0.5, low=20)
    height = 0.00030 * (np.maximum(up, side) + yarn + 0.05 * fluff)
    tone = rng.normal(0, 0.03, (2, threads))
    shade = mix(tone[1][row % threads], tone[0][column % threads], is_warp) + 0.03 * fluff
    hollow = smooth(0.2, 1.3, np.maximum(up, side))
    color = hexes("c9c0b0")[0] * ((0.62 + 0.42 * hollow) * (1 + shade))[..., None]
    rough = np.clip(0.9 + 0.04 * fluff, 0.75, 1)
    return Surface(edge, height, color, rough, np.zeros_like(u), cavity=0.6, steps=(4, 4, 8))


def kilim(rng: Generator, n: int) -> Surface:
    """A flat-woven rug on 0.8 m: stepped diamonds in madder, indigo and wool, 96 x 96 stitches."""
    edge, stitches = 0.8, 96
    u, v = grid(n)
    u = u + 0.0016 * spectral(rng, n, 1.6, low=3, high=60)
    v = v + 0.0016 * spectral(rng, n, 1.6, low=3, high=60)
    column, row = (np.floor(c * stitches).astype(int) % stitches for c in (u, v))
    dye = _motif(column, row)
    streak = rng.normal(0, 0.045, (stitches, 1)) + rng.normal(0, 0.045, (stitches, stitches))
    colors = hexes("7e2c27", "27364f", "cdbb98", "9c5a2c", "3c2a26")
    color = colors[dye] * (1 + streak[row, column])[..., None]
    x, y = u * stitches - np.floor(u * stitches) - 0.5, v * stitches - np.floor(v * stitches) - 0.5
    hair = spectral(rng, n, 0.4, low=40)
    rib = np.sqrt(np.clip(1 - (2.05 * y) ** 2, 0, 1)) * (1 - 0.5 * smooth(0.3, 0.5, np.abs(x)))
    sunk = smooth(0.0, 0.5, rib)
    height = blur(0.0016 * rib + 0.00016 * hair + 0.0006 * spectral(rng, n, 2, high=12), 0.7)
    dust = level(1.5 * spectral(rng, n, 1.6, low=1) - 1.6)
    color = color * ((0.74 + 0.3 * sunk) * (1 + 0.05 * hair))[..., None]
    color = mix(color, hexes("9a8b78")[0], 0.18 * dust)
    rough = np.clip(0.95 + 0.02 * hair, 0.85, 1)
    return Surface(edge, height, color, rough, np.zeros_like(u), cavity=0.7, steps=(4, 4, 8))


def _motif(column: Ints, row: Ints) -> Ints:
    """Dye number of each stitch: nested stepped diamonds, between bands of small triangles."""
    x, y = np.abs(column % 48 - 23.5) // 2, np.abs(row - 47.5) // 2
    reach = (x + y * 0.75).astype(int)
    diamond = np.select(
        [reach < 3, reach < 5, reach < 8, reach < 10, reach < 14, reach < 15],
        [2, 3, 1, 2, 0, 4],
        1,
    )
    corner = (np.abs((column + 24) % 48 - 23.5) // 2 + y * 0.75).astype(int)
    field = np.where((diamond == 1) & (reach >= 15) & (corner < 4), 3, diamond)
    field = np.where((diamond == 1) & (reach >= 15) & (corner < 2), 2, field)
    band = y - 17
    teeth = np.abs(column % 12 - 5.5) < 6 - band
    border = np.where(band >= 6, 4, np.where(teeth, 2, 0))
    return np.where(band >= 0, np.where(band == 0, 4, border), field)


def pages(rng: Generator, n: int) -> Surface:
    """The cut edges of a book's pages, lying along u, on 32 mm: some stand out, some have aged."""
    edge = 0.032
    u, v = grid(n)
    leaf = spectral(rng, n, 0.3, low=16, high=120, stretch=(60.0, 1.0))
    block = spectral(rng, n, 1.2, low=2, high=40, stretch=(14.0, 1.0))
    gap = smooth(0.9, 2.0, leaf + 0.4 * block)
    age = level(spectral(rng, n, 1.8, low=1) + 0.4 * block)
    color = ramp(age, (0, 0.6, 1), ("e0d4b8", "d3c29f", "b89f74"))
    color = color * (1 + 0.035 * leaf - 0.3 * gap)[..., None]
    height = 0.00006 * leaf + 0.0001 * block - 0.00018 * gap
    rough = 0.88 + 0 * u
    return Surface(edge, height, color, rough, np.zeros_like(v), cavity=0.6, steps=(4, 4, 8))


def painting(rng: Generator, n: int) -> Surface:
    """A valley at evening in thick oils, 0.36 m, once over the square: it does not tile."""
    edge = 0.36
    u, v = grid(n)
    cells = [worley(rng, u, v, k, 2 * k) for k in (22, 40)]
    at_u, at_v = (c - d for c, d in zip((u, v), (cells[0].du, cells[0].dv), strict=True))
    fine_u, fine_v = (c - d for c, d in zip((u, v), (cells[1].du, cells[1].dv), strict=True))
    detail = at_v > 0.45
    color = _valley(rng, n, np.where(detail, fine_u, at_u), np.where(detail, fine_v, at_v))
    stroke = np.where(detail, cells[1].cell + 4000, cells[0].cell)
    touch = rng.normal(0, 1, (3, 12000))[:, stroke]
    color = color * (1 + 0.05 * touch[0] + 0.02 * spectral(rng, n, 0.6, low=20))[..., None]
    bristle = spectral(rng, n, 0.5, low=18, high=80, stretch=(5.0, 1.0))
    ends = smooth(0.0, 0.012, np.where(detail, *(c.second - c.nearest for c in cells[::-1])))
    height = 0.00045 * ends * (0.7 + 0.3 * touch[1]) + 0.00007 * bristle
    rough = np.clip(0.42 + 0.06 * touch[2] + 0.05 * bristle, 0.25, 0.8)
    return Surface(edge, blur(height, 0.7), color, rough, np.zeros_like(u), steps=(4, 4, 8))


def _valley(rng: Generator, n: int, u: Floats, v: Floats) -> Floats:
    """Evening sky, three ranges of hills and a river, at the places (u, v)."""
    cloud = sample(spectral(rng, n, 1.8, low=2, stretch=(3.0, 1.0)), u, v)
    sky = ramp(v + 0.05 * cloud, (0, 0.25, 0.42, 0.55), ("4d6a8c", "8fa3ad", "e0b483", "e8c99b"))
    sun = np.exp(-(((u - 0.66) / 0.07) ** 2) - ((v - 0.43) / 0.07) ** 2)
    color = mix(sky, hexes("f6e2ae")[0], 0.9 * sun)
    skyline = spectral(rng, n, 1.6, low=1, high=40)
    hills = (("7f8797", 0.47, 0.05), ("5c6b63", 0.55, 0.05), ("56622f", 0.66, 0.045))
    for i, (code, base, swing) in enumerate(hills):
        ridge = base + swing * sample(skyline, u, 0 * v + 0.13 + 0.3 * i)
        below = smooth(0.0, 0.012, v - ridge)
        light = 1.15 - 1.4 * (v - ridge) + 0.12 * sample(skyline, 2 * u, 2 * v)
        color = mix(color, hexes(code)[0] * light[..., None], below)
    bend = 0.52 + 0.16 * np.sin(9 * (v - 0.6)) * (v - 0.5)
    river = smooth(0.0, 0.02, 0.16 * (v - 0.68) - np.abs(u - bend)) * smooth(0.70, 0.74, v)
    color = mix(color, ramp(v, (0.7, 1.0), ("dcb98c", "6f8496")), river)
    return np.clip(color, 0, 1)
