"""Wood, cut from an imagined trunk: rings, pores, knots; laid as planks or glued as staves."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from scenes.making.noise import Floats, Ints, blur, grid, level, mix, sample, smooth, spectral
from scenes.making.surface import Surface, hexes, pick, ramp

__all__ = ["walnut", "wood"]

Generator = np.random.Generator


class Boards(NamedTuple):
    """Boards lying along u: each texel's board, and its place in it in metres.

    `x` runs along the board from its left end, `y` across from its middle line; `inside` is the
    distance to its nearest edge.
    """

    piece: Ints
    x: Floats
    y: Floats
    inside: Floats


class Grain(NamedTuple):
    """What the saw laid open: `ring` 0..1 from early to late wood, `pores`, `knot`, all 0..1."""

    ring: Floats
    pores: Floats
    knot: Floats


def _boards(
    u: Floats, v: Floats, edge: float, rows: int, joints: list[list[float]], gap: float
) -> Boards:
    """`rows` rows of boards; row i is cut at the places joints[i], in texture edges."""
    row = np.floor(v * rows).astype(int) % rows
    y = (v * rows - np.floor(v * rows) - 0.5) * edge / rows
    x, to_end, index = np.zeros_like(u), np.full_like(u, np.inf), np.zeros(u.shape, dtype=np.int64)
    most = max(1, *(len(cuts) for cuts in joints))
    for i, cuts in enumerate(joints):
        here = row == i
        index[here] = i * most
        x[here] = u[here] * edge
        for j, cut in enumerate(cuts):
            past, following = (u - cut) % 1, cuts[(j + 1) % len(cuts)]
            length = (following - cut) % 1 or 1.0
            mine = here & (past <= length)
            index[mine] = i * most + j
            x[mine] = past[mine] * edge
            to_end[mine] = np.minimum(past, length - past)[mine] * edge
    across = edge / rows / 2 - np.abs(y)
    return Boards(index, x, y, np.minimum(across, to_end) - gap / 2)


def _grain(
    rng: Generator, n: int, edge: float, boards: Boards, knots: int, ring: float, wander: float
) -> Grain:
    """Cut every board from its own place in a trunk with rings `ring` metres wide.

    `wander` is how far, in metres, the trunk's axis strays from the saw's line: it makes arches.
    """
    count = int(boards.piece.max()) + 1
    u, v = grid(n)
    shift = rng.random((2, count))[:, boards.piece]
    around = (u + shift[0], v + shift[1])
    long = sample(spectral(rng, n, 2.2, low=1, high=20, stretch=(3.0, 1.0)), *around)
    fine = sample(spectral(rng, n, 1.4, low=6, high=70, stretch=(7.0, 1.0)), *around)
    turn = 2 * np.pi * boards.x / edge
    phase, swing = rng.uniform(0, 2 * np.pi, count), rng.uniform(0.25, 1.0, count)
    depth = rng.uniform(0.01, 0.075, count)[boards.piece]
    aside = rng.normal(0, 0.035, count)[boards.piece]
    y, knot, rays = _around_knots(rng, edge, boards, knots)
    rise = wander * (swing[boards.piece] * np.sin(turn + phase[boards.piece]) + 0.7 * long)
    radius = np.hypot(y - aside + 0.2 * wander * long, depth + rise) + 0.0008 * fine
    years = radius / ring + 0.5 * np.sin(radius / ring * 0.9 + phase[boards.piece])
    years = mix(years, rays, smooth(0.15, 0.75, knot))
    part = years - np.floor(years)
    late = smooth(0.05, 0.8, part) ** 1.6 * smooth(1.0, 0.88, part)
    return Grain(late, _pores(rng, n, around, late), knot)


def _around_knots(
    rng: Generator, edge: float, boards: Boards, knots: int
) -> tuple[Floats, Floats, Floats]:
    """(y with the grain led around the knots, how near a knot 0..1, rings within the knot)."""
    y, near, rings = boards.y.copy(), np.zeros_like(boards.y), np.zeros_like(boards.y)
    for board in rng.choice(int(boards.piece.max()) + 1, knots, replace=False):
        here = boards.piece == board
        if not here.any():
            continue
        length, half = boards.x[here].max(), np.abs(boards.y[here]).max()
        x0, y0 = rng.uniform(0.3, 0.7) * length, rng.uniform(-0.55, 0.55) * half
        size = rng.uniform(0.006, 0.013)
        dx, dy = np.where(here, boards.x - x0, 9.0), boards.y - y0
        bulge = np.exp(-((dx / (5 * size)) ** 2) - (dy / (2.6 * size)) ** 2)
        y += np.where(here, -1.6 * size * np.tanh(dy / size) * bulge, 0)
        distance = np.hypot(dx * 0.8, dy) / size
        near = np.maximum(near, smooth(1.5, 0.75, distance) * here)
        rings = np.where(distance < 1.6, 4.2 * distance, rings)
    return y, near, rings


def _pores(rng: Generator, n: int, around: tuple[Floats, Floats], late: Floats) -> Floats:
    """Cut vessels: short dark dashes along the grain, thickest in early wood."""
    dashes = sample(spectral(rng, n, 0.2, low=100, high=230, stretch=(11.0, 1.0)), *around)
    patchy = sample(spectral(rng, n, 1.5, low=2, stretch=(3.0, 1.0)), *around)
    return smooth(1.1, 2.6, dashes + 0.3 * patchy + 0.9 * (0.5 - late))


def wood(rng: Generator, n: int) -> Surface:
    """An oak floor on 1.2 m: 8 rows of boards with worn edges and oil in the grain."""
    edge = 1.2
    u, v = grid(n)
    first = rng.permutation(8) / 8 + rng.uniform(0, 0.06, 8)
    joints = [[float(a % 1), float((a + rng.uniform(0.4, 0.6)) % 1)] for a in first]
    boards = _boards(u, v + 0.0006 * spectral(rng, n, 2, high=8), edge, 8, joints, 0.0022)
    grain = _grain(rng, n, edge, boards, 5, 0.0052, 0.018)
    bow = spectral(rng, n, 2.0, low=3, high=20, stretch=(1.0, 0.5))
    on = smooth(-0.0007, 0.0009, boards.inside + 0.0004 * bow)
    rounded = 0.0011 * smooth(0.0045, 0, boards.inside) ** 2
    proud = rng.normal(0, 0.00035, 16)[boards.piece] + rng.normal(0, 0.006, 16)[boards.piece] * (
        boards.y
    )
    cut = -0.00022 * grain.pores - 0.00018 * (1 - grain.ring) + 0.00025 * grain.knot
    height = mix(-0.0038 + 0 * u, proud - rounded + cut + 0.00022 * bow, on)
    tones = ("9a6f48", "b0855a", "a87a50", "c0966a", "b58a5e", "8f6743")
    color = _stain(pick(rng, 16, tones, 0.016)[boards.piece], grain, rng, n, 0.26)
    worn = level(1.3 * spectral(rng, n, 1.7, low=1) + 0.3 * spectral(rng, n, 0.6, low=20) - 0.9)
    color = mix(color, np.clip(color * 1.08 + 0.025, 0, 1), worn)
    color = mix(hexes("33261b")[0], color * (1 - 0.3 * rounded / 0.0011)[..., None], on)
    rough = 0.40 + 0.10 * (1 - grain.ring) + 0.22 * grain.pores + 0.16 * worn - 0.08 * grain.knot
    rough = mix(0.9 + 0 * u, np.clip(rough, 0.25, 1), on)
    return Surface(edge, blur(height, 0.5), color, rough, np.zeros_like(u), cavity=0.9)


def walnut(rng: Generator, n: int) -> Surface:
    """Furniture board on 0.5 m: 4 walnut staves glued edge to edge, oiled."""
    edge = 0.5
    u, v = grid(n)
    boards = _boards(u, v, edge, 4, [[], [], [], []], 0.0)
    grain = _grain(rng, n, edge, boards, 0, 0.0040, 0.008)
    height = -0.00010 * grain.pores - 0.00003 * (1 - grain.ring)
    base = pick(rng, 4, ("5f4534", "6d513d", "785a44", "664b38"), 0.01)[boards.piece]
    color = _stain(base, grain, rng, n, 0.27)
    seam = smooth(0.0008, 0, boards.inside)
    color = color * (1 - 0.25 * seam)[..., None]
    rough = 0.33 + 0.06 * (1 - grain.ring) + 0.25 * grain.pores
    rough = rough + 0.05 * spectral(rng, n, 1.6, low=1)
    return Surface(
        edge, blur(height, 0.6), color, np.clip(rough, 0.22, 0.9), np.zeros_like(u), cavity=0.8
    )


def _stain(base: Floats, grain: Grain, rng: Generator, n: int, depth: float) -> Floats:
    """Darken late wood, pores and knots, and let the tone drift along the boards."""
    drift = spectral(rng, n, 1.8, low=1, stretch=(3.0, 1.0))
    silk = spectral(rng, n, 0.7, low=12, stretch=(18.0, 1.0))
    shade = 1 - depth * grain.ring + 0.04 * drift + 0.035 * silk
    warm = np.stack([np.ones_like(shade), 1 - 0.10 * grain.ring, 1 - 0.22 * grain.ring], axis=-1)
    color = base * (1.14 * shade)[..., None] * warm
    color = mix(color, color * hexes("6d5646")[0], 0.75 * grain.pores)
    core = 0.85 * grain.knot * (0.6 + 0.4 * grain.ring)
    return mix(color, ramp(grain.ring, (0, 1), ("6b4127", "3a2014")), core)
