"""One GLSL function as a program of its own: a pixel a row of arguments."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial

import moderngl
import numpy as np
from numpy.typing import NDArray

from lightbench.assemble import Source
from lightbench.errors import LightbenchError
from lightbench.plan_types import Program
from lightbench.render import renderer, set_uniform
from lightbench.settings import Resolved

__all__ = [
    "COMPONENTS", "RETURNS", "Draw", "Prepared", "drawing", "one_call", "program", "run",
    "sampler",
]  # fmt: skip

# Draws once, with these values of the int uniforms.
Draw = Callable[[Mapping[str, int]], None]

WIDTH = 4096
FLOATS = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4}
# Arguments of these types come as floats and are made whole; nothing rounds them to half.
WHOLE = {"int": 1, "ivec2": 2}
COMPONENTS = FLOATS | WHOLE
RETURNS = FLOATS | {"bool": 1, "int": 1}
SWIZZLE = {1: ".r", 2: ".rg", 3: ".rgb", 4: ""}
PADDING = {1: ", 0.0, 0.0, 0.0", 2: ", 0.0, 0.0", 3: ", 0.0", 4: ""}


@dataclass(frozen=True)
class Prepared:
    """A call whose arguments fit. `columns` holds (rows, components) float32 for each scalar or
    vector argument `a0`, struct field `a0.name` and parameter `u_name`; one row stands for all.
    `whole` has the types of those that are not floats.
    `rounding` is what each goes through first, the name of a GLSL function or nothing.
    """

    source: Source
    resolved: Resolved
    function: str
    returned: str
    types: tuple[str, ...]
    columns: Mapping[str, NDArray[np.float32]]
    whole: Mapping[str, str]
    count: int
    rounding: str = ""

    @property
    def components(self) -> int:
        """Numbers that the function returns."""
        return RETURNS[self.returned]

    def result(self, arguments: Sequence[str]) -> str:
        """A vec4 expression of what the function returns for these arguments."""
        call = f"{self.function}({', '.join(arguments)})"
        value = f"float({call})" if self.returned in ("bool", "int") else call
        return f"vec4({value}{PADDING[self.components]})"


def run(prepared: Prepared) -> NDArray[np.float32]:
    """The results (count, 4); on the GL thread."""
    with drawing(prepared, one_call(prepared)) as ((draw,), framebuffer):
        draw({})
        raw = framebuffer.read(components=4, dtype="f4")
    return np.frombuffer(raw, np.float32).reshape(-1, 4)[: prepared.count].copy()


def one_call(prepared: Prepared) -> list[str]:
    """The body that calls the function once."""
    names = [f"a{index}" for index in range(len(prepared.types))]
    return [f"  o_result = {prepared.result(names)};"]


@contextmanager
def drawing(
    prepared: Prepared, *bodies: Sequence[str], uniforms: Sequence[str] = ()
) -> Iterator[tuple[list[Draw], moderngl.Framebuffer]]:
    """Everything set up to run each body once a row, and the framebuffer that they write to.

    A body is lines that set o_result from a0, a1 and so on. It may read the int `uniforms`, whose
    values each draw is given.
    """
    owner = renderer()
    owner.make_room()
    context, count = owner.context, prepared.count
    size = (min(count, WIDTH), -(-count // WIDTH))
    if max(size) > owner.limit:
        raise LightbenchError(f"{count} rows are beyond the {WIDTH * owner.limit} of one call")
    programs = [renderer().program(program(prepared, body, uniforms)) for body in bodies]
    samplers = [sampler(name) for name in prepared.columns]
    with context.scope(framebuffer := context.simple_framebuffer(size, 4, dtype="f4")):
        textures = [_texture(context, column, size) for column in prepared.columns.values()]
        for unit, (texture, name) in enumerate(zip(textures, samplers, strict=True)):
            texture.use(unit)
            for compiled in programs:
                set_uniform(compiled, name, unit)
        for compiled in programs:
            _set_parameters(compiled, prepared.resolved, {*samplers, *uniforms})
        context.enable_only(moderngl.NOTHING)
        # A picture that failed half-way may have left those of its images.
        context.clear_samplers()
        yield [partial(_draw, compiled) for compiled in programs], framebuffer
    for item in (*textures, *framebuffer.color_attachments, framebuffer):
        item.release()


def _draw(program: moderngl.Program, values: Mapping[str, int]) -> None:
    for name, value in values.items():
        set_uniform(program, name, value)
    renderer().vertices(program, None).render(moderngl.TRIANGLES, vertices=3)


def sampler(column: str) -> str:
    """The sampler that a column is read from."""
    return "u_call_" + column.replace(".", "_")


def program(prepared: Prepared, body: Sequence[str], uniforms: Sequence[str] = ()) -> Program:
    """The source with a main that has the row of this pixel in a0, a1 and so on, then the body."""
    fetches = [
        f"  {column} = {prepared.whole.get(column, prepared.rounding)}"
        f"(texelFetch({sampler(column)}, {'row' if len(array) > 1 else 'ivec2(0)'}, 0)"
        f"{SWIZZLE[array.shape[1]]});"
        for column, array in prepared.columns.items()
    ]
    main = [
        *(f"uniform highp sampler2D {sampler(column)};" for column in prepared.columns),
        *(f"uniform int {name};" for name in uniforms),
        "out vec4 o_result;", "void main() {", "  ivec2 row = ivec2(gl_FragCoord.xy);",
        *(f"  {kind} a{index};" for index, kind in enumerate(prepared.types)),
        *fetches, *body, "}", "",
    ]  # fmt: skip
    source = prepared.source
    return {
        "vertex": SCREEN, "fragment": source.text + "\n".join(main), "vertex_lines": [],
        "fragment_lines": [*source.lines, *(f"call:{n}" for n in range(1, len(main) + 1))],
        "attributes": [],
    }  # fmt: skip


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
