"""Flat parts of a scene: outlines in the plane of the picture, each in the frame of its parent."""

from collections.abc import Mapping
from typing import Annotated, Literal, Self

from pydantic import BaseModel, BeforeValidator, Field, model_validator

from lightbench.scene_types import WHOLE, Angle, Factors2, HdrColor, Name, Vec2, auto, field

__all__ = ["MOST_PARTS", "Part", "check_parents"]

# Each takes four of the 224 uniform vectors that WebGL2 promises to a fragment shader.
MOST_PARTS = 48


class Part(BaseModel):
    """An outline about (0, 0) under scale, then rotation in degrees, then position.

    A square has its corners at -1 and 1, a circle the radius 1, a line runs along x from -1 to 1.
    Position and rotation are in the frame of the parent, which its scale does not stretch; without
    a parent, in the picture, whose shorter side runs from -1 to 1. `width` of the line in pixels.
    """

    model_config = WHOLE

    shape: Literal["square", "circle", "line"]
    parent: Annotated[Name | None, BeforeValidator(auto)] = None
    position: Vec2 = (0, 0)
    rotation: Annotated[Angle, Field(json_schema_extra=field("deg", (-180, 180)))] = 0
    scale: Factors2 = (1, 1)
    color: HdrColor = (1, 1, 1)
    width: Annotated[
        float, Field(ge=1, le=64, allow_inf_nan=False, json_schema_extra=field("px", (1, 16)))
    ] = 2

    @model_validator(mode="after")
    def _shapely(self) -> Self:
        if any(s < 1e-6 for s in self.scale):
            raise ValueError("scale: each factor must be at least 1e-6")
        if self.shape == "circle" and self.scale[0] != self.scale[1]:
            raise ValueError("scale: a circle has one factor for both axes")
        return self


def check_parents(parts: Mapping[str, Part]) -> None:
    """Raises ValueError for a parent that is not there, or that hangs on its own child."""
    for name, part in parts.items():
        if part.parent is not None and part.parent not in parts:
            there = ", ".join(parts)
            raise ValueError(f"parts.{name}.parent: no part '{part.parent}'; there is: {there}")
    for name in parts:
        chain = [name]
        while (parent := parts[chain[-1]].parent) is not None:
            chain.append(parent)
            if parent in chain[:-1]:
                raise ValueError(f"parts.{name}.parent: goes in a circle: {' -> '.join(chain)}")
