"""What the front matter of a shader file says: of a choice, of a pass, of a folder of choices."""

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

__all__ = [
    "MATERIAL_FIELDS", "Choice", "Folder", "Parameter", "Pass", "ShaderFile", "Strict", "Target",
]  # fmt: skip

Range = tuple[float, float]
Kind = Literal["float", "int", "bool", "color"]
SurfacePart = Literal["normal", "emission", "occlusion", "opacity", "mirror"]
# The fields that `struct Material` may have, in its order. The scene's materials supply them.
MATERIAL_FIELDS = {
    "base_color": "vec3",
    "metalness": "float",
    "roughness": "float",
    "f0": "vec3",
    "eta": "vec3",
    "k": "vec3",
    "kd": "vec3",
    "ks": "vec3",
    "shininess": "float",
    "ambient": "vec3",
}


class Strict(BaseModel):
    """No unknown key, no conversion, no change."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Parameter(Strict):
    """A value that a file's front matter offers: a slider, an option, a uniform or a define."""

    kind: Kind = "float"
    default: float | int | bool | str | tuple[float, float, float]
    range: Range | None = None
    step: Annotated[float, Field(gt=0)] | None = None
    unit: str = ""
    label: str = ""
    scale: Literal["linear", "log"] = "linear"
    per: Literal["frame", "light"] = "frame"

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        number = isinstance(self.default, int | float) and not isinstance(self.default, bool)
        fits = {
            "float": number,
            "int": isinstance(self.default, int) and number,
            "bool": isinstance(self.default, bool),
            "color": isinstance(self.default, str | tuple),
        }
        if not fits[self.kind]:
            raise ValueError(f"default {self.default!r} is no {self.kind}")
        if self.kind in ("float", "int") and self.range is None:
            raise ValueError("a number needs its range = [lowest, highest]")
        if self.range and not self.range[0] <= float(str(self.default)) <= self.range[1]:
            raise ValueError(f"default {self.default} lies outside the range {list(self.range)}")
        if self.per == "light" and self.kind != "float":
            raise ValueError("a parameter per light is a float")
        return self


class Choice(Strict):
    """Front matter of a choice or of a lib file."""

    title: str = ""
    equation: str = ""
    source: str = ""
    domain: dict[str, Range] = {}
    unit: str = ""
    about: str = ""
    breaks: dict[str, str] = {}
    textbook_of: str = ""
    material: tuple[str, ...] = ()
    surface: tuple[SurfacePart, ...] = ()
    reads: tuple[str, ...] = ()
    signed: bool = False
    parameters: dict[str, Parameter] = {}

    @model_validator(mode="after")
    def _known_fields(self) -> Self:
        if unknown := set(self.material) - set(MATERIAL_FIELDS):
            known = ", ".join(MATERIAL_FIELDS)
            raise ValueError(f"material: no field '{min(unknown)}'; fields are: {known}")
        return self


class Target(Strict):
    """What a pass writes: a texture of the output's size times `scale` (an expression).

    For each light it is instead made of square tiles, one a face of the light's map, of `side`
    pixels (an expression). `clear` is its colour beforehand, or the scene's background.
    """

    format: Literal["rgba32f", "rgba16f", "rgba8", "r32f"]
    scale: str = "1"
    side: str = "1"
    depth: bool = False
    clear: Literal["background"] | tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)


class Pass(Choice):
    """Front matter of a render pass."""

    draw: Literal["screen", "objects"]
    each: Literal["frame", "light"] = "frame"
    writes: dict[str, Target]
    when: str = ""
    blend: Literal["none", "over", "add"] = "none"
    keep: bool = False

    @model_validator(mode="after")
    def _one_target(self) -> Self:
        if len(self.writes) != 1:
            raise ValueError("writes: a pass writes one target")
        return self


class ShaderFile(Strict):
    """One file of `shaders/`: `code` is free of comments and keeps the file's line numbers."""

    meta: Pass | Choice
    code: str
    functions: dict[str, int]


class Folder(Strict):
    """`_choice.toml`: what every file of a choice folder promises.

    Of one `per` material, a material may make its own choice.
    """

    setting: str
    title: str
    function: str
    optional: tuple[str, ...] = ()
    default: str
    about: str = ""
    per: Literal["frame", "material"] = "frame"
