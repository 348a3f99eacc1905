"""Rays through a mesh's table on the GPU, and through its triangles in float64."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from lightbench.assemble import Source
from lightbench.bvh import WIDTH
from lightbench.exact.directions import Array
from lightbench.front_matter import Choice, ShaderFile
from lightbench.glsl import source_of
from lightbench.glsl_run import SCREEN
from lightbench.mesh import Mesh
from lightbench.render import on_gl_thread, renderer, set_uniform
from tests.support import library

__all__ = ["FAR", "Rays", "distances", "flat", "traced"]

FAR = 1e30
# Half the distance from 1 to the next float32.
ROUNDING = 2.0**-24
COLUMNS = 1024
SAMPLERS = ("u_origin", "u_direction")
MAIN = """#include "lib/bvh.glsl"
uniform highp isampler2D u_table;
uniform highp sampler2D u_origin;
uniform highp sampler2D u_direction;
uniform int u_base;
out vec4 o_result;
void main() {
  ivec2 row = ivec2(gl_FragCoord.xy);
  vec4 origin = texelFetch(u_origin, row, 0), direction = texelFetch(u_direction, row, 0);
  int from = int(direction.w);
  BODY
}
"""
ASKED = "(u_table, u_base, origin.xyz, direction.xyz, from, SIDE, origin.w)"
HIT = f"MeshHit hit = meshHit{ASKED.replace('SIDE', '0.0')};"
RESULT = "o_result = vec4(hit.distance, float(hit.triangle), hit.weights);"
FACE = "MeshFace face = meshFace(u_table, u_base, hit.triangle);"
BODIES = {
    "hit": HIT + RESULT,
    "front": f"MeshHit hit = meshHit{ASKED.replace('SIDE', '1.0')}; {RESULT}",
    "back": f"MeshHit hit = meshHit{ASKED.replace('SIDE', '-1.0')}; {RESULT}",
    "plane": f"{HIT} {FACE} o_result = vec4(cross(face.edges[0], face.edges[1]), face.edges[0].x);",
    "leaves": "BoxRay ray = boxRay(u_table, u_base, origin.xyz, direction.xyz); int count = 0; "
    "while (ray.at < ray.end) { count += nextLeaf(u_table, ray, origin.w) < 0 ? 0 : 1; } "
    "o_result = vec4(count);",
    **{
        name: f"{HIT} {FACE} o_result = meshAttribute(u_table, face.vertices, hit.weights, {name});"
        for name in ("MESH_NORMAL", "MESH_UVS", "MESH_TANGENT", "MESH_COLOR")
    },
}


@dataclass(frozen=True)
class Rays:
    """Origins and directions (N, 3), float32; the triangle that each leaves and how far it goes."""

    origin: NDArray[np.float32]
    direction: NDArray[np.float32]
    leaves: Any = -1
    reach: Any = FAR

    def __len__(self) -> int:
        return len(self.origin)


def traced(table: NDArray[np.int32], rays: Rays, body: str = "hit", base: int = 0) -> Array:
    """(N, 4) float64: what a body of BODIES gives for each ray; `base` texels stand before."""
    return on_gl_thread(_traced, table, rays, body, base).astype(np.float64)


def assembled(body: str) -> Source:
    """The library's code with a main that does what a body of BODIES does."""
    menu, path = library(), "lib/traced.glsl"
    code = MAIN.replace("BODY", BODIES[body])
    main = ShaderFile(
        meta=Choice(), code=code, functions={"main": code[: code.index("main")].count("\n")}
    )
    return source_of(menu.model_copy(update={"files": {**menu.files, path: main}}), path, {})[0]


