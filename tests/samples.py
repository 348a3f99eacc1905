"""Arguments for every shader function: random ones of its domain's interior, and its extremes."""
# ruff: noqa: E741  (l is the direction to the light)

import itertools
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.exact.directions import Array, half_vector, unit
from lightbench.front_matter import Choice
from lightbench.glsl import call, material_fields, source_of
from tests.support import library

Single = NDArray[np.float32]
Argument = Single | dict[str, Single]
Arguments = tuple[Argument, ...]
Settings = Mapping[str, Any]

COUNT = 2000
ALPHAS = (0.0, 1e-4, 1e-3, 0.002025, 0.045, 0.3, 1.0)
COSINES = (0.0, 1e-7, 1e-4, 0.5, 1.0)
AZIMUTHS = (0.0, 1.0, 2.5, math.pi)
ODD = (
    [math.nan, 0.5, 0.5], [math.inf, 1.0, 0.0], [-math.inf, 0.2, 3.0], [-1.0, 0.5, 0.5],
    [math.inf, math.nan, -1.0], [0.0, 0.0, 0.0], [-0.0, 1.0, 1.0], [1.0, 2.0, -1e-30],
)  # fmt: skip
LIGHTS = (0.0, 1e-30, 1e-7, 0.0031308, 0.18, 1.0, 4.0, 65504.0, 1e19, 1e30, 1e37)


def single(values: Any) -> Single:
    """As float32."""
    return np.asarray(values, np.float32)


def doubled(arguments: Arguments) -> list[Any]:
    """The same values in float64, for a reference."""
    return [
        {k: v.astype(np.float64) for k, v in a.items()}
        if isinstance(a, dict)
        else a.astype(np.float64)
        for a in arguments
    ]


def direction(cosine: Array, azimuth: Array) -> Single:
    """Unit vectors with z = cosine; azimuths 0 and pi stay exactly in the plane y = 0."""
    sine = np.sqrt(1.0 - np.square(cosine))
    y = np.where(azimuth == math.pi, 0.0, np.sin(azimuth))
    return single(np.stack([sine * np.cos(azimuth), sine * y, cosine], axis=-1))


def uniform(low: float, high: float, *shape: int) -> Array:
    """The same random numbers for the same shape in every run."""
    return np.random.default_rng([*shape, 7]).uniform(low, high, shape or COUNT)


def around(low: float, seed: int) -> Single:
    """Random directions no lower than a cosine."""
    random = np.random.default_rng(seed)
    return direction(random.uniform(low, 1.0, COUNT), random.uniform(0.0, 2.0 * math.pi, COUNT))


def pairs() -> tuple[Single, Single, Single]:
    """l, v and alpha: every combination of the extreme cosines, azimuths and widths."""
    rows = np.array(list(itertools.product(COSINES, COSINES, AZIMUTHS, ALPHAS)))
    return (
        direction(rows[:, 0], np.zeros(len(rows))),
        direction(rows[:, 1], rows[:, 2]),
        single(rows[:, 3]),
    )


def halves(l: Single, v: Single) -> Single:
    """Half vectors rounded once."""
    return single(half_vector(l.astype(np.float64), v.astype(np.float64)))


def rays(distance: Array, offset: Array, radius: float = 1.0) -> tuple[Single, ...]:
    """Rays from a distance to the centre of a sphere, in radii, that pass it at an offset."""
    random = np.random.default_rng(9)
    out = unit(random.normal(size=(len(distance), 3)))
    side = unit(np.cross(out, random.normal(size=out.shape)))
    origin = single(out * distance[:, None] * radius)
    target = side * offset[:, None] * radius
    return origin, single(unit(target - origin)), single([[0.0, 0.0, 0.0]]), single([radius])


def material(roughness: Any, shininess: Any) -> dict[str, Single]:
    """Every field that a material can have."""
    return {
        "base_color": single([[0.9, 0.5, 0.1]]), "metalness": single([0.3]),
        "roughness": single(roughness), "f0": single([[0.04, 0.5, 0.0]]),
        "eta": single([[0.2, 1.5, 2.9]]), "k": single([[3.9, 0.0, 3.1]]),
        "kd": single([[0.1, 0.2, 0.05]]), "ks": single([[0.3, 0.5, 2.0]]),
        "shininess": single(shininess),
    }  # fmt: skip


def indices(eta: Any, k: Any) -> dict[str, Single]:
    """Complex indices of eta and k (N,), the blue one clear, its eta from 1 on."""
    return {
        "eta": single(np.stack([eta, eta[::-1], np.maximum(eta, 1.0)], axis=-1)),
        "k": single(np.stack([k, k[::-1], 0.0 * k], axis=-1)),
    }


def lights(meta: Choice, *, extreme: bool) -> dict[str, Single]:
    """A light, its per-light parameters at random or at the ends of their ranges."""
    fields = {"intensity": single([[1.0, 1.0, 1.0]])}
    names = [n for n, p in meta.parameters.items() if p.per == "light"]
    ranges = [meta.parameters[n].range or (0.0, 1.0) for n in names]
    ends = np.array(list(itertools.product(*ranges, range(len(DISTANCES)))))
    for index, (name, (low, high)) in enumerate(zip(names, ranges, strict=True)):
        random = uniform(low, high, COUNT, index + 1)[:, 0]
        fields[name] = single(ends[:, index] if extreme else random)
    return fields


# Of a complex index; below 1 without k there is an angle at which F is as steep as it gets.
INDICES = ((0.02, 0.2, 1.0, 1.0001, 3.0, 100.0), (1e-3, 0.1, 1.0, 5.0, 100.0))
INDEX_COUNT = math.prod(map(len, INDICES))
DISTANCES = (0.0, 1e-4, 1.0, 20.0, 1e5, 1e15)


