"""The renderer: runs any plan on OpenGL through moderngl, and knows no lighting."""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, ParamSpec, TypeVar

import moderngl
import numpy as np
from numpy.typing import NDArray

from lightbench.assemble import explain
from lightbench.errors import GraphicsError, ShaderError
from lightbench.image import Image
from lightbench.plan import Batch, Plan, PlannedPass, PlannedTarget, Program
from lightbench.shapes import mesh

__all__ = ["Renderer", "on_gl_thread", "renderer"]

DTYPES = {"rgba32f": "f4", "rgba16f": "f2", "rgba8": "f1"}
ATTRIBUTES = {
    "a_position": ("positions", "3f4"),
    "a_normal": ("normals", "3f4"),
    "a_uv": ("uvs", "2f4"),
    "a_tangent": ("tangents", "4f4"),
}
MAX_PROGRAMS = 256
# Pixels of all framebuffers kept between plans: 2^24 with depth are a third of a gigabyte.
MAX_KEPT_PIXELS = 2**24
# What a framebuffer counts for at least: its attachments cost something at any size.
LEAST_PIXELS = 2**18

P = ParamSpec("P")
R = TypeVar("R")
_thread = ThreadPoolExecutor(max_workers=1, thread_name_prefix="gl")
_renderers: list["Renderer"] = []


def on_gl_thread(work: Callable[P, R], *args: P.args, **kwargs: P.kwargs) -> R:
    """Run `work` on the one thread that owns the GL context, and wait for its result."""
    return _thread.submit(work, *args, **kwargs).result()


def renderer() -> "Renderer":
    """The process's renderer, made on first use; call it on the GL thread."""
    if not _renderers:
        _renderers.append(Renderer())
    return _renderers[0]


def make_context() -> moderngl.Context:
    """A context without a window: EGL first, then what the system offers."""
    problems = []
    options: tuple[dict[str, Any], ...] = ({"backend": "egl"}, {})
    for option in options:
        try:
            return moderngl.create_standalone_context(**option)
        except Exception as error:  # noqa: BLE001 - moderngl raises bare Exception here
            problems.append(str(error))
    raise GraphicsError(f"no OpenGL context ({'; '.join(problems)}); run: lightbench doctor")


