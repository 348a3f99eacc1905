"""What the stability atlas looks at: two inputs of a function from end to end, the others fixed.

A sweep is plain data. The folders give it: the contract of a choice folder names the inputs, the
front matter of a file their ranges and the parameters that come with it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from lightbench.assemble import Source
from lightbench.batches import ById
from lightbench.contract import same_arguments
from lightbench.errors import LightbenchError, NotFoundError
from lightbench.exact.directions import Array
from lightbench.front_matter import MATERIAL_FIELDS, Choice, Parameter
from lightbench.glsl import material_fields, source_of
from lightbench.library import Library

__all__ = ["Input", "Sweep", "contract_key", "points", "sweep_of", "sweeps"]

Inputs = tuple["Input", ...]
# One of this many samples of an axis that has a 0 lies there, as a band of its own.
ZERO_SHARE = 14


@dataclass(frozen=True)
class Input:
    """A number that a sweep may vary: its range, and its value `at` which others leave it.

    With `zero` an axis begins with a band of exact zeros, which a logarithmic one never reaches.
    """

    name: str
    label: str
    low: float
    high: float
    at: float
    unit: str = ""
    log: bool = False
    zero: bool = False

    def samples(self, count: int) -> Array:
        """The values of an axis, (count,)."""
        band = max(count // ZERO_SHARE, 2) if self.zero else 0
        space = np.geomspace if self.log else np.linspace
        return np.concatenate([np.zeros(band), space(self.low, self.high, count - band)])


@dataclass(frozen=True)
class Sweep:
    """`function` of `file` and of its textbook form, over the inputs named `x` and `y`."""

    file: str
    function: str
    x: str
    y: str
    inputs: Inputs
    textbook: str = ""
    note: str = ""

    def axis(self, name: str) -> Input:
        """The input of that name."""
        return next(each for each in self.inputs if each.name == name)


@dataclass(frozen=True)
class Contract:
    """The inputs of a folder's functions and the pairs of them that are swept, the first always."""

    inputs: Inputs
    axes: tuple[tuple[str, str], ...]
    note: str = ""


ALPHA = Input("alpha", "α", 1e-4, 1.0, 0.3, log=True, zero=True)
LEVEL = Input("level", "level", 1e-6, 1e2, 0.18, log=True, zero=True)
TINT = Input("tint", "tint", 0.0, 1.0, 0.5)
CONTRACTS = {
    "models": Contract(
        (
            Input("roughness", "roughness", 1e-2, 1.0, 0.5, log=True, zero=True),
            Input("shininess", "shininess", 1.0, 1e6, 50.0, log=True, zero=True),
            Input("theta_l", "θ of l", 0.0, 90.0, 45.0, "°"),
            Input("delta", "v off mirrored l", 1e-3, 45.0, 5.0, "°", log=True, zero=True),
        ),
        (("roughness", "delta"), ("shininess", "delta"), ("theta_l", "delta")),
    ),
    "distributions": Contract(
        (ALPHA, Input("theta_h", "θ of h", 1e-3, 90.0, 5.0, "°", log=True, zero=True)),
        (("alpha", "theta_h"),),
    ),
    "maskings": Contract(
        (
            ALPHA,
            Input("NoV", "n·v", 1e-7, 1.0, 0.5, log=True, zero=True),
            Input("NoL", "n·l", 1e-7, 1.0, 0.7, log=True, zero=True),
            Input("azimuth", "azimuth of v", 0.0, 180.0, 60.0, "°"),
        ),
        (("alpha", "NoV"), ("NoL", "NoV")),
    ),
    "fresnels": Contract(
        (
            Input("f0", "f0", 1e-4, 1.0, 0.04, log=True, zero=True),
            Input("VoH", "v·h", 0.0, 1.0, 0.5),
            Input("eta", "η", 1e-2, 1e2, 1.5, log=True),
            Input("k", "k", 1e-3, 1e2, 3.0, log=True, zero=True),
        ),
        (("f0", "VoH"), ("eta", "VoH")),
    ),
    "attenuations": Contract(
        (Input("distance", "distance", 1e-6, 1e6, 1.0, "m", log=True, zero=True),), ()
    ),
    "biases": Contract(
        (
            Input("distance", "distance", 1e-3, 10.0, 5.0, "m", log=True),
            Input("NoL", "NoL", 0.0, 1.0, 0.5),
        ),
        (("distance", "NoL"),),
        "a map 10 m deep whose texels reach 2 cm",
    ),
    "ambients": Contract((replace(LEVEL, high=1.0), TINT), ()),
    "tonemaps": Contract((replace(LEVEL, low=1e-10, high=1e37), TINT), ()),
    "transfers": Contract((LEVEL, TINT), ()),
    "views": Contract((replace(LEVEL, low=1e-8, high=1e8), TINT), ()),
    # Functions of lib/ that stand beside a textbook form.
    "lib/sphere": Contract(
        (
            Input("distance", "distance", 1e-1, 1e6, 100.0, "radii", log=True),
            Input("offset", "offset of the ray", 0.0, 1.5, 0.5, "radii"),
        ),
        (("distance", "offset"),),
        "Negative, in cyan, is a hit that is missed.",
    ),
    "lib/spot": Contract(
        (
            Input("width", "inner - outer cosine", 1e-7, 0.5, 0.1, log=True, zero=True),
            Input("across", "outer 0 to inner 1", -0.5, 1.5, 0.5),
        ),
        (("width", "across"),),
    ),
}  # fmt: skip


def sweeps(library: Library) -> list[Sweep]:
    """Every function of the choice folders, and of lib/ those with a textbook form.

    A textbook form is no sweep of its own: it shares that of the form that it stands beside.
    """
    return [
        sweep_of(library, path, function, *axes)
        for path in library.files
        for function in _functions(library, path)
        for axes in _axes(library, path, function)
    ]


