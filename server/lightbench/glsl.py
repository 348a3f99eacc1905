"""Run one GLSL function of the shader folder on the GPU, a row of arguments at a time."""

import re
from collections.abc import Mapping
from pathlib import Path

import moderngl
import numpy as np
from numpy.typing import ArrayLike, NDArray

from lightbench.assemble import Request, Source, assemble
from lightbench.errors import LightbenchError, NotFoundError
from lightbench.library import Library, argument_types, read_library
from lightbench.paths import shaders_folder
from lightbench.plan import define_values
from lightbench.render import on_gl_thread, renderer, set_uniform
from lightbench.scene import Scene
from lightbench.settings import Resolved, Setting, resolve

__all__ = ["call"]

WIDTH = 4096
COMPONENTS = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4}
RETURNS = COMPONENTS | {"bool": 1, "int": 1}
SWIZZLE = {1: ".r", 2: ".rg", 3: ".rgb", 4: ""}
PADDING = {1: ", 0.0, 0.0, 0.0", 2: ", 0.0, 0.0", 3: ", 0.0", 4: ""}

Argument = ArrayLike | Mapping[str, ArrayLike]


def call(
    file: str,
    function: str,
    *arrays: Argument,
    settings: Mapping[str, Setting] | None = None,
    shaders: Path | None = None,
) -> NDArray[np.float32]:
    """Evaluate `function` of `file` (a path in the shader folder) for each row of the arrays.

    A float argument is a float32 array (N,), a vecK argument (N, K), a struct argument a dict
    {field: array}; a lone row stands for all. `settings` picks the choices that the file includes
    and sets its parameters. Returns float32 (N,) or (N, K); bool and int results come as floats.

    Raises NotFoundError for an unknown file or function, LightbenchError for arrays that do not
    fit, ShaderError where the source does not compile.
    """
    library = read_library(shaders or shaders_folder())
    if file not in library.files:
        raise NotFoundError(f"no shader file '{file}'; there is: {', '.join(library.files)}")
    folder, name = Path(file).parent.as_posix(), Path(file).stem
    own = {library.folders[folder].setting: name} if folder in library.folders else {}
    resolved = resolve(library, Scene(materials={}, objects={}), {**own, **(settings or {})})
    values = dict(define_values(library, resolved))
    source = assemble(library, Request(file, "FRAGMENT", resolved.choices, values, EMPTY_LISTS))
    returned, types = _signature(library, file, function)
    columns = _columns(source, types, arrays, function)
    rows = {len(column) for column in columns.values()} - {1}
    if len(rows) > 1:
        raise LightbenchError(f"{function}: arrays of different lengths: {sorted(rows)}")
    count = rows.pop() if rows else 1
    text, lines = _program(source, returned, types, columns, function)
    result = on_gl_thread(_run, text, lines, columns, resolved, count)
    return result[:, 0] if RETURNS[returned] == 1 else result[:, : RETURNS[returned]]


# The member of a struct that has none, in lib/material.glsl: GLSL has no empty struct.
NO_FIELD = "unused"
EMPTY_LISTS = {"LIGHTS": (), "POSITIONAL_LIGHTS": (), "SPOT_LIGHTS": ()}


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


def _columns(
    source: Source, types: tuple[str, ...], arrays: tuple[Argument, ...], function: str
) -> dict[str, NDArray[np.float32]]:
    """One (rows, components) array for each scalar, vector or struct field."""
    if len(arrays) != len(types):
        raise LightbenchError(f"{function} takes {len(types)} arrays: {', '.join(types)}")
    columns = {}
    for index, (kind, given) in enumerate(zip(types, arrays, strict=True)):
        if kind in COMPONENTS:
            columns[f"a{index}"] = _column(given, kind, f"{function}: argument {index}")
            continue
        fields = _struct(source, kind)
        if not isinstance(given, Mapping) or set(given) != set(fields):
            raise LightbenchError(f"{function}: argument {index} is a dict of: {', '.join(fields)}")
        for field, field_type in fields.items():
            where = f"{function}: {kind}.{field}"
            columns[f"a{index}.{field}"] = _column(given[field], field_type, where)
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


