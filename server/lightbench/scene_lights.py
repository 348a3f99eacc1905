"""Lights: candela or lumen from a point, lux from a direction."""

from typing import Annotated, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from lightbench.scene_types import Color, Direction, Finite, HalfAngle, Intensity, Vec3, auto, field

__all__ = ["DirectionalLight", "Light", "PointLight", "SpotLight"]


class _Light(BaseModel):
    # A light also carries the parameters that the active choices keep per light (c0, light_radius);
    # their names are checked against the shader library, in settings.py.
    model_config = ConfigDict(extra="allow", frozen=True)
    __pydantic_extra__: dict[str, Finite] = Field(init=False)

    color: Color = (1, 1, 1)
    intensity: Intensity = 1.0
    casts: bool = True
    far: Annotated[
        Annotated[
            float,
            Field(
                ge=1e-6, le=1e6, allow_inf_nan=False, json_schema_extra=field("m", (1, 100), "log")
            ),
        ]
        | None,
        BeforeValidator(auto),
    ] = None


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
