"""The parts of a glTF 2.0 document that are read, as types: a wrong type is refused by its path.

Names, defaults and ranges are those of the specification (sections 3 and 5) and of the extensions.
What is not listed here is ignored.
"""

from typing import Annotated, Literal

from pydantic import Field

from lightbench.gltf.schema_surface import Image, Material, Sampler, Texture, TextureInfo
from lightbench.gltf.schema_types import (
    Index,
    Many,
    Matrix,
    Named,
    Number,
    Part,
    Positive,
    Size,
    Vector3,
)

__all__ = [
    "Accessor", "Buffer", "BufferView", "Camera", "Document", "Draco", "Image", "Light", "Material",
    "Mesh", "Meshopt", "Node", "Primitive", "Sampler", "Skin", "Sparse", "Texture", "TextureInfo",
]  # fmt: skip


class Buffer(Named):
    uri: str | None = None
    byte_length: Annotated[Size, Field(ge=1)]


class Meshopt(Part):
    """EXT_meshopt_compression, and KHR_meshopt_compression, which says the same."""

    buffer: Index
    byte_offset: Size = 0
    byte_length: Annotated[Size, Field(ge=1)]
    byte_stride: Annotated[int, Field(ge=2, le=256)]
    count: Annotated[Index, Field(ge=1)]
    mode: Literal["ATTRIBUTES", "TRIANGLES", "INDICES"]
    filter: Literal["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"] = "NONE"


class _ViewExtensions(Part):
    ext_meshopt: Meshopt | None = Field(default=None, alias="EXT_meshopt_compression")
    khr_meshopt: Meshopt | None = Field(default=None, alias="KHR_meshopt_compression")


class BufferView(Named):
    buffer: Index
    byte_offset: Size = 0
    byte_length: Annotated[Size, Field(ge=1)]
    byte_stride: Annotated[int, Field(ge=1, le=252)] | None = None
    extensions: _ViewExtensions = _ViewExtensions()

    @property
    def meshopt(self) -> Meshopt | None:
        """How the view is compressed, if it is."""
        return self.extensions.ext_meshopt or self.extensions.khr_meshopt


class _SparseIndices(Part):
    buffer_view: Index
    byte_offset: Size = 0
    component_type: Literal[5121, 5123, 5125]


class _SparseValues(Part):
    buffer_view: Index
    byte_offset: Size = 0


class Sparse(Part):
    count: Annotated[Index, Field(ge=1)]
    indices: _SparseIndices
    values: _SparseValues


class Accessor(Named):
    buffer_view: Index | None = None
    byte_offset: Size = 0
    component_type: Literal[5120, 5121, 5122, 5123, 5125, 5126]
    normalized: bool = False
    count: Annotated[Index, Field(ge=1)]
    type: Literal["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]
    sparse: Sparse | None = None


class Draco(Part):
    """KHR_draco_mesh_compression."""

    buffer_view: Index
    attributes: dict[str, Index]


class _PrimitiveExtensions(Part):
    draco: Draco | None = Field(default=None, alias="KHR_draco_mesh_compression")


class Primitive(Part):
    attributes: Annotated[dict[str, Index], Field(max_length=64)]
    indices: Index | None = None
    material: Index | None = None
    mode: Literal[0, 1, 2, 3, 4, 5, 6] = 4
    targets: Many[dict[str, Index]] = ()
    extensions: _PrimitiveExtensions = _PrimitiveExtensions()


class Mesh(Named):
    primitives: Annotated[Many[Primitive], Field(min_length=1)]


class _NodeLight(Part):
    light: Index


class _NodeExtensions(Part):
    punctual: _NodeLight | None = Field(default=None, alias="KHR_lights_punctual")


class Node(Named):
    children: Many[Index] = ()
    matrix: Matrix | None = None
    translation: Vector3 | None = None
    rotation: tuple[Number, Number, Number, Number] | None = None
    scale: Vector3 | None = None
    mesh: Index | None = None
    skin: Index | None = None
    camera: Index | None = None
    extensions: _NodeExtensions = _NodeExtensions()


class Skin(Named):
    inverse_bind_matrices: Index | None = None
    joints: Annotated[Many[Index], Field(min_length=1)]


class _Scene(Named):
    nodes: Many[Index] = ()


class _Perspective(Part):
    yfov: Annotated[float, Field(gt=0, lt=3.15)]


class _Orthographic(Part):
    ymag: Number


class Camera(Named):
    type: Literal["perspective", "orthographic"]
    perspective: _Perspective | None = None
    orthographic: _Orthographic | None = None


class _Spot(Part):
    inner_cone_angle: Annotated[float, Field(ge=0, le=1.5708)] = 0.0
    outer_cone_angle: Annotated[float, Field(gt=0, le=1.5708)] = 0.7853981633974483


class Light(Named):
    """KHR_lights_punctual. `range` is not read: light has none."""

    type: Literal["directional", "point", "spot"]
    color: tuple[Positive, Positive, Positive] = (1, 1, 1)
    intensity: Annotated[Positive, Field(le=1e30)] = 1.0
    spot: _Spot = _Spot()


class _Lights(Part):
    lights: Many[Light]


class _Asset(Part):
    version: str
    min_version: str | None = None
    copyright: str = ""


class _DocumentExtensions(Part):
    punctual: _Lights = Field(default=_Lights(lights=()), alias="KHR_lights_punctual")


class Document(Part):
    """A glTF document: the `asset` and lists that refer to each other by index."""

    asset: _Asset
    scene: Index | None = None
    scenes: Many[_Scene] = ()
    nodes: Many[Node] = ()
    meshes: Many[Mesh] = ()
    skins: Many[Skin] = ()
    cameras: Many[Camera] = ()
    materials: Many[Material] = ()
    textures: Many[Texture] = ()
    images: Many[Image] = ()
    samplers: Many[Sampler] = ()
    accessors: Many[Accessor] = ()
    buffer_views: Many[BufferView] = ()
    buffers: Many[Buffer] = ()
    animations: Many[object] = ()
    extensions_required: Many[str] = ()
    extensions: _DocumentExtensions = _DocumentExtensions()

    @property
    def lights(self) -> tuple[Light, ...]:
        """The punctual lights."""
        return self.extensions.punctual.lights