def _sampler(column: str) -> str:
    return "u_call_" + column.replace(".", "_")


def _program(
    source: Source,
    returned: str,
    types: tuple[str, ...],
    columns: Mapping[str, NDArray[np.float32]],
    function: str,
) -> tuple[str, tuple[str, ...]]:
    """The source with a main that calls the function on the row of this pixel."""
    samplers = [f"uniform highp sampler2D {_sampler(c)};" for c in columns]
    locals_ = [f"  {kind} a{index};" for index, kind in enumerate(types)]
    fetches = [
        f"  {column} = texelFetch({_sampler(column)}, "
        f"{'row' if len(array) > 1 else 'ivec2(0)'}, 0){SWIZZLE[array.shape[1]]};"
        for column, array in columns.items()
    ]
    result = f"{function}({', '.join(f'a{i}' for i in range(len(types)))})"
    if returned in ("bool", "int"):
        result = f"float({result})"
    main = [
        *samplers, "out vec4 o_result;", "void main() {", "  ivec2 row = ivec2(gl_FragCoord.xy);",
        *locals_, *fetches, f"  o_result = vec4({result}{PADDING[RETURNS[returned]]});", "}", "",
    ]  # fmt: skip
    where = (*source.lines, *(f"call:{number}" for number in range(1, len(main) + 1)))
    return source.text + "\n".join(main), where


def _run(
    text: str,
    lines: tuple[str, ...],
    columns: Mapping[str, NDArray[np.float32]],
    resolved: Resolved,
    count: int,
) -> NDArray[np.float32]:
    owner = renderer()
    owner.make_room()
    context = owner.context
    program = owner.program({
        "vertex": SCREEN, "fragment": text, "vertex_lines": [], "fragment_lines": list(lines),
        "attributes": [],
    })  # fmt: skip
    _set_parameters(program, resolved, {_sampler(name) for name in columns})
    size = (min(count, WIDTH), -(-count // WIDTH))
    if max(size) > owner.limit:
        raise LightbenchError(f"{count} rows are beyond the {WIDTH * owner.limit} of one call")
    with context.scope(framebuffer := context.simple_framebuffer(size, 4, dtype="f4")):
        textures = []
        for unit, (name, column) in enumerate(columns.items()):
            textures.append(_texture(context, column, size))
            textures[-1].use(unit)
            set_uniform(program, _sampler(name), unit)
        context.enable_only(moderngl.NOTHING)
        owner.vertices(program, None).render(moderngl.TRIANGLES, vertices=3)
        raw = framebuffer.read(components=4, dtype="f4")
    for item in (*textures, *framebuffer.color_attachments, framebuffer):
        item.release()
    return np.frombuffer(raw, np.float32).reshape(-1, 4)[:count].copy()


def _set_parameters(program: moderngl.Program, resolved: Resolved, own: set[str]) -> None:
    for name in program:
        if name in own or not isinstance(program[name], moderngl.Uniform):
            continue
        value = resolved.values.get(name.removeprefix("u_"))
        if value is None:
            raise LightbenchError(
                f"uniform {name} has no value: make it an argument of the function, or declare it "
                f"in front matter as [parameters.{name.removeprefix('u_')}]"
            )
        set_uniform(program, name, list(value) if isinstance(value, tuple) else [value])


def _texture(
    context: moderngl.Context, column: NDArray[np.float32], size: tuple[int, int]
) -> moderngl.Texture:
    if len(column) == 1:
        size = (1, 1)
    data = np.zeros((size[0] * size[1], 4), np.float32)
    data[: len(column), : column.shape[1]] = column
    texture = context.texture(size, 4, data.tobytes(), dtype="f4")
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    return texture


SCREEN = """#version 300 es
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(corner * 4.0 - 1.0, 0.0, 1.0);
}
"""
