"""Brushed metal and gold leaf."""

from __future__ import annotations

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
    strokes,
    worley,
)
from scenes.making.surface import Surface, hexes, ramp

__all__ = ["brushed_metal", "gold_leaf"]

Generator = np.random.Generator


def brushed_metal(rng: Generator, n: int) -> Surface:
    """Steel brushed along u on 0.3 m, with stray scratches and the dullness of hands."""
    edge = 0.3
    long = spectral(rng, n, 0.35, low=4, high=200, stretch=(90.0, 1.0))
    short = spectral(rng, n, 0.15, low=20, high=240, stretch=(22.0, 1.0))
    broad = spectral(rng, n, 1.2, low=1, high=60, stretch=(40.0, 1.0))
    scratch = strokes(rng, n, 70, length=(0.05, 0.5), angle=(0.0, 0.05), width=0.6)
    stray = strokes(rng, n, 9, length=(0.08, 0.35), angle=(0.5, 0.5), width=0.6)
    lines = 0.6 * long + 0.5 * short + 0.4 * broad
    height = 0.0000075 * lines - 0.000026 * scratch - 0.00003 * stray
    hands = spectral(rng, n, 2.0, low=1, high=30)
    dull = level(1.8 * hands - 2.2)
    tone = 0.755 + 0.022 * lines - 0.06 * scratch - 0.05 * stray - 0.03 * dull
    color = tone[..., None] * np.array([1.0, 0.992, 0.975])
    rough = 0.32 + 0.035 * lines + 0.11 * dull + 0.12 * scratch + 0.15 * stray
    rough = rough + 0.02 * spectral(rng, n, 1.0, low=8)
    return Surface(
        edge,
        height,
        np.clip(color, 0, 0.93),
        np.clip(rough, 0.18, 0.75),
        np.ones((n, n)),
        cavity=0.5,
        steps=(2, 2, 4),
    )


def gold_leaf(rng: Generator, n: int) -> Surface:
    """Leaves of 80 mm laid on red clay, 4 x 4 on 0.32 m: seams, creases, tears and worn places."""
    edge = 0.32
    u, v = grid(n)
    torn = [0.004 * spectral(rng, n, 1.5, low=6, high=120) for _ in range(2)]
    leaf, inside = _leaves(rng, u + torn[0], v + torn[1])
    ground = 0.00018 * spectral(rng, n, 1.8, low=3, high=60) + 0.00003 * spectral(
        rng, n, 0.8, low=30
    )
    crease, fold = _creases(rng, n)
    seam = smooth(0.0, 0.016, inside)
    lap = smooth(0.05, 0.044, inside)
    lack = _missing(rng, n, inside, crease, ground)
    gold = 1 - lack
    film = (
        0.00012 * lap + 0.00016 * fold + 0.00010 * crease + 0.00002 * spectral(rng, n, 1.0, low=20)
    )
    height = blur(ground + (0.00006 + film) * gold, 0.7)
    color = _gold_colour(rng, leaf, lap, seam, crease, n)
    clay = ramp(level(spectral(rng, n, 1.2, low=4)), (0, 0.5, 1), ("742f20", "8e4029", "a55436"))
    color = mix(clay * (1 + 0.06 * spectral(rng, n, 0.4, low=30))[..., None], color, gold)
    rub = level(1.4 * spectral(rng, n, 1.6, low=2) - 1.0)
    shine = 0.24 + 0.08 * rng.random(16)[leaf] + 0.14 * rub + 0.10 * crease + 0.05 * lap
    rough = mix(0.8 + 0.06 * spectral(rng, n, 0.8, low=20), shine, gold)
    return Surface(edge, height, np.clip(color, 0, 1), np.clip(rough, 0.15, 1), gold, cavity=1.0)


def _leaves(rng: Generator, u: Floats, v: Floats) -> tuple[Ints, Floats]:
    """(leaf of each texel, distance inside its edge in texture edges), each a little askew.

    Of the leaves that cover a texel the last one laid lies on top; nearly all of it overlaps.
    """
    order, on_top = rng.permutation(16), np.full(u.shape, -1)
    leaf, inside = np.zeros(u.shape, dtype=np.int64), np.zeros_like(u)
    for i in range(16):
        turn, centre = rng.normal(0, 0.02), (np.array([i % 4, i // 4]) + 0.5) / 4
        dx, dy = (
            (c - m + rng.normal(0, 0.006) + 0.5) % 1 - 0.5
            for c, m in zip((u, v), centre, strict=True)
        )
        x, y = dx * np.cos(turn) - dy * np.sin(turn), dx * np.sin(turn) + dy * np.cos(turn)
        depth = 0.132 - np.maximum(np.abs(x), np.abs(y))
        above = (depth > 0) & (order[i] > on_top)
        on_top = np.where(above, order[i], on_top)
        leaf, inside = np.where(above, i, leaf), np.where(above, depth, inside)
    return leaf, inside


def _creases(rng: Generator, n: int) -> tuple[Floats, Floats]:
    """(sharp thin wrinkles, soft broad ones), 0..1, in patches."""
    u, v = grid(n)
    bend = [0.02 * spectral(rng, n, 1.9, low=3, high=60) for _ in range(2)]
    cells = worley(rng, u + bend[0], v + bend[1], 9, 9)
    net = smooth(0.010, 0.0, cells.second - cells.nearest)
    warped = sample(spectral(rng, n, 1.4, low=4, high=60), u + bend[1], v + bend[0])
    patchy = level(2.2 * spectral(rng, n, 1.8, low=2, high=12) - 0.8)
    return np.maximum(net * patchy, 0.7 * ridges(warped, 0.07) * patchy), ridges(warped, 0.6) ** 2


def _missing(rng: Generator, n: int, inside: Floats, crease: Floats, ground: Floats) -> Floats:
    """1 where clay shows: gaps between leaves, broken creases, rubbed high places."""
    crumb = spectral(rng, n, 0.9, low=12, high=150)
    worn = spectral(rng, n, 1.2, low=6, high=90) + 0.5 * ground / ground.std()
    edge = smooth(0.011, 0.0, inside)
    score = 1.25 * worn + 0.75 * crumb + 2.3 * edge + 0.9 * crease - 3.35
    return smooth(0.0, 0.35, np.asarray(score))


def _gold_colour(
    rng: Generator, leaf: Ints, lap: Floats, seam: Floats, crease: Floats, n: int
) -> Floats:
    """Leaf gold; where leaves overlap it is fuller, where thin the clay warms it."""
    tone = rng.normal(0, 0.02, 16)[leaf]
    color = hexes("fcd78c")[0] + tone[..., None] * np.array([1.0, 1.2, 1.8])
    thin = level(1.3 * spectral(rng, n, 1.3, low=4, high=120) - 1.5) * (1 - 0.6 * lap)
    color = mix(color, hexes("eec07a")[0], 0.7 * thin)
    return np.asarray(color * (0.96 + 0.04 * seam - 0.04 * crease)[..., None])
