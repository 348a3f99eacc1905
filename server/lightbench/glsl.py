"""Run one GLSL function of the shader folder on the GPU, a row of arguments at a time."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lightbench.assemble import Request, Source, assemble
from lightbench.batches import define_values, light_lists
from lightbench.contract import argument_types
from lightbench.errors import LightbenchError, NotFoundError
from lightbench.glsl_run import COMPONENTS, RETURNS, WHOLE, Prepared, run
from lightbench.half import HALF, halved
from lightbench.library import Library, read_library
from lightbench.paths import shaders_folder
from lightbench.render import on_gl_thread
from lightbench.scene import Scene
from lightbench.settings import Resolved, Setting, resolve
from lightbench.traced import UNTRACED, UNTRACED_LISTS

__all__ = ["call"]

Argument = ArrayLike | Mapping[str, ArrayLike]


def call(
    file: str,
    function: str,
    *arrays: Argument,
    settings: Mapping[str, Setting | NDArray[Any]] | None = None,
    shaders: Path | None = None,
    half: bool = False,
) -> NDArray[np.float32]:
    """Evaluate `function` of `file` (a path in the shader folder) for each row of the arrays.

    A float argument is a float32 array (N,), a vecK argument (N, K), an int or ivec2 argument whole
    floats, a struct argument a dict {field: array}; a lone row stands for all. `settings` picks the
    choices that the file includes and sets its parameters; a parameter given as an array (N,) has
    one value a row. With `half` every named number is rounded to half precision. Returns float32
    (N,) or (N, K); bool and int results come as floats.

    Raises NotFoundError for an unknown file or function, LightbenchError for arrays that do not
    fit, ShaderError where the source does not compile.
    """
    library = read_library(shaders or shaders_folder())
    prepared = prepare(library, file, function, arrays, settings or {}, half=half)
    result = on_gl_thread(run, prepared)
    return result[:, 0] if prepared.components == 1 else result[:, : prepared.components]


def prepare(
    library: Library,
    file: str,
    function: str,
    arrays: Sequence[Argument],
    given: Mapping[str, Setting | NDArray[Any]],
    *,
    half: bool = False,
) -> Prepared:
    """What `call` runs: the assembled source and the arguments, seen to fit the function."""
    if file not in library.files:
        raise NotFoundError(f"no shader file '{file}'; there is: {', '.join(library.files)}")
    by_row = {name: value for name, value in given.items() if isinstance(value, np.ndarray)}
    single = {name: value for name, value in given.items() if not isinstance(value, np.ndarray)}
    promised = library.promised(file)
    objects = promised is not None and function != promised
    source, resolved = source_of(library, file, single, objects=objects)
    source = _variables(replace(source, text=halved(source.text)) if half else source, by_row)
    returned, types = _signature(library, file, function)
    kinds = _kinds(source, types)
    columns = _columns(kinds, types, arrays, function)
    columns |= {f"u_{name}": _column(by_row[name], "float", name) for name in by_row}
    rows = {len(column) for column in columns.values()} - {1}
    if len(rows) > 1:
        raise LightbenchError(f"{function}: arrays of different lengths: {sorted(rows)}")
    count = rows.pop() if rows else 1
    return Prepared(
        source, resolved, function, returned, types, columns,
        {name: kind for name, kind in kinds.items() if kind in WHOLE},
        count, HALF if half else "",
    )  # fmt: skip


# The member of a struct that has none, in lib/material.glsl: GLSL has no empty struct.
NO_FIELD = "unused"


def source_of(
    library: Library, file: str, settings: Mapping[str, Setting], *, objects: bool = False
) -> tuple[Source, Resolved]:
    """A file assembled as its own folder's choice, and the settings that it was done under.

    `objects`: as in a pass that draws objects.
    """
    folder, name = Path(file).parent.as_posix(), Path(file).stem
    own = {library.folders[folder].setting: name} if folder in library.folders else {}
    resolved = resolve(library, Scene(materials={}, objects={}), {**own, **settings})
    values = dict(define_values(library, resolved))
    values |= {**UNTRACED, "draws_objects": float(objects)}
    lists = light_lists(()) | dict.fromkeys(UNTRACED_LISTS, ())
    request = Request(file, "FRAGMENT", resolved.choices, values, lists)
    return assemble(library, request), resolved


def material_fields(library: Library, source: Source) -> set[str]:
    """The fields of a Material that an assembled source reads."""
    return {field for file in source.files for field in library.files[file].meta.material}


def _variables(source: Source, names: Iterable[str]) -> Source:
    """The source with the uniforms of parameters made variables, for main to set row by row."""
    text = source.text
    for name in names:
        if source.uniforms.get(f"u_{name}") != "float":
            raise LightbenchError(f"{name}: no float parameter that this code reads")
        text = text.replace(f"uniform float u_{name};", f"float u_{name};", 1)
    return replace(source, text=text)


def _signature(library: Library, file: str, function: str) -> tuple[str, tuple[str, ...]]:
    code = library.files[file].code
    match = re.search(rf"^[ \t]*(\w+)\s+{re.escape(function)}\s*\(([^()]*)\)\s*\{{", code, re.M)
    if match is None:
        known = ", ".join(library.files[file].functions) or "none"
        raise NotFoundError(f"{file}: no function '{function}'; there is: {known}")
    if match[1] not in RETURNS or re.search(r"\b(in)?out\b", match[2]):
        raise LightbenchError(f"{file}: {function} returns {match[1]}, which cannot be read back")
    return match[1], argument_types(match[2])


def _struct(source: Source, name: str) -> dict[str, str]:
    match = re.search(rf"struct\s+{name}\s*\{{(.*?)\}}", source.text, re.S)
    if match is None:
        raise LightbenchError(f"an argument of type {name} cannot be given")
    fields = re.findall(r"(\w+)\s+(\w+)\s*;", match[1])
    return {field: kind for kind, field in fields if field != NO_FIELD}


def _kinds(source: Source, types: tuple[str, ...]) -> dict[str, str]:
    """The type of each argument `a0`, or of each field `a0.name` of one that is a struct."""
    kinds: dict[str, str] = {}
    for index, kind in enumerate(types):
        fields = {} if kind in COMPONENTS else _struct(source, kind)
        kinds |= {f"a{index}.{name}": of for name, of in fields.items()} or {f"a{index}": kind}
    return kinds


def _columns(
    kinds: Mapping[str, str], types: tuple[str, ...], arrays: Sequence[Argument], function: str
) -> dict[str, NDArray[np.float32]]:
    """One (rows, components) array for each scalar, vector or struct field."""
    if len(arrays) != len(types):
        raise LightbenchError(f"{function} takes {len(types)} arrays: {', '.join(types)}")
    columns = {}
    for index, (kind, given) in enumerate(zip(types, arrays, strict=True)):
        if kind in COMPONENTS:
            columns[f"a{index}"] = _column(given, kind, f"{function}: argument {index}")
            continue
        fields = [name.split(".")[1] for name in kinds if name.startswith(f"a{index}.")]
        if not isinstance(given, Mapping) or set(given) != set(fields):
            raise LightbenchError(f"{function}: argument {index} is a dict of: {', '.join(fields)}")
        for field in fields:
            name, where = f"a{index}.{field}", f"{function}: {kind}.{field}"
            columns[name] = _column(given[field], kinds[name], where)
    return columns


def _column(given: object, kind: str, where: str) -> NDArray[np.float32]:
    size = COMPONENTS[kind]
    array = np.asarray(given, dtype=np.float32)
    if size == 1 and array.ndim <= 1:
        return array.reshape(-1, 1)
    if size > 1 and array.ndim in (1, 2) and array.shape[-1] == size:
        return array.reshape(-1, size)
    wanted = "(N,)" if size == 1 else f"(N, {size})"
    raise LightbenchError(f"{where}: a {kind} is {wanted}, not {array.shape}")
