"""Arguments for every shader function: random ones of its domain's interior, and its extremes."""
# ruff: noqa: E741  (l is the direction to the light)

import itertools
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.assemble import Request, assemble
from lightbench.exact.directions import Array, half_vector, unit
from lightbench.glsl import EMPTY_LISTS, call
from lightbench.library import Choice
from lightbench.plan import define_values
from lightbench.scene import Scene
from lightbench.settings import resolve
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
        "kd": single([[0.1, 0.2, 0.05]]), "ks": single([[0.3, 0.5, 2.0]]),
        "shininess": single(shininess),
    }  # fmt: skip


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


DISTANCES = (0.0, 1e-4, 1.0, 20.0, 1e5, 1e15)


def interior(folder: str, meta: Choice) -> Arguments:
    """Random arguments of the folder's contract, away from every edge."""
    random = np.random.default_rng(1)
    alpha = single(random.uniform(0.05, 1.0, COUNT))
    l, v = around(0.05, 2), around(0.05, 3)
    m = material(random.uniform(0.25, 1.0, COUNT), random.uniform(1.0, 50.0, COUNT))
    lobe = np.arctan(alpha * random.uniform(0.0, 2.5, COUNT))
    colors = single(np.exp(random.uniform(-8.0, 4.0, (COUNT, 3))))
    light = lights(meta, extreme=False)
    return {
        "models": (m, l, v),
        "distributions": (direction(np.cos(lobe), random.uniform(0.0, 6.0, COUNT)), alpha),
        "maskings": (l, v, halves(l, v), alpha),
        "fresnels": (m, single(random.uniform(0.0, 1.0, COUNT))),
        "attenuations": (single(random.uniform(0.0, 50.0, COUNT)), light),
        "shadows": (colors,),
        "ambients": (m,),
    }.get(folder, (colors,))


def extremes(folder: str, meta: Choice) -> Arguments:
    """Every combination of extreme arguments of the folder's contract."""
    l, v, alpha = pairs()
    exponents = single(np.resize([0.0, 1.0, 1e4, 1e6], len(l)))
    m = material(np.sqrt(alpha), exponents)
    angles = np.array(list(itertools.product(np.geomspace(1e-4, math.pi / 2, 60), ALPHAS)))
    h = np.stack([np.sin(angles[:, 0]), 0.0 * angles[:, 0], np.cos(angles[:, 0])], axis=-1)
    colors = single(list(itertools.product(LIGHTS, repeat=3)))
    light = lights(meta, extreme=True)
    distances = single(np.resize(DISTANCES, max(len(column) for column in light.values())))
    return {
        "models": (m, l, v),
        "distributions": (single(h), single(angles[:, 1])),
        "maskings": (l, v, halves(l, v), alpha),
        "fresnels": (m, single(np.resize([0.0, 1e-7, 0.5, 1.0], len(l)))),
        "attenuations": (distances if len(light) > 1 else single(DISTANCES), light),
        "shadows": (colors,),
        "ambients": (m,),
    }.get(folder, (colors,))


def read_fields(path: str, settings: Settings) -> set[str]:
    """The material fields that a file, assembled under the settings, reads."""
    menu = library()
    resolved = resolve(menu, Scene(materials={}, objects={}), settings)
    values = dict(define_values(menu, resolved))
    source = assemble(menu, Request(path, "FRAGMENT", resolved.choices, values, EMPTY_LISTS))
    return {field for file in source.files for field in menu.files[file].meta.material}


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
            fields = read_fields(path, chosen)
            kept = {k: v for k, v in argument.items() if k in fields}
            given.append(kept)
        else:
            given.append(argument)
    return call(path, function, *given, settings=chosen, **where).astype(np.float64)


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
RAYS = (np.tile(TOWARDS[0], (2, 1)), np.concatenate([TOWARDS[1], -TOWARDS[1]]), *TOWARDS[2:])
BASE = material([0.5], [1.0]) | {"metalness": single(np.linspace(0.0, 1.0, COUNT))}

# Arguments for the functions of lib/, by file and name.
LIB: dict[tuple[str, str], Callable[[], Arguments]] = {
    ("alpha", "alphaFromRoughness"): lambda: (single([0.0, 1e-3, 0.01, 0.3, 1.0]),),
    ("base", "blendWithBase"): lambda: (BASE, single(uniform(0.0, 2.0, COUNT, 3))),
    ("base", "overBase"): lambda: (
        BASE, single(uniform(0.0, 1.0, COUNT, 3)), single(uniform(0.0, 2.0, COUNT, 3))),
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
    ("smith", "smithCorrelated"): lambda: UNITS,
    ("smith", "smithSeparable"): lambda: UNITS,
    ("specular_power", "specularPower"): lambda: (
        single([*np.cos(ANGLES), 0, 0, -1, -1, 1]), single([*np.sin(ANGLES) ** 2, 1, 1, 0, 0, 0]),
        single([*EXPONENTS, 0, 1, 0, 1, 1e6])),
    ("sphere", "sphereHit"): lambda: RAYS,
    ("spot", "spot"): lambda: (
        single([*uniform(-1.0, 1.0), 0.5, 0.5, 0.4999, 1, 1, -1]),
        single([*uniform(0.0, 1.0, COUNT, 1)[:, 0], 0.5, 0.2, 0.5, 1, 0, -1]),
        single([*uniform(-1.0, 0.0, COUNT, 1)[:, 0], 0.5, 0.5, 0.5, 1, 0, -1])),
    ("tone", "hasTone"): lambda: (single([0.0, -1.0, 1.0, math.nan, math.inf, -math.inf, 1e38]),),
}  # fmt: skip
