"""What surfaces are made of: materials, their maps, textures, and meshes from files."""

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from lightbench import materials as material_library
from lightbench.scene_types import (
    WHOLE,
    Angle,
    Channel,
    Color,
    Eta,
    Extinction,
    HdrColor,
    Key,
    Name,
    Uv,
    Vec3,
    auto,
    field,
    numbers,
)

__all__ = ["Map", "Material", "MeshAsset", "Texture"]

Slot = Literal["base_color", "roughness", "metalness", "normal", "emissive", "occlusion"]
Wrap = Literal["repeat", "clamp", "mirror"]


class Texture(BaseModel):
    """An image on surfaces: row 0 at v = 0. `image` is the key of a PNG in the asset store."""

    model_config = WHOLE

    image: Key
    encoding: Literal["srgb", "linear"] = "linear"
    wrap: tuple[Wrap, Wrap] = ("repeat", "repeat")
    filter: Literal["linear", "nearest"] = "linear"


class MeshAsset(BaseModel):
    """A mesh in the asset store, the box it fills and the optional attributes it has."""

    model_config = WHOLE

    mesh: Key
    low: Vec3
    high: Vec3
    colors: bool = False
    uv1: bool = False


class Map(BaseModel):
    """A texture over a surface, through u' = R (S u) + offset as in KHR_texture_transform."""

    model_config = WHOLE

    texture: Name
    channels: Literal["rgba", "r", "g", "b", "a"] = "rgba"
    uv: Literal[0, 1] = 0
    offset: Uv = (0, 0)
    rotation: Angle = 0
    scale: Uv = (1, 1)


class Material(BaseModel):
    """Physical parameters, and classic ones that follow from them unless given (null).

    What a map holds is multiplied with the value of its slot. Beside these fields a material may
    choose, for itself alone, what the menu marks as a material's own, such as its model. What is
    not given and `library` has comes from that: from then on it is the scene's own.
    """

    model_config = ConfigDict(extra="allow", frozen=True)
    __pydantic_extra__: dict[str, str] = Field(init=False)

    base_color: Color = (0.8, 0.8, 0.8)
    metalness: Channel = 0.0
    roughness: Channel = 0.5
    f0: Annotated[Color | None, BeforeValidator(auto)] = None
    ior: Annotated[
        Annotated[
            float, Field(ge=1, le=5, allow_inf_nan=False, json_schema_extra=field("", (1, 3)))
        ]
        | None,
        BeforeValidator(auto),
    ] = None
    eta: Annotated[
        Annotated[tuple[Eta, Eta, Eta], BeforeValidator(numbers)] | None, BeforeValidator(auto)
    ] = None
    k: Annotated[
        Annotated[tuple[Extinction, Extinction, Extinction], BeforeValidator(numbers)] | None,
        BeforeValidator(auto),
    ] = None
    kd: Annotated[Color | None, BeforeValidator(auto)] = None
    ks: Annotated[HdrColor | None, BeforeValidator(auto)] = None
    shininess: Annotated[
        Annotated[
            float,
            Field(ge=0, le=1e6, allow_inf_nan=False, json_schema_extra=field("", (1, 1e4), "log")),
        ]
        | None,
        BeforeValidator(auto),
    ] = None
    ambient: Color = (0, 0, 0)
    reflectance: Channel = 0.0
    transmittance: Channel = 0.0
    emissive: HdrColor = (0, 0, 0)
    opacity: Channel = 1.0
    alpha_mode: Literal["opaque", "mask", "blend"] = "opaque"
    alpha_cutoff: Channel = 0.5
    double_sided: bool = False
    unlit: bool = False
    normal_scale: Annotated[
        float, Field(ge=0, le=4, allow_inf_nan=False, json_schema_extra=field("", (0, 2)))
    ] = 1.0
    occlusion_strength: Channel = 1.0
    maps: dict[Slot, Map] = {}

    library: Annotated[
        Annotated[Name, AfterValidator(material_library.known)] | None, BeforeValidator(auto)
    ] = None

    @model_validator(mode="before")
    @classmethod
    def _over_library(cls, data: object) -> object:
        return material_library.completed(data) if isinstance(data, dict) else data

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if self.f0 is not None and self.ior is not None:
            raise ValueError("give f0 or ior, not both")
        if (self.eta is None) != (self.k is None):
            raise ValueError("give both eta and k, or neither")
        return self
