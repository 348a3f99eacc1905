"""What is there: camera, objects, materials, lights. Metres; degrees in files; candela and lux."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StringConstraints,
    ValidationError,
    model_validator,
)

from lightbench.errors import NotFoundError, SceneError, shown

__all__ = ["Camera", "Light", "Material", "Object", "Scene", "color", "read_scene", "scene_names"]


def color(value: object) -> object:
    """A linear RGB triple from one, or from an sRGB `#rrggbb` (also bare, or `r,g,b`)."""
    if not isinstance(value, str):
        return value
    text = value.strip().removeprefix("#")
    if len(text) == 6 and all(c in "0123456789abcdefABCDEF" for c in text):
        return [_decode_srgb(int(text[i : i + 2], 16) / 255) for i in (0, 2, 4)]
    return _numbers(value, "write #rrggbb (sRGB) or r,g,b (linear)")


def _decode_srgb(code: float) -> float:
    """IEC 61966-2-1."""
    return code / 12.92 if code <= 0.04045 else math.pow((code + 0.055) / 1.055, 2.4)


def _numbers(value: object, allowed: str = "write x,y,z") -> object:
    if not isinstance(value, str):
        return value
    try:
        x, y, z = map(float, value.split(","))
    except ValueError:
        raise ValueError(f"{shown(value)} does not parse: {allowed}") from None
    return [x, y, z]


def _factors(value: object) -> object:
    """Scale factors along x, y and z; a lone number stands for all three."""
    alone = isinstance(value, int | float) or (isinstance(value, str) and "," not in value)
    return (value, value, value) if alone else _numbers(value)


def _derived(value: object) -> object:
    """`auto` in a link or on a command line is null in a file: the value follows from others."""
    return None if value == "auto" else value


def _not_zero(value: tuple[float, float, float]) -> tuple[float, float, float]:
    if math.hypot(*value) < SHORTEST:
        raise ValueError("a direction must not be zero")
    return value


# Shortest vector with a direction: far above where the square of its length would vanish.
SHORTEST = 1e-9
Finite = Annotated[float, Field(allow_inf_nan=False)]
Length = Annotated[float, Field(ge=-1e6, le=1e6, allow_inf_nan=False)]
Vec3 = Annotated[tuple[Length, Length, Length], BeforeValidator(_numbers)]
Direction = Annotated[
    Vec3, AfterValidator(_not_zero), Field(json_schema_extra={"kind": "direction"})
]
Channel = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]
Color = Annotated[
    tuple[Channel, Channel, Channel],
    BeforeValidator(color),
    Field(json_schema_extra={"kind": "color"}),
]
Radiance = Annotated[float, Field(ge=0, le=1e30, allow_inf_nan=False)]
HdrColor = Annotated[
    tuple[Radiance, Radiance, Radiance],
    BeforeValidator(color),
    Field(json_schema_extra={"kind": "color"}),
]
Name = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]*$")]
Angle = Annotated[float, Field(ge=-360, le=360, allow_inf_nan=False)]
Euler = Annotated[tuple[Angle, Angle, Angle], BeforeValidator(_numbers)]
HalfAngle = Annotated[
    float,
    Field(ge=0, le=180, allow_inf_nan=False, json_schema_extra={"unit": "deg", "slider": [0, 90]}),
]


def _field(
    unit: str = "", slider: tuple[float, float] | None = None, scale: str = "linear"
) -> dict:  # type: ignore[type-arg]
    return {"unit": unit, "scale": scale} | ({"slider": list(slider)} if slider else {})


Intensity = Annotated[
    float, Field(ge=0, le=1e30, allow_inf_nan=False, json_schema_extra=_field("", (0, 100)))
]


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Camera(_Model):
    """A perspective camera; `fov` is vertical."""

    eye: Vec3 = (0, 0, 5)
    target: Vec3 = (0, 0, 0)
    up: Vec3 = (0, 1, 0)
    fov: Annotated[
        float,
        Field(ge=1, le=170, allow_inf_nan=False, json_schema_extra=_field("deg", (10, 120))),
    ] = 45

    @model_validator(mode="after")
    def _frame(self) -> Self:
        look = [t - e for t, e in zip(self.target, self.eye, strict=True)]
        u = self.up
        cross = (
            look[1] * u[2] - look[2] * u[1],
            look[2] * u[0] - look[0] * u[2],
            look[0] * u[1] - look[1] * u[0],
        )
        lengths = math.hypot(*look), math.hypot(*u)
        if min(lengths) < SHORTEST or math.hypot(*cross) <= 1e-9 * lengths[0] * lengths[1]:
            raise ValueError("eye, target and up must span a plane: target is the eye or along up")
        return self


class Material(_Model):
    """Physical parameters, and classic ones that follow from them unless given (null)."""

    base_color: Color = (0.8, 0.8, 0.8)
    metalness: Channel = 0.0
    roughness: Channel = 0.5
    f0: Annotated[Color | None, BeforeValidator(_derived)] = None
    ior: Annotated[
        Annotated[
            float, Field(ge=1, le=5, allow_inf_nan=False, json_schema_extra=_field("", (1, 3)))
        ]
        | None,
        BeforeValidator(_derived),
    ] = None
    kd: Annotated[Color | None, BeforeValidator(_derived)] = None
    ks: Annotated[HdrColor | None, BeforeValidator(_derived)] = None
    shininess: Annotated[
        Annotated[
            float,
            Field(ge=0, le=1e6, allow_inf_nan=False, json_schema_extra=_field("", (1, 1e4), "log")),
        ]
        | None,
        BeforeValidator(_derived),
    ] = None

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if self.f0 is not None and self.ior is not None:
            raise ValueError("give f0 or ior, not both")
        return self


class Object(_Model):
    """A shape under scale, then rotation (Euler x, y, z in degrees), then position."""

    shape: Literal["plane", "cube", "sphere", "cone"]
    material: Name
    position: Vec3 = (0, 0, 0)
    rotation: Euler = (0, 0, 0)
    scale: Annotated[
        tuple[Length, Length, Length],
        BeforeValidator(_factors),
        Field(json_schema_extra={"kind": "factors"}),
    ] = (1, 1, 1)
    stacks: Annotated[int, Field(ge=1, le=256)] = 16
    sectors: Annotated[int, Field(ge=3, le=1024)] = 64

    @model_validator(mode="after")
    def _not_flat(self) -> Self:
        if any(s < 1e-6 for s in self.scale):
            raise ValueError("scale: each factor must be at least 1e-6")
        return self


class _Light(BaseModel):
    # A light also carries the parameters that the active choices keep per light (c0, light_radius);
    # their names are checked against the shader library, in settings.py.
    model_config = ConfigDict(extra="allow", frozen=True)
    __pydantic_extra__: dict[str, Finite] = Field(init=False)

    color: Color = (1, 1, 1)
    intensity: Intensity = 1.0


class PointLight(_Light):
    """Isotropic; `intensity` in candela, or the whole flux in lumen."""

    type: Literal["point"]
    position: Vec3
    unit: Literal["candela", "lumen"] = "candela"


class DirectionalLight(_Light):
    """Parallel light along `direction`; `intensity` is the illuminance across it in lux."""

    type: Literal["directional"]
    direction: Direction = (0, -1, 0)


class SpotLight(_Light):
    """A point light inside a cone: full up to the half angle `inner`, none from `outer` on."""

    type: Literal["spot"]
    position: Vec3
    direction: Direction = (0, -1, 0)
    inner: HalfAngle = 30.0
    outer: HalfAngle = 35.0
    unit: Literal["candela", "lumen"] = "candela"

    @model_validator(mode="after")
    def _cone(self) -> Self:
        if self.inner > self.outer:
            raise ValueError(
                f"inner ({self.inner:g} deg) must not exceed outer ({self.outer:g} deg)"
            )
        return self


Light = Annotated[PointLight | DirectionalLight | SpotLight, Field(discriminator="type")]


class Scene(_Model):
    """A whole scene. `settings` are its own defaults; a caller's settings stand above them.

    `units = "classic"` marks intensities in which a light of 1 lights a white surface to 1:
    they are multiplied by pi once, here, and the scene is physical from then on.
    """

    title: str = ""
    about: str = ""
    units: Literal["physical", "classic"] = "physical"
    camera: Camera = Camera()
    background: HdrColor = (0, 0, 0)
    materials: dict[Name, Material]
    objects: dict[Name, Object]
    lights: dict[Name, Light] = {}
    settings: dict[str, float | int | bool | str] = {}

    @model_validator(mode="before")
    @classmethod
    def _physical(cls, data: object) -> object:
        if not isinstance(data, dict) or data.get("units") != "classic":
            return data
        given = data.get("lights", {})
        if not isinstance(given, dict):
            return data
        lights = {name: _times_pi(light) for name, light in given.items()}
        return {**data, "units": "physical", "lights": lights}

    @model_validator(mode="after")
    def _materials_exist(self) -> Self:
        for name, thing in self.objects.items():
            if thing.material not in self.materials:
                known = ", ".join(self.materials)
                raise ValueError(
                    f"objects.{name}.material: no material '{thing.material}'; there is: {known}"
                )
        return self

    @classmethod
    def parse(cls, data: object, where: str = "scene") -> "Scene":
        """A scene from its JSON data. Raises SceneError with the path of the offending field."""
        try:
            return cls.model_validate(data)
        except ValidationError as error:
            raise SceneError(f"{where}: {_first_problem(error)}") from None

    def data(self) -> dict[str, object]:
        """The scene as plain JSON data, every default filled in."""
        return self.model_dump(mode="json")


def _times_pi(light: object) -> object:
    """A light's data with its intensity times pi, where that is a number that validation takes."""
    if not isinstance(light, dict):
        return light
    intensity = light.get("intensity", 1.0)
    if not isinstance(intensity, int | float) or not intensity <= 1e30:
        return light
    return {**light, "intensity": intensity * math.pi}