def _traced(table: NDArray[np.int32], rays: Rays, body: str, base: int) -> NDArray[np.float32]:
    owner = renderer()
    source = assembled(body)
    program = owner.program(
        {
            "vertex": SCREEN, "fragment": source.text, "vertex_lines": [],
            "fragment_lines": list(source.lines), "attributes": [],
        }
    )  # fmt: skip
    size = (COLUMNS, -(-len(rays) // COLUMNS))
    images = [
        _texture(owner.context, np.random.default_rng(0).integers(0, 99, (base, 4)), table),
        _rows(owner.context, rays.origin, rays.reach, size),
        _rows(owner.context, rays.direction, rays.leaves, size),
    ]
    with owner.context.scope(framebuffer := owner.context.simple_framebuffer(size, 4, dtype="f4")):
        for unit, (name, image) in enumerate(zip(("u_table", *SAMPLERS), images, strict=True)):
            image.use(unit)
            set_uniform(program, name, unit)
        set_uniform(program, "u_base", base)
        owner.context.clear_samplers()
        owner.context.enable_only(moderngl.NOTHING)
        owner.vertices(program, None).render(moderngl.TRIANGLES, vertices=3)
        raw = framebuffer.read(components=4, dtype="f4")
    for item in (*images, *framebuffer.color_attachments, framebuffer):
        item.release()
    return np.frombuffer(raw, np.float32).reshape(-1, 4)[: len(rays)].copy()


def _texture(
    context: moderngl.Context, before: NDArray[Any], table: NDArray[np.int32]
) -> moderngl.Texture:
    """The table behind other texels, in rows of WIDTH."""
    texels = np.concatenate([before.astype(np.int32), table])
    height = -(-len(texels) // WIDTH)
    filled = np.zeros((height * WIDTH, 4), np.int32)
    filled[: len(texels)] = texels
    texture = context.texture((WIDTH, height), 4, filled.tobytes(), dtype="i4")
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    return texture


def _rows(
    context: moderngl.Context, xyz: NDArray[np.float32], w: Any, size: tuple[int, int]
) -> moderngl.Texture:
    filled = np.zeros((size[0] * size[1], 4), np.float32)
    filled[: len(xyz), :3] = xyz
    filled[: len(xyz), 3] = w
    texture = context.texture(size, 4, filled.tobytes(), dtype="f4")
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    return texture


def flat(positions: Any, indices: Any) -> Mesh:
    """A mesh of which only the triangles count."""
    count = len(positions)
    up, along = (
        np.tile(np.array([0, 0, 1], np.float32), (count, 1)),
        np.ones((count, 4), np.float32),
    )
    return Mesh(
        np.asarray(positions, np.float32), up, np.zeros((count, 2), np.float32), along,
        np.asarray(indices, np.uint32).reshape(-1, 3),
    )  # fmt: skip


def distances(mesh: Mesh, rays: Rays, larger: float) -> Array:
    """(N,) distances to the nearest triangle in float64, by Moller and Trumbore; infinite for none.

    Every triangle is larger on all sides, and nearer, by as many roundings of a ray's way to it
    over the cosine there; for a negative number smaller and farther. What float32 gives lies
    between the two.
    """
    found = np.full(len(rays), np.inf)
    reach, leaves = np.broadcast_to(rays.reach, len(rays)), np.broadcast_to(rays.leaves, len(rays))
    corners = mesh.positions.astype(np.float64)[mesh.indices]
    origin, direction = rays.origin.astype(np.float64), rays.direction.astype(np.float64)
    for number, (a, b, c) in enumerate(corners):
        normal = np.cross(b - a, c - a)
        square = normal @ normal
        if square == 0.0:
            continue
        with np.errstate(divide="ignore", invalid="ignore"):
            facing = direction @ normal
            t = ((a - origin) @ normal) / facing
            from_a = origin + t[:, None] * direction - a
            v = np.cross(b - a, from_a) @ normal / square
            u = np.cross(from_a, c - a) @ normal / square
            away = np.abs(a - origin).max(axis=1) + np.abs(a).max()
            off = larger * ROUNDING * away * np.sqrt(square) / np.abs(facing)
            edge = np.linalg.norm([b - a, c - a, c - b], axis=1).max()
            border = off * np.linalg.norm(direction, axis=1) * edge / np.sqrt(square)
            inside = np.minimum(np.minimum(u, v), 1 - u - v) >= -border
            met = inside & (t > 0) & (t < reach) & (number != leaves)
            found = np.where(met & (t - off < found), t - off, found)
    return found
