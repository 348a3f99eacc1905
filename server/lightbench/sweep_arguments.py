"""From the inputs of a sweep to the arguments of the GLSL function: float32, a row a point."""
# ruff: noqa: E741  (l is the direction to the light)

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.exact.directions import Array, half_vector, unit
from lightbench.glsl import material_fields, source_of
from lightbench.library import Library
from lightbench.sweep import Sweep, contract_key

__all__ = ["Given", "arguments", "doubled"]

Single = NDArray[np.float32]
Values = Mapping[str, Array]
Argument = Single | dict[str, Single]
# A function's arguments, and the parameters that it reads.
Given = tuple[list[Argument], dict[str, Single]]

# Material fields that no sweep varies.
FIELDS = {
    "base_color": [0.9, 0.5, 0.1], "metalness": 0.3, "roughness": 0.5, "f0": [0.04, 0.5, 0.0],
    "eta": [0.2, 1.5, 2.9], "k": [3.9, 0.0, 3.1],
    "kd": [0.1, 0.2, 0.05], "ks": [0.3, 0.5, 2.0], "shininess": 50.0,
}  # fmt: skip
# The cosine of the outer cone that a spot is swept at, and one step of float32 there.
COS_OUTER, STEP = 0.5, 2.0**-24
# A ray that runs along no axis: the way out of the sphere's centre, and one across.
OUT, ACROSS = np.array([0.36, 0.48, 0.8]), np.array([0.8, -0.6, 0.0])


def arguments(library: Library, sweep: Sweep, file: str, values: Values) -> Given:
    """What `call` takes for `file`, which is the sweep's or its textbook form.

    `values` has the value of every input of the sweep, each (N,).
    """
    source, _ = source_of(library, file, {})
    fields = material_fields(library, source)
    build = BUILDERS[contract_key(sweep.file)]
    given = [
        {name: a[name] for name in a if "base_color" not in a or name in fields}
        if isinstance(a, dict)
        else a
        for a in build(values)
    ]
    read = [name for name in values if f"u_{name}" in source.uniforms]
    return given, {name: _single(values[name]) for name in read}


def doubled(given: Given) -> tuple[list[Any], dict[str, Array]]:
    """The same numbers in float64, for the exact form."""
    found = [
        {name: column.astype(np.float64) for name, column in a.items()}
        if isinstance(a, dict)
        else a.astype(np.float64)
        for a in given[0]
    ]
    return found, {name: column.astype(np.float64) for name, column in given[1].items()}


def _single(values: Any) -> Single:
    return np.asarray(values, np.float32)


def _direction(cosine: Array, sine: Array, azimuth: Array | float) -> Single:
    """Unit vectors; those of azimuth 0 and 180 degrees lie exactly in the plane y = 0."""
    turn = np.radians(azimuth)
    y = np.where(np.equal(azimuth, 180.0), 0.0, np.sin(turn))
    return _single(np.stack([sine * np.cos(turn), sine * y, cosine], axis=-1))


def _at_angle(degrees: Array, azimuth: float) -> Single:
    """A direction by its angle from the normal; exactly on the horizon for 90."""
    theta = np.radians(degrees)
    return _direction(np.where(degrees >= 90.0, 0.0, np.cos(theta)), np.sin(theta), azimuth)


def _at_cosine(cosine: Array, azimuth: Array | float) -> Single:
    return _direction(cosine, np.sqrt(1.0 - cosine**2), azimuth)


def _halves(l: Single, v: Single) -> Single:
    """Half vectors rounded once."""
    return _single(half_vector(l.astype(np.float64), v.astype(np.float64)))


def _color(values: Values) -> Single:
    """A level for red, less of it for green and blue as the tint grows to 1: pure red."""
    level, tint = values["level"], values["tint"]
    return _single(np.stack([level, level * (1.0 - 0.5 * tint), level * (1.0 - tint)], axis=-1))


def _material(values: Values, **own: Single) -> dict[str, Single]:
    swept = {name: values[name] for name in ("roughness", "shininess") if name in values}
    for name in {"f0", "eta", "k"} & values.keys():
        swept[name] = np.repeat(values[name][:, None], 3, axis=1)
    fixed = {name: _single([value]) for name, value in FIELDS.items()}
    return fixed | {name: _single(value) for name, value in swept.items()} | own


def _model(values: Values) -> list[Argument]:
    v = _at_angle(np.minimum(values["theta_l"] + values["delta"], 90.0), 0.0)
    return [_material(values), _at_angle(values["theta_l"], 180.0), v]


def _masking(values: Values) -> list[Argument]:
    l, v = _at_cosine(values["NoL"], 0.0), _at_cosine(values["NoV"], values["azimuth"])
    return [l, v, _halves(l, v), _single(values["alpha"])]


def _attenuation(values: Values) -> list[Argument]:
    own = {name: _single(value) for name, value in values.items() if name != "distance"}
    return [_single(values["distance"]), {"intensity": _single([[1.0, 1.0, 1.0]]), **own}]


def _spot(values: Values) -> list[Argument]:
    inner = _single(COS_OUTER + values["width"])
    # Where the cones meet, angles a step of float32 apart are still told apart.
    angle = COS_OUTER + values["across"] * (values["width"] + STEP)
    return [_single(angle), inner, _single([COS_OUTER])]


def _sphere(values: Values) -> list[Argument]:
    origin = _single(values["distance"][:, None] * OUT)
    target = values["offset"][:, None] * ACROSS
    direction = _single(unit(target - origin))
    return [origin, direction, _single([[0.0, 0.0, 0.0]]), _single([1.0])]


BUILDERS: dict[str, Callable[[Values], list[Argument]]] = {
    "models": _model,
    "distributions": lambda v: [_at_angle(v["theta_h"], 0.0), _single(v["alpha"])],
    "maskings": _masking,
    "fresnels": lambda v: [_material(v), _single(v["VoH"])],
    "attenuations": _attenuation,
    "biases": lambda v: [
        _single(v["distance"]),
        _single(0.0 * v["NoL"] + 10.0),
        _single(0.0 * v["NoL"] + 0.02),
        _single(v["NoL"]),
    ],
    "ambients": lambda v: [_material(v, base_color=_color(v), ambient=_color(v))],
    "tonemaps": lambda v: [_color(v)],
    "transfers": lambda v: [_color(v)],
    "views": lambda v: [_color(v)],
    "lib/sphere": _sphere,
    "lib/spot": _spot,
}
