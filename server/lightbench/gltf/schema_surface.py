"""Images, textures and materials of a glTF 2.0 document, as types."""

from typing import Annotated, Literal

from pydantic import Field

from lightbench.gltf.schema_types import Index, Named, Number, Part, Positive, Unit, Vector2

__all__ = ["Image", "Material", "Sampler", "Texture", "TextureInfo"]


class Image(Named):
    uri: str | None = None
    buffer_view: Index | None = None


class Sampler(Named):
    mag_filter: Literal[9728, 9729] = 9729
    wrap_s: Literal[10497, 33071, 33648] = 10497
    wrap_t: Literal[10497, 33071, 33648] = 10497


class _WebpSource(Part):
    source: Index


class _TextureExtensions(Part):
    webp: _WebpSource | None = Field(default=None, alias="EXT_texture_webp")


class Texture(Named):
    sampler: Index | None = None
    source: Index | None = None
    extensions: _TextureExtensions = _TextureExtensions()

    @property
    def image(self) -> int | None:
        """The index of its image, if it has one that can be read."""
        return self.extensions.webp.source if self.extensions.webp else self.source


class _Transform(Part):
    """KHR_texture_transform; `rotation` in radians."""

    offset: Vector2 = (0, 0)
    rotation: Number = 0.0
    scale: Vector2 = (1, 1)
    tex_coord: Annotated[int, Field(ge=0, le=1)] | None = None


class _InfoExtensions(Part):
    transform: _Transform | None = Field(default=None, alias="KHR_texture_transform")


class TextureInfo(Part):
    """A use of a texture; `scale` is of a normal map, `strength` of an occlusion map."""

    index: Index
    tex_coord: Annotated[int, Field(ge=0, le=1)] = 0
    scale: Number = 1.0
    strength: Unit = 1.0
    extensions: _InfoExtensions = _InfoExtensions()

    @property
    def transform(self) -> _Transform:
        """How texture coordinates are moved."""
        return self.extensions.transform or _Transform()

    @property
    def uv(self) -> int:
        """The set of texture coordinates, 0 or 1."""
        other = self.transform.tex_coord
        return self.tex_coord if other is None else other


class _Metallic(Part):
    base_color_factor: tuple[Unit, Unit, Unit, Unit] = (1, 1, 1, 1)
    base_color_texture: TextureInfo | None = None
    metallic_factor: Unit = 1.0
    roughness_factor: Unit = 1.0
    metallic_roughness_texture: TextureInfo | None = None


class _Strength(Part):
    emissive_strength: Annotated[Positive, Field(le=1e30)] = 1.0


class _Ior(Part):
    ior: Positive = 1.5


class _Unlit(Part):
    pass


class _MaterialExtensions(Part):
    strength: _Strength = Field(default=_Strength(), alias="KHR_materials_emissive_strength")
    ior: _Ior | None = Field(default=None, alias="KHR_materials_ior")
    unlit: _Unlit | None = Field(default=None, alias="KHR_materials_unlit")


class Material(Named):
    pbr_metallic_roughness: _Metallic = _Metallic()
    normal_texture: TextureInfo | None = None
    occlusion_texture: TextureInfo | None = None
    emissive_texture: TextureInfo | None = None
    emissive_factor: tuple[Unit, Unit, Unit] = (0, 0, 0)
    alpha_mode: Literal["OPAQUE", "MASK", "BLEND"] = "OPAQUE"
    alpha_cutoff: Positive = 0.5
    double_sided: bool = False
    extensions: _MaterialExtensions = _MaterialExtensions()
