"""What is there: camera, objects, materials, lights. Metres; degrees in files; candela and lux."""

import math
from collections.abc import Mapping
from typing import Annotated, Literal, Self

from pydantic import (
    BaseModel,
    BeforeValidator,
    Field,
    ValidationError,
    model_validator,
)

from lightbench.errors import SceneError, shown
from lightbench.scene_lights import Light
from lightbench.scene_parts import MOST_PARTS, Part, check_parents
from lightbench.scene_surfaces import Material, MeshAsset, Texture
from lightbench.scene_types import (
    SHORTEST,
    WHOLE,
    Euler,
    Factors,
    HdrColor,
    Name,
    Vec3,
    auto,
    field,
)

__all__ = ["Camera", "Object", "Scene"]

# The size of a picture where neither its scene nor the one who asks for it gives another.
SIZE = (640, 480)
Side = Annotated[int, Field(ge=1, le=16384)]


class Camera(BaseModel):
    """A perspective camera whose `fov` is that of the picture's height or width, or an orthographic
    one of `height` metres. In a `mirrored` one, right is left: a left-handed world.

    `light` names a light that the picture is taken from instead, with all that it reaches in sight.
    """

    model_config = WHOLE

    eye: Vec3 = (0, 0, 5)
    target: Vec3 = (0, 0, 0)
    up: Vec3 = (0, 1, 0)
    fov: Annotated[
        float, Field(ge=1, le=170, allow_inf_nan=False, json_schema_extra=field("deg", (10, 120)))
    ] = 45
    fov_of: Literal["height", "width"] = "height"
    mirrored: bool = False
    projection: Literal["perspective", "orthographic"] = "perspective"
    height: Annotated[
        float,
        Field(
            ge=1e-6, le=1e6, allow_inf_nan=False, json_schema_extra=field("m", (0.1, 100), "log")
        ),
    ] = 5
    light: Annotated[Name | None, BeforeValidator(auto)] = None

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


class Object(BaseModel):
    """A shape under scale, then rotation (Euler x, y, z in degrees), then position."""

    model_config = WHOLE

    shape: Literal["plane", "cube", "sphere", "cone", "triangle", "mesh"]
    mesh: Annotated[Name | None, BeforeValidator(auto)] = None
    corners: Annotated[tuple[Vec3, Vec3, Vec3] | None, BeforeValidator(auto)] = None
    material: Name
    position: Vec3 = (0, 0, 0)
    rotation: Euler = (0, 0, 0)
    scale: Factors = (1, 1, 1)
    stacks: Annotated[int, Field(ge=1, le=256)] = 16
    sectors: Annotated[int, Field(ge=3, le=1024)] = 64

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if any(s < 1e-6 for s in self.scale):
            raise ValueError("scale: each factor must be at least 1e-6")
        if (self.shape == "mesh") != (self.mesh is not None):
            raise ValueError("mesh: name one with shape mesh, and with no other")
        if (self.shape == "triangle") != (self.corners is not None):
            raise ValueError("corners: give three with shape triangle, and with no other")
        return self


class Scene(BaseModel):
    """A whole scene. `settings` are its own defaults; a caller's settings stand above them.

    `size` is that of its picture in pixels, width and height, where nobody asks for another.

    `units = "classic"` marks intensities in which a light of 1 lights a white surface to 1:
    they are multiplied by pi once, here, and the scene is physical from then on.
    """

    model_config = WHOLE

    title: str = ""
    about: str = ""
    units: Literal["physical", "classic"] = "physical"
    camera: Camera = Camera()
    views: dict[Name, Camera] = {}
    background: HdrColor = (0, 0, 0)
    size: Annotated[tuple[Side, Side] | None, BeforeValidator(auto)] = None
    textures: dict[Name, Texture] = {}
    meshes: dict[Name, MeshAsset] = {}
    materials: dict[Name, Material]
    objects: dict[Name, Object]
    lights: dict[Name, Light] = {}
    parts: Annotated[dict[Name, Part], Field(max_length=MOST_PARTS)] = {}
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
    def _names_exist(self) -> Self:
        for name, thing in self.objects.items():
            _known(f"objects.{name}.material", "material", thing.material, self.materials)
            if thing.mesh is not None:
                _known(f"objects.{name}.mesh", "mesh", thing.mesh, self.meshes)
        for name, material in self.materials.items():
            for slot, used in material.maps.items():
                where = f"materials.{name}.maps.{slot}.texture"
                _known(where, "texture", used.texture, self.textures)
        for where, camera in {"camera": self.camera, **self.views}.items():
            if camera.light is not None:
                _known(f"{where}.light", "light", camera.light, self.lights)
        check_parents(self.parts)
        return self

    @classmethod
    def parse(cls, data: object, where: str = "scene") -> "Scene":
        """A scene from its JSON data. Raises SceneError with the path of the offending field."""
        try:
            return cls.model_validate(data)
        except ValidationError as error:
            raise SceneError(f"{where}: {_first_problem(error)}") from None

    def sized(self, width: int | None = None, height: int | None = None) -> tuple[int, int]:
        """(width, height) in pixels of its picture, where a side is not given."""
        own = self.size or SIZE
        return width or own[0], height or own[1]

    def data(self) -> dict[str, object]:
        """The scene as plain JSON data, every default filled in."""
        return self.model_dump(mode="json")


def _known(where: str, kind: str, name: str, there: Mapping[str, object]) -> None:
    if name not in there:
        raise ValueError(f"{where}: no {kind} '{name}'; there is: {', '.join(there)}")


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