class Renderer:
    """Owns a GL context and what was made on it; every method runs on the GL thread."""

    def __init__(self) -> None:
        self.context = make_context()
        self.name = str(self.context.info["GL_RENDERER"])
        self.version = str(self.context.info["GL_VERSION"])
        self.limit = int(self.context.info["GL_MAX_TEXTURE_SIZE"])
        self._programs: dict[tuple[str, str], moderngl.Program] = {}
        self._vertices: dict[tuple[moderngl.Program, str | None], moderngl.VertexArray] = {}
        self._buffers: dict[tuple[str, str], moderngl.Buffer] = {}
        self._framebuffers: dict[tuple[str, int, int, str, bool], moderngl.Framebuffer] = {}

    def run(self, plan: Plan) -> Image:
        """The picture of a plan.

        Raises ShaderError naming file and line where a source does not compile, GraphicsError
        where a target is larger than the context allows.
        """
        self.make_room()
        programs = [self.program(program) for program in plan["programs"]]
        targets = {name: self.framebuffer(name, target) for name, target in plan["targets"].items()}
        self.context.finish()
        start = time.perf_counter()
        for planned in plan["passes"]:
            self.draw(planned, programs, targets)
        self.context.finish()
        milliseconds = (time.perf_counter() - start) * 1e3
        linear = read(targets[plan["outputs"]["linear"]], "f4")
        display = read(targets[plan["outputs"]["display"]], "f1")
        return Image(linear, display, milliseconds, self.name)

    def program(self, program: Program) -> moderngl.Program:
        """The compiled program of two sources, compiled once."""
        key = (program["vertex"], program["fragment"])
        if key not in self._programs:
            try:
                self._programs[key] = self.context.program(*key)
            except moderngl.Error as error:
                stage = "vertex" if "vertex_shader" in str(error) else "fragment"
                text, lines = program[stage], program[f"{stage}_lines"]  # type: ignore[literal-required]
                raise ShaderError(explain(str(error), text, lines)) from None
        return self._programs[key]

    def make_room(self) -> None:
        """Release what too many plans have left behind: all programs, the oldest framebuffers."""
        while sum(max(w * h, LEAST_PIXELS) for _, w, h, *_ in self._framebuffers) > MAX_KEPT_PIXELS:
            release(self._framebuffers.pop(next(iter(self._framebuffers))))
        if len(self._programs) > MAX_PROGRAMS:
            for array in self._vertices.values():
                array.release()
            for program in self._programs.values():
                program.release()
            self._vertices.clear()
            self._programs.clear()

    def framebuffer(self, name: str, target: PlannedTarget) -> moderngl.Framebuffer:
        """The framebuffer of a target, kept for the next plan of the same size."""
        width, height = target["size"]
        if max(width, height) > self.limit:
            raise GraphicsError(f"{name}: {width}x{height} is beyond this GL's {self.limit} pixels")
        key = (name, width, height, target["format"], target["depth"])
        if key not in self._framebuffers:
            texture = self.context.texture((width, height), 4, dtype=DTYPES[target["format"]])
            texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
            texture.repeat_x = texture.repeat_y = False
            depth = self.context.depth_renderbuffer((width, height)) if target["depth"] else None
            self._framebuffers[key] = self.context.framebuffer([texture], depth)
        self._framebuffers[key] = self._framebuffers.pop(key)
        return self._framebuffers[key]

    def draw(
        self,
        planned: PlannedPass,
        programs: list[moderngl.Program],
        targets: dict[str, moderngl.Framebuffer],
    ) -> None:
        """Run one pass."""
        target = targets[planned["target"]]
        target.use()
        if planned["clear"] is not None:
            red, green, blue, alpha = planned["clear"]
            target.clear(red, green, blue, alpha, depth=1.0)
        flags = moderngl.DEPTH_TEST | moderngl.CULL_FACE
        self.context.enable_only(flags if target.depth_attachment else moderngl.NOTHING)
        for unit, texture in enumerate(planned["samplers"].values()):
            attachment = targets[texture].color_attachments[0]
            assert isinstance(attachment, moderngl.Texture)
            attachment.use(unit)
        for batch in planned["batches"]:
            program = programs[batch["program"]]
            for unit, sampler in enumerate(planned["samplers"]):
                set_uniform(program, sampler, unit)
            self.draw_batch(batch, program)

    def draw_batch(self, batch: Batch, program: moderngl.Program) -> None:
        """Draw the meshes of one program."""
        for name, value in batch["uniforms"].items():
            set_uniform(program, name, value)
        for draw in batch["draws"]:
            for name, value in draw["uniforms"].items():
                set_uniform(program, name, value)
            vertices = self.vertices(program, draw["mesh"])
            vertices.render(moderngl.TRIANGLES, vertices=3 if draw["mesh"] is None else -1)

    def vertices(self, program: moderngl.Program, key: str | None) -> moderngl.VertexArray:
        """A mesh bound to the attributes that a program reads; None is the screen triangle."""
        if (program, key) not in self._vertices:
            if key is None:
                array = self.context.vertex_array(program, [])
            else:
                names = [name for name in ATTRIBUTES if name in program]
                content = [(self.buffer(key, n), ATTRIBUTES[n][1], n) for n in names]
                array = self.context.vertex_array(program, content, self.buffer(key, "indices"))
            self._vertices[program, key] = array
        return self._vertices[program, key]

    def buffer(self, key: str, attribute: str) -> moderngl.Buffer:
        """One attribute (or the indices) of a mesh."""
        if (key, attribute) not in self._buffers:
            field = ATTRIBUTES[attribute][0] if attribute in ATTRIBUTES else attribute
            data: NDArray[np.generic] = getattr(mesh(key), field)
            self._buffers[key, attribute] = self.context.buffer(
                np.ascontiguousarray(data).tobytes()
            )
        return self._buffers[key, attribute]


def set_uniform(program: moderngl.Program, name: str, value: list[float] | int) -> None:
    """Set a uniform where the compiler kept it."""
    uniform = program.get(name, None)
    if isinstance(uniform, moderngl.Uniform):
        single = isinstance(value, list) and len(value) == 1
        uniform.value = value[0] if single else value  # type: ignore[index]


def release(framebuffer: moderngl.Framebuffer) -> None:
    """Release a framebuffer with all that is attached."""
    for attachment in (*framebuffer.color_attachments, framebuffer.depth_attachment):
        if attachment is not None:
            attachment.release()
    framebuffer.release()


def read(framebuffer: moderngl.Framebuffer, dtype: str) -> NDArray:  # type: ignore[type-arg]
    """(H, W, 3) of the first attachment, row 0 at the top.

    Four components are read and one dropped: reading three is the slow way on software GL.
    """
    width, height = framebuffer.size
    kind = np.float32 if dtype == "f4" else np.uint8
    raw = framebuffer.read(components=4, dtype=dtype)
    return np.frombuffer(raw, kind).reshape(height, width, 4)[::-1, :, :3].copy()