# Distance from the light, far, reach and cosine of a receiver.
BIASED = ((0.05, 50.0), (50.0, 100.0), (1e-4, 0.1), (0.0, 1.0))
BIASED_EXTREMES = (
    (0.0, 1e-4, 1.0, 1e3, 1e5), (1e-6, 1.0, 1e6), (0.0, 1e-7, 1.0, 1e5),
    (0.0, 1e-7, 0.1, 0.5, 1.0 - 2.0**-24, 1.0, 1.0000001),
)  # fmt: skip
PIXELS = single(list(itertools.product((0.0, 1.0, 4095.0), repeat=2)))
# Codes off every level and threshold of 64 a level, and the ends; in pixels anywhere.
STEPS = np.arange(1, 3 * COUNT + 1).reshape(COUNT, 3)
CODES: Arguments = (
    single((STEPS % 255 + (STEPS % 63 + 1 + uniform(-0.25, 0.25, COUNT, 3)) / 64.0) / 255.0),
    single(np.floor(uniform(0.0, 4096.0, COUNT, 2))),
)
CODE_ENDS: Arguments = (single([[0.0, 1.0, 0.0]]), PIXELS)
LIT_POINTS: Arguments = (
    single([0.0]),
    {"position": single(uniform(-5.0, 5.0, COUNT, 3)), "normal": single([[0.0, 1.0, 0.0]]),
     "toLight": single([[0.0, 1.0, 0.0]]), "distance": single([1.0]), "object": single([0.0]),
     "NoL": single(uniform(0.0, 1.0)), "gap": single([0.0])},
)  # fmt: skip


def interior(folder: str, meta: Choice) -> Arguments:
    """Random arguments of the folder's contract, away from every edge."""
    random = np.random.default_rng(1)
    alpha = single(random.uniform(0.05, 1.0, COUNT))
    l, v = around(0.05, 2), around(0.05, 3)
    m = material(random.uniform(0.25, 1.0, COUNT), random.uniform(1.0, 50.0, COUNT))
    metals = indices(10.0 ** uniform(-1.3, 1.0), uniform(0.2, 10.0, COUNT, 1)[:, 0])
    lobe = np.arctan(alpha * random.uniform(0.0, 2.5, COUNT))
    colors = single(np.exp(random.uniform(-8.0, 4.0, (COUNT, 3))))
    light = lights(meta, extreme=False)
    return {
        "models": (m, l, v),
        "distributions": (direction(np.cos(lobe), random.uniform(0.0, 6.0, COUNT)), alpha),
        "maskings": (l, v, halves(l, v), alpha),
        "fresnels": (m | metals, single(random.uniform(0.0, 1.0, COUNT))),
        "attenuations": (single(random.uniform(0.0, 50.0, COUNT)), light),
        "shadows": LIT_POINTS,
        "outlines": (PIXELS,),
        "quantisations": CODES,
        "biases": tuple(single(uniform(*ends, COUNT, k)[:, 0]) for k, ends in enumerate(BIASED, 1)),
        "ambients": (m,),
    }.get(folder, (colors,))


def extremes(folder: str, meta: Choice) -> Arguments:
    """Every combination of extreme arguments of the folder's contract."""
    l, v, alpha = pairs()
    exponents = single(np.resize([0.0, 1.0, 1e4, 1e6], len(l)))
    m = material(np.sqrt(alpha), exponents)
    every = np.array(list(itertools.product(*INDICES)))[np.arange(len(l)) % INDEX_COUNT]
    metals = indices(every[:, 0], every[:, 1])
    angles = np.array(list(itertools.product(np.geomspace(1e-4, math.pi / 2, 60), ALPHAS)))
    h = np.stack([np.sin(angles[:, 0]), 0.0 * angles[:, 0], np.cos(angles[:, 0])], axis=-1)
    colors = single(list(itertools.product(LIGHTS, repeat=3)))
    light = lights(meta, extreme=True)
    distances = single(np.resize(DISTANCES, max(len(column) for column in light.values())))
    return {
        "models": (m, l, v),
        "distributions": (single(h), single(angles[:, 1])),
        "maskings": (l, v, halves(l, v), alpha),
        "fresnels": (
            m | metals,
            single(np.repeat([0.0, 1e-7, 1e-3, 0.5, 1.0], len(l) // 5)),
        ),
        "attenuations": (distances if len(light) > 1 else single(DISTANCES), light),
        "shadows": LIT_POINTS,
        "outlines": (PIXELS,),
        "quantisations": CODE_ENDS,
        "biases": tuple(single(list(itertools.product(*BIASED_EXTREMES))).T),
        "ambients": (m,),
    }.get(folder, (colors,))


def read_fields(path: str, function: str, settings: Settings) -> set[str]:
    """The material fields that a file, assembled under the settings, reads."""
    menu = library()
    promised = menu.promised(path)
    objects = promised is not None and function != promised
    return material_fields(menu, source_of(menu, path, settings, objects=objects)[0])


def evaluate(
    path: str, function: str, arguments: Arguments, settings: Settings, **where: Any
) -> Array:
    """The shader's answer in float64, for the file as chosen by its own folder's setting."""
    folder = library().folders.get(path.split("/")[0])
    chosen = {folder.setting: path.split("/")[1].removesuffix(".glsl")} if folder else {}
    chosen |= settings
    given: list[Any] = []
    for argument in arguments:
        if isinstance(argument, dict) and "base_color" in argument:
            fields = read_fields(path, function, chosen)
            kept = {k: v for k, v in argument.items() if k in fields}
            given.append(kept)
        else:
            given.append(argument)
    return call(path, function, *given, settings=chosen, **where).astype(np.float64)