def sweep_of(library: Library, file: str, function: str, x: str = "", y: str = "") -> Sweep:
    """The sweep of one function, over its usual axes or those named.

    Raises NotFoundError for a function or an input that there is not.
    """
    if file in library.files and library.files[file].meta.textbook_of:
        file = _beside(file, library.files[file].meta.textbook_of)
    known = {path: names for path in library.files if (names := _functions(library, path))}
    if file not in known:
        raise NotFoundError(f"no map of a file '{file}'; there is: {', '.join(known)}")
    if function not in known[file]:
        raise NotFoundError(f"{file}: no '{function}'; there is: {', '.join(known[file])}")
    inputs = _inputs(library, file)
    x, y = (x, y) if x and y else next(iter(_axes(library, file, function)))
    names = [each.name for each in inputs]
    if unknown := [name for name in (x, y) if name not in names]:
        raise NotFoundError(f"{file}: no input '{unknown[0]}'; there is: {', '.join(names)}")
    if x == y:
        raise LightbenchError(f"{file}: two different inputs are swept, not '{x}' twice")
    textbooks = [
        path
        for path, other in library.files.items()
        if other.meta.textbook_of
        and _beside(path, other.meta.textbook_of) == file
        and function in other.functions
    ]
    note = CONTRACTS[contract_key(file)].note
    return Sweep(file, function, x, y, inputs, textbooks[0] if textbooks else "", note)


def _beside(path: str, name: str) -> str:
    return f"{path.rpartition('/')[0]}/{name}.glsl"


def contract_key(path: str) -> str:
    """The key of CONTRACTS for a file: itself, or its folder."""
    own = path.removesuffix(".glsl")
    return own if own in CONTRACTS else path.split("/")[0]


def _contract(path: str) -> Contract | None:
    return CONTRACTS.get(contract_key(path))


def _functions(library: Library, path: str) -> list[str]:
    """Functions of a file that are swept."""
    file, folder = library.files[path], library.folders.get(path.split("/")[0])
    if _contract(path) is None or file.meta.textbook_of or file.meta.reads:
        return []
    if folder is None:
        return list(file.functions) if contract_key(path) == path.removesuffix(".glsl") else []
    if len(_inputs(library, path)) < len(("x", "y")) or _asks_scene(library, path):
        return []  # of one input there is no map
    names = same_arguments(folder.function, folder.optional)
    return [name for name in names if name in file.functions]


def _asks_scene(library: Library, path: str) -> bool:
    """Whether a file has a uniform that only a scene gives."""
    given = {f"u_{name}" for file in library.files.values() for name in file.meta.parameters}
    return not set(_source(ById(library), path).uniforms) <= given


@lru_cache(maxsize=512)
def _source(library: ById, path: str) -> Source:
    return source_of(library.value, path, {})[0]


def _inputs(library: Library, path: str) -> Inputs:
    """The folder's inputs within the file's domain, and the file's own parameters."""
    contract, meta = _contract(path), library.files[path].meta
    given = contract.inputs if contract else ()
    fields = material_fields(library, _source(ById(library), path))
    floats = ((name, p) for name, p in meta.parameters.items() if p.kind == "float")
    own = [_of_parameter(name, p) for name, p in floats if p.range and p.range[0] < p.range[1]]
    read = [each for each in given if each.name in fields or each.name not in MATERIAL_FIELDS]
    # A function of one number is swept over another that it does not read.
    found = [*(read if len(read) + len(own) > 1 else given), *own]
    return tuple(_within(each, meta) for each in found)


def _of_parameter(name: str, parameter: Parameter) -> Input:
    low, high = parameter.range or (0.0, 1.0)
    log = high > 0.0 and (parameter.scale == "log" or (parameter.per == "light" and low == 0.0))
    return Input(
        name, name, high * 1e-9 if log and low <= 0.0 else low, high, float(str(parameter.default)),
        parameter.unit.replace("^2", "²"), log, zero=log and low <= 0.0,
    )  # fmt: skip


def _within(each: Input, meta: Choice) -> Input:
    """An input within the domain that the front matter states for it or for the argument."""
    name = each.name if each.name in meta.domain else {"level": "radiance"}.get(each.name, "")
    if name not in meta.domain:
        return each
    low, high = meta.domain[name]
    if not low < high or (each.log and high <= each.low):
        return each
    at = min(max(each.at, low), high)
    if each.log and low <= 0.0:
        return replace(each, high=high, at=at, zero=True)
    return replace(each, low=low, high=high, at=at, zero=False)


def _axes(library: Library, path: str, function: str) -> Iterator[tuple[str, str]]:
    """The pairs of inputs to sweep: the contract's, or the first input over the first parameter."""
    contract, parameters = _contract(path), library.files[path].meta.parameters
    names = [each.name for each in _inputs(library, path)]
    found = [pair for pair in (contract.axes if contract else ()) if set(pair) <= set(names)]
    own = [name for name in names if name in parameters]
    if not found:
        found = [(names[0], own[0] if own else names[1])]
    # Beside its own angle a visibility has the other direction's, where both go to the horizon.
    yield from found if function == "visibility" else found[:1]


def points(sweep: Sweep, size: int) -> dict[str, Array]:
    """The value of every input at every point of the grid, (size * size,), x running first."""
    values = {each.name: np.full(size * size, each.at) for each in sweep.inputs}
    values[sweep.x] = np.tile(sweep.axis(sweep.x).samples(size), size)
    values[sweep.y] = np.repeat(sweep.axis(sweep.y).samples(size), size)
    return values
