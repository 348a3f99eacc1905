"""Arguments for the functions of lib/, and for what choices define beside their contract."""

import itertools
import math
from collections.abc import Callable

import numpy as np

from lightbench.exact.directions import unit
from lightbench.front_matter import Choice
from tests.ray_arguments import RAYS
from tests.samples import (
    COUNT,
    ODD,
    Arguments,
    around,
    interior,
    material,
    pairs,
    rays,
    single,
    uniform,
)

NORMALS = unit(np.random.default_rng(4).normal(size=(COUNT, 3)))
POLES = [[0, 0, 1], [0, 0, -1], [1, 0, 0], [0, -1, 0], [1e-4, 0, -1], [0, 1e-7, 1]]
FACING = single(np.concatenate([NORMALS, POLES]))
VIEWS = np.roll(FACING, 1, axis=0)
EXPONENTS = 10.0 ** uniform(-1.0, 6.0)
ANGLES = np.minimum(uniform(0.0, 6.0) / np.sqrt(EXPONENTS), 1.57)
UNITS = tuple(single(uniform(0.01, 1.0, COUNT, k)[:, 0]) for k in (2, 3, 4, 5))
GRAZING = pairs()
TOWARDS = rays(10.0 ** uniform(-2.0, 4.0), uniform(0.0, 1.4, COUNT, 1)[:, 0])
# Towards a sphere and away from it, from outside and from inside.
SPHERE_RAYS = (np.tile(TOWARDS[0], (2, 1)), np.concatenate([TOWARDS[1], -TOWARDS[1]]), *TOWARDS[2:])
# Dark, bright and nearly white, for every share from clear to metal and both ends many times.
REFLECTANCES = single(
    np.concatenate([10.0 ** uniform(-8.0, -0.01, COUNT, 3), uniform(0.9, 0.998, COUNT, 3)])
)
SHARES = single(np.resize([*np.linspace(0.0, 1.0, 101), 0.0, 1.0, 1e-3, 0.999], 2 * COUNT))
BASE = material([0.5], [1.0]) | {"metalness": single(np.linspace(0.0, 1.0, COUNT))}

# Tones of one light to eight, each value of a mean that they can have; and what lies around 0.5.
LEVELS = single(
    sorted({sum(t) / n for n in (1, 2, 3) for t in itertools.product(range(8), repeat=n)})
)
# Codes of 255 in the steps that a normal map is read in.
CODES = np.round(uniform(0.0, 1.0, COUNT + 6, 3) * 255.0 * 256.0) / (255.0 * 256.0)
UNIT_COLORS = uniform(0.0, 1.0, COUNT, 3)
# Towards every face, along every axis, and through edges and corners that both sides round alike.
ACROSS = single(
    [*uniform(-2.0, 2.0, COUNT, 3), *itertools.product((-1.0, 0.0, 0.5, 1.0), repeat=3)]
)
ACROSS = ACROSS[np.abs(ACROSS).max(axis=1) > 0.0]
NEIGHBOURS = tuple(single(uniform(-2.0, 2.0, COUNT, 4) + 0.1 * k) for k in range(8))
# Around the ray or not, before its origin and behind it, either way round; with a corner or an edge
# on the ray, from both sides, and seen edge-on.
ON_RAY = np.array(
    [[[0, 0, 1], [1, 0, 2], [0, 1, 3]], [[0, 0, 1], [0, 1, 3], [1, 0, 2]],
     [[-1, 0, 1], [1, 0, 2], [0, 1, 3]], [[-1, 0, 1], [0, 1, 3], [1, 0, 2]],
     [[-1, 0, 1], [1, 0, 2], [2, 0, 3]], [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]], np.float64,
)  # fmt: skip
CORNERS = tuple(
    single(np.concatenate([uniform(-1.0, 1.0, COUNT, 3 * k)[:, :3] + middle, ON_RAY[:, k - 1]]))
    for k, middle in enumerate(((0.8, 0.0, 0.8), (-0.4, 0.7, 0.8), (-0.4, -0.7, 0.8)), 1)
)
# Points around a square and inside it, on its corners and in its middle; its sides, short and long.
POINTS = single([*uniform(-2.0, 2.0, COUNT, 2), [0, 0], [1, 1], [1, 0]])
SIDES = tuple(
    single([*uniform(-1.0, 1.0, COUNT, 4)[:, k : k + 2], [1e-6, 0], *np.eye(2)]) for k in (0, 2)
)
# Arguments for the functions that a folder allows beside those of its contract, by name.
OTHERS: dict[str, Callable[[], Arguments]] = {
    "inspect": lambda: (material(uniform(0.0, 1.0), [1.0]) | {"base_color": single(UNIT_COLORS)},),
    "mapping": lambda: (FACING * single(10.0 ** uniform(-6.0, 6.0, len(FACING), 1)),),
    "modulated": lambda: (single(uniform(0.0, 9.0, COUNT, 3)), single(UNIT_COLORS)),
    "reflected": lambda: interior("models", Choice()),
    "seen": lambda: (single(uniform(0.0, 1.0)),),
    "shift": lambda: (UNITS[0], single([*UNITS[1][:-2], 1.0, 1.0 - 2.0**-24])),
    "term": lambda: interior("models", Choice()),
    "toneLevel": lambda: (
        single([*np.linspace(0.0, 1.0, 10), *uniform(0.0, 1.0), 0.5, 0.49999997]),
    ),
    "toned": lambda: (material([0.5], [1.0]), LEVELS),
}

