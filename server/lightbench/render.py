"""The renderer: runs any plan on OpenGL through moderngl, and knows no lighting."""

import json
import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple, ParamSpec, TypeVar

import moderngl
import numpy as np
from numpy.typing import NDArray

from lightbench.errors import GraphicsError, ShaderError
from lightbench.image import Image
from lightbench.plan_types import (
    Batch,
    Plan,
    PlannedPass,
    PlannedTarget,
    Program,
)
from lightbench.shader_log import explain
from lightbench.shapes import mesh
from lightbench.tables import Tables
from lightbench.textures import Bound, Textures

__all__ = ["Renderer", "on_gl_thread", "renderer"]

# Components and moderngl's type of each format.
FORMATS = {"rgba32f": (4, "f4"), "rgba16f": (4, "f2"), "rgba8": (4, "f1"), "r32f": (1, "f4")}
ATTRIBUTES = {
    "a_position": ("positions", "3f4"),
    "a_normal": ("normals", "3f4"),
    "a_tangent": ("tangents", "4f4"),
    "a_uv0": ("uvs", "2f4"),
    "a_uv1": ("uvs1", "2f4"),
    "a_color": ("colors", "4f4"),
}
MAX_PROGRAMS = 256
# Bytes of all framebuffers kept between plans.
MAX_KEPT_BYTES = 2**29
# What a framebuffer counts for at least: its attachments cost something at any size.
LEAST_BYTES = 2**22
BLENDS = {
    "over": (moderngl.SRC_ALPHA, moderngl.ONE_MINUS_SRC_ALPHA),
    "add": (moderngl.ONE, moderngl.ONE),
}


class Key(NamedTuple):
    """What makes two targets one framebuffer."""

    name: str
    width: int
    height: int
    format: str
    depth: bool


def held(key: Key) -> int:
    """Bytes that a framebuffer takes."""
    components, dtype = FORMATS[key.format]
    pixel = components * int(dtype[1]) + 4 * key.depth
    return max(key.width * key.height * pixel, LEAST_BYTES)


