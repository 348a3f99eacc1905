"""What a plan is: plain data that crosses to the browser as JSON."""

from typing_extensions import TypedDict

__all__ = [
    "Batch", "Draw", "Plan", "PlannedArray", "PlannedPass", "PlannedTable", "PlannedTarget",
    "PlannedTexture", "Program", "Sampling", "Uniforms",
]  # fmt: skip

Uniforms = dict[str, list[float]]


class PlannedTarget(TypedDict):
    """A texture: `size` in pixels, `format` as in front matter, `depth` with a depth buffer."""

    size: list[int]
    format: str
    depth: bool


class Sampling(TypedDict):
    """How images are read.

    `wrap`: repeat, clamp or mirror along u and v. `anisotropy`: samples at most, where available.
    """

    encoding: str
    wrap: list[str]
    filter: str
    anisotropy: int


class PlannedTexture(Sampling):
    """An image on surfaces: its key in the asset store."""

    image: str


class PlannedArray(Sampling):
    """Images of one size as the layers of one texture."""

    images: list[str]


class PlannedTable(TypedDict):
    """Numbers that a shader reads by their place: four a texel, or those of meshes for rays."""

    texels: list[float]
    meshes: list[str]


class Program(TypedDict):
    """Both specialised sources of a pass, where their lines come from, the attributes they read."""

    vertex: str
    fragment: str
    vertex_lines: list[str]
    fragment_lines: list[str]
    attributes: list[str]


class Draw(TypedDict):
    """One mesh (null: the screen triangle), the uniforms that are its own.

    `textures`, `arrays` and `tables` by sampler.
    """

    mesh: str | None
    uniforms: Uniforms
    textures: dict[str, str]
    arrays: dict[str, str]
    tables: dict[str, str]


class Batch(TypedDict):
    """Draws of one program in one state, with the uniforms they share.

    `tile`: x, y and side of the part of the target that is drawn to (null: all). `cull`: back faces
    are not drawn. `blend`: null, or "over" and "add", which leave the depth buffer as it is.
    """

    program: int
    tile: list[int] | None
    cull: bool
    blend: str | None
    uniforms: Uniforms
    draws: list[Draw]


class PlannedPass(TypedDict):
    """One pass: the target it writes, its clear colour (null: none), samplers by target.

    A pass to `keep` need not run again as long as it stays the same.
    """

    name: str
    target: str
    clear: list[float] | None
    keep: bool
    samplers: dict[str, str]
    batches: list[Batch]


class Plan(TypedDict):
    """All that a renderer needs, and what the panel shows (`settings`, `files`).

    `signed`: the picture holds negative numbers by right, as a view of normals does.
    """

    size: list[int]
    targets: dict[str, PlannedTarget]
    textures: dict[str, PlannedTexture]
    arrays: dict[str, PlannedArray]
    tables: dict[str, PlannedTable]
    programs: list[Program]
    passes: list[PlannedPass]
    outputs: dict[str, str]
    signed: bool
    settings: list[str]
    files: list[str]