# Arguments for the functions of lib/, by file and name.
LIB: dict[tuple[str, str], Callable[[], Arguments]] = {
    **RAYS,
    ("alpha", "alphaFromRoughness"): lambda: (single([0.0, 1e-3, 0.01, 0.3, 1.0]),),
    ("base", "blendWithBase"): lambda: (BASE, single(uniform(0.0, 2.0, COUNT, 3))),
    ("base", "overBase"): lambda: (
        BASE, single(uniform(0.0, 1.0, COUNT, 3)), single(uniform(0.0, 2.0, COUNT, 3))),
    ("conductor", "clearEta"): lambda: (REFLECTANCES,),
    ("conductor", "etaOf"): lambda: (REFLECTANCES, SHARES),
    ("conductor", "kOf"): lambda: (REFLECTANCES, SHARES),
    ("cube", "cubeDirection"): lambda: (
        single(np.c_[uniform(-0.5, 1.5, COUNT, 2), np.arange(COUNT) % 6]),),
    ("cube", "cubeFace"): lambda: (ACROSS,),
    ("disk", "diskPoint"): lambda: (single([*range(64), 0, 7]), single([*[64] * 64, 1, 8])),
    ("display", "displayRange"): lambda: (single([*ODD, [2.0, 0.5, 1.0]]),),
    ("frame", "facingNormal"): lambda: (
        np.concatenate([FACING, FACING]), np.concatenate([VIEWS, -FACING])),
    ("frame", "halfVector"): lambda: (
        np.concatenate([FACING, FACING]), np.concatenate([VIEWS, -FACING])),
    ("frame", "unitNormal"): lambda: (
        FACING * single(10.0 ** uniform(-12.0, 3.0, len(FACING), 1)), VIEWS),
    ("erf", "erfc"): lambda: (single([*np.linspace(-4.0, 9.0, COUNT), 0.0, -20.0]),),
    ("fresnel", "fresnel0"): lambda: (UNITS[0] + 1, UNITS[1] + 2),
    ("fresnel", "pow5"): lambda: (UNITS[0],),
    ("heat", "heat"): lambda: (single([*uniform(0.0, 1.2), 0.0, 0.25, 0.5, 0.75, 1.0, 1e30]),),
    ("invalid", "flagInvalid"): lambda: (single(ODD), single([[0.1, 0.2, 0.3]])),
    ("invalid", "invalid"): lambda: (single(ODD),),
    ("lambda_beckmann", "cosLambdaBeckmann"): lambda: (GRAZING[0], GRAZING[2]),
    ("lambda_beckmann", "lambdaBeckmann"): lambda: (around(1e-3, 5), UNITS[0]),
    ("lambda_beckmann_exact", "cosLambdaBeckmannExact"): lambda: (GRAZING[0], GRAZING[2]),
    ("lambda_beckmann_exact", "lambdaBeckmannExact"): lambda: (around(1e-3, 5), UNITS[0]),
    ("lambda_ggx", "slopeGgx"): lambda: (GRAZING[0], GRAZING[2]),
    ("lambda_ggx", "lambdaGgx"): lambda: (around(1e-3, 5), UNITS[0]),
    ("log1p", "log1p"): lambda: (
        single([s * x for s in (-0.25, 0.25) for x in np.geomspace(1e-30, 1, 500)]),),
    ("luminance", "luminance"): lambda: (single(uniform(0.0, 2.0, COUNT, 3)),),
    ("slope", "slopeBias"): lambda: (
        UNITS[0], UNITS[1], single([*UNITS[2][:-4], 1.0, 1.0 - 2.0**-24, 0.0, 1.0000001])),
    ("smith", "smithCorrelated"): lambda: UNITS,
    ("smith", "smithSeparable"): lambda: UNITS,
    ("sobel", "sobel"): lambda: NEIGHBOURS,
    ("specular_power", "specularPower"): lambda: (
        single([*np.cos(ANGLES), 0, 0, -1, -1, 1]), single([*np.sin(ANGLES) ** 2, 1, 1, 0, 0, 0]),
        single([*EXPONENTS, 0, 1, 0, 1, 1e6])),
    ("sphere", "sphereHit"): lambda: SPHERE_RAYS,
    ("spot", "spot"): lambda: (
        single([*uniform(-1.0, 1.0), 0.5, 0.5, 0.4999, 1, 1, -1]),
        single([*uniform(0.0, 1.0, COUNT, 1)[:, 0], 0.5, 0.2, 0.5, 1, 0, -1]),
        single([*uniform(-1.0, 0.0, COUNT, 1)[:, 0], 0.5, 0.5, 0.5, 1, 0, -1])),
    ("strokes", "circleDistance"): lambda: (POINTS, SIDES[0]),
    ("strokes", "lineDistance"): lambda: (POINTS, SIDES[0]),
    ("strokes", "segmentDistance"): lambda: (POINTS, SIDES[0]),
    ("strokes", "squareDistance"): lambda: (POINTS, *SIDES),
    ("strokes", "strokeCoverage"): lambda: (
        single([*uniform(0.0, 3.0, COUNT, 2)[:, 0], 0, 1.5]),
        single([*uniform(1.0, 4.0, COUNT, 2)[:, 1], 1, 2])),
    ("tangent", "mappedNormal"): lambda: (
        FACING, single(np.c_[VIEWS, np.resize([1.0, -1.0], len(VIEWS))]),
        single([*CODES[1:], [128 / 255, 128 / 255, 1.0]]),
        single(uniform(0.0, 4.0, len(FACING), 1)[:, 0])),
    ("tangent", "unpackNormal"): lambda: (
        single(CODES[:COUNT]), single(uniform(0.0, 4.0, COUNT, 1)[:, 0])),
    ("watertight", "cornersHit"): lambda: CORNERS,
    ("watertight", "edgeSide"): lambda: (CORNERS[0][:, :2], CORNERS[1][:, :2]),
    ("watertight", "projected"): lambda: (
        {"across": VIEWS, "up": FACING, "along": NEIGHBOURS[0][:1, :3]}, FACING[::-1].copy()),
    ("tone", "hasTone"): lambda: (single([0.0, -1.0, 1.0, math.nan, math.inf, -math.inf, 1e38]),),
}  # fmt: skip