# Textures, arrays and tables, by name.
Images = tuple[dict[str, Bound], dict[str, Bound], dict[str, moderngl.Texture]]
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
        self._framebuffers: dict[Key, moderngl.Framebuffer] = {}
        self._textures = Textures(self.context)
        self._tables = Tables(self.context)
        # What the kept passes have drawn: nothing else has drawn to these framebuffers since.
        self._drawn: dict[int, str] = {}
        # How often each pass has run, by its name.
        self.runs: Counter[str] = Counter()

    def run(self, plan: Plan) -> Image:
        """The picture of a plan. A pass to keep that is as it was is not run again.

        Raises ShaderError naming file and line where a source does not compile, GraphicsError
        where a target is larger than the context allows.
        """
        self.make_room()
        programs = [self.program(program) for program in plan["programs"]]
        targets = {name: self.framebuffer(name, target) for name, target in plan["targets"].items()}
        images = (*self._textures.load(plan), self._tables.load(plan["tables"]))
        self.context.finish()
        start = time.perf_counter()
        for planned in plan["passes"]:
            content = kept(planned, plan)
            key = id(targets[planned["target"]])
            if not content or self._drawn.pop(key, None) != content:
                self.draw(planned, programs, targets, images)
            self._drawn[key] = content
        self.context.finish()
        milliseconds = (time.perf_counter() - start) * 1e3
        linear = read(targets[plan["outputs"]["linear"]], "f4")
        display = read(targets[plan["outputs"]["display"]], "f1")
        return Image(linear, display, milliseconds, self.name, plan["signed"])

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
        while sum(map(held, self._framebuffers)) > MAX_KEPT_BYTES:
            oldest = self._framebuffers.pop(next(iter(self._framebuffers)))
            self._drawn.pop(id(oldest), None)
            release(oldest)
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
        key = Key(name, width, height, target["format"], target["depth"])
        if key not in self._framebuffers:
            components, dtype = FORMATS[target["format"]]
            texture = self.context.texture((width, height), components, dtype=dtype)
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
        images: Images,
    ) -> None:
        """Run one pass."""
        self.runs[planned["name"]] += 1
        target = targets[planned["target"]]
        target.use()
        target.viewport = (0, 0, *target.size)
        # A target is read as its texture says, without the sampler of an image before it.
        self.context.clear_samplers()
        target.depth_mask = True
        if planned["clear"] is not None:
            red, green, blue, alpha = planned["clear"]
            target.clear(red, green, blue, alpha, depth=1.0)
        for unit, texture in enumerate(planned["samplers"].values()):
            attachment = targets[texture].color_attachments[0]
            assert isinstance(attachment, moderngl.Texture)
            attachment.use(unit)
        for batch in planned["batches"]:
            program = programs[batch["program"]]
            for unit, sampler in enumerate(planned["samplers"]):
                set_uniform(program, sampler, unit)
            self.set_state(batch, target)
            self.draw_batch(batch, program, images, len(planned["samplers"]))
        target.depth_mask = True

    def set_state(self, batch: Batch, target: moderngl.Framebuffer) -> None:
        """Depth test, culling, blending and the part of the target of a batch."""
        flags = moderngl.DEPTH_TEST if target.depth_attachment else moderngl.NOTHING
        objects = any(draw["mesh"] is not None for draw in batch["draws"])
        if objects and batch["cull"]:
            flags |= moderngl.CULL_FACE
        if batch["blend"] is not None:
            flags |= moderngl.BLEND
            self.context.blend_func = BLENDS[batch["blend"]]
        self.context.enable_only(flags)
        target.depth_mask = batch["blend"] is None
        if batch["tile"] is not None:
            x, y, side = batch["tile"]
            target.viewport = (x, y, side, side)

    def draw_batch(
        self,
        batch: Batch,
        program: moderngl.Program,
        images: Images,
        first_unit: int,
    ) -> None:
        """Draw the meshes of one program; images take the units from `first_unit` on."""
        textures, arrays, tables = images
        for name, value in batch["uniforms"].items():
            set_uniform(program, name, value)
        for draw in batch["draws"]:
            for name, value in draw["uniforms"].items():
                set_uniform(program, name, value)
            # Tables first, on the same units for every draw: they go without the images' samplers.
            bound: dict[str, Bound | moderngl.Texture] = {
                **{sampler: tables[name] for sampler, name in draw["tables"].items()},
                **{sampler: textures[name] for sampler, name in draw["textures"].items()},
                **{sampler: arrays[name] for sampler, name in draw["arrays"].items()},
            }
            for unit, (sampler, image) in enumerate(bound.items(), first_unit):
                image.use(unit)
                set_uniform(program, sampler, unit)
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
            data: NDArray[np.generic] | None = getattr(mesh(key), field)
            if data is None:
                raise GraphicsError(f"the mesh {key} has no {field} for {attribute}")
            self._buffers[key, attribute] = self.context.buffer(
                np.ascontiguousarray(data).tobytes()
            )
        return self._buffers[key, attribute]


def kept(planned: PlannedPass, plan: Plan) -> str:
    """All that the picture of a pass to keep depends on; of another pass, nothing."""
    if not planned["keep"]:
        return ""
    batches = planned["batches"]
    programs = [plan["programs"][batch["program"]] for batch in batches]
    draws = [draw for batch in batches for draw in batch["draws"]]
    # A table that others read may change with every picture.
    textures = {name: plan["textures"][name] for d in draws for name in d["textures"].values()}
    arrays = {name: plan["arrays"][name] for d in draws for name in d["arrays"].values()}
    tables = {name: plan["tables"][name] for d in draws for name in d["tables"].values()}
    return json.dumps([planned, textures, arrays, tables, programs])


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
    attachment = framebuffer.color_attachments[0]
    count = attachment.components
    raw = framebuffer.read(components=count, dtype=dtype)
    pixels = np.frombuffer(raw, kind).reshape(height, width, count)[::-1]
    return np.repeat(pixels, 3, axis=2) if count == 1 else pixels[:, :, :3].copy()