def _first_problem(error: ValidationError) -> str:
    first = error.errors()[0]
    path = [str(key) for key in first["loc"] if "[" not in str(key)]
    if path[:1] == ["lights"]:
        del path[2:3]  # the light's type, which pydantic puts after its name
    message = first["msg"].removeprefix("Value error, ")
    if first["type"] == "extra_forbidden":
        message = "no such field"
    own = first["type"] == "value_error" or isinstance(first["input"], dict)
    given = "" if own else f" (given {shown(first['input'])})"
    return f"{'.'.join(path)}: {message}{given}" if path else message


def scene_names(root: Path) -> list[str]:
    """Names of the presets in a folder of scenes, `lab/shadows` for one in a sub-folder."""
    return sorted(p.relative_to(root).with_suffix("").as_posix() for p in root.rglob("*.json"))


def read_scene(name: str, root: Path) -> Scene:
    """A preset by name, or a scene file by path.

    Raises NotFoundError naming the presets, SceneError naming the offending field.
    """
    names = scene_names(root)
    path = root / f"{name}.json" if name in names else Path(name)
    if name not in names and (path.suffix != ".json" or not path.is_file()):
        raise NotFoundError(f"no scene '{name}'; there is: {', '.join(names)}, or a .json file")
    try:
        data: Mapping[str, object] = json.loads(path.read_text())
    except (OSError, ValueError, RecursionError) as error:
        raise SceneError(f"{name}: not a JSON file: {error}") from None
    return Scene.parse(data, name)
