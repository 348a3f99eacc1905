"""The kinds of numbers a scene is made of: colours, vectors, angles; their limits and units."""

import math
from typing import Annotated

from pydantic import (
    AfterValidator,
    BeforeValidator,
    ConfigDict,
    Field,
    StringConstraints,
)

from lightbench.errors import shown

__all__ = [
    "SHORTEST", "WHOLE", "Angle", "Channel", "Color", "Direction", "Eta", "Euler",
    "Extinction", "Factors", "Factors2", "Finite",
    "HalfAngle", "HdrColor", "Intensity", "Key", "Length", "Name",
    "Uv", "Vec2", "Vec3", "auto", "color", "field", "numbers",
]  # fmt: skip


def color(value: object) -> object:
    """A linear RGB triple from one, or from an sRGB `#rrggbb` (also bare, or `r,g,b`)."""
    if not isinstance(value, str):
        return value
    text = value.strip().removeprefix("#")
    if len(text) == 6 and all(c in "0123456789abcdefABCDEF" for c in text):
        return [_decode_srgb(int(text[i : i + 2], 16) / 255) for i in (0, 2, 4)]
    return numbers(value, "write #rrggbb (sRGB) or r,g,b (linear)")


def _decode_srgb(code: float) -> float:
    """IEC 61966-2-1."""
    return code / 12.92 if code <= 0.04045 else math.pow((code + 0.055) / 1.055, 2.4)


def numbers(value: object, allowed: str = "write x,y,z") -> object:
    """Three numbers from `x,y,z`; anything else as it is."""
    if not isinstance(value, str):
        return value
    try:
        x, y, z = map(float, value.split(","))
    except ValueError:
        raise ValueError(f"{shown(value)} does not parse: {allowed}") from None
    return [x, y, z]


def _factors(value: object) -> object:
    """Scale factors along x, y and z; a lone number stands for all three."""
    return (value, value, value) if _is_lone(value) else numbers(value)


def _is_lone(value: object) -> bool:
    return isinstance(value, int | float) or (isinstance(value, str) and "," not in value)


def _pair(value: object, allowed: str = "write x,y") -> object:
    if not isinstance(value, str):
        return value
    try:
        x, y = map(float, value.split(","))
    except ValueError:
        raise ValueError(f"{shown(value)} does not parse: {allowed}") from None
    return [x, y]


def _factors2(value: object) -> object:
    """Scale factors along x and y; a lone number stands for both."""
    return (value, value) if _is_lone(value) else _pair(value)


def _uv(value: object) -> object:
    return _pair(value, "write u,v")


def auto(value: object) -> object:
    """`auto` in a link or on a command line is null in a file: the value follows from others."""
    return None if value == "auto" else value


def _not_zero(value: tuple[float, float, float]) -> tuple[float, float, float]:
    if math.hypot(*value) < SHORTEST:
        raise ValueError("a direction must not be zero")
    return value


# Of a part of a scene: no field but its own, and no change.
WHOLE = ConfigDict(extra="forbid", frozen=True)
# Shortest vector with a direction: far above where the square of its length would vanish.
SHORTEST = 1e-9
Finite = Annotated[float, Field(allow_inf_nan=False)]
Length = Annotated[float, Field(ge=-1e6, le=1e6, allow_inf_nan=False)]
Vec2 = Annotated[tuple[Length, Length], BeforeValidator(_pair)]
Vec3 = Annotated[tuple[Length, Length, Length], BeforeValidator(numbers)]
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
# Real and imaginary part of a complex index of refraction, for red, green and blue.
Eta = Annotated[float, Field(ge=1e-2, le=100, allow_inf_nan=False)]
Extinction = Annotated[float, Field(ge=0, le=100, allow_inf_nan=False)]
Name = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]*$")]
Key = Annotated[
    str, StringConstraints(pattern=r"^(mesh|image-[1-9]\d{0,4}x[1-9]\d{0,4})-[0-9a-f]{32}$")
]
Factors = Annotated[
    tuple[Length, Length, Length],
    BeforeValidator(_factors),
    Field(json_schema_extra={"kind": "factors"}),
]
Factors2 = Annotated[
    tuple[Length, Length],
    BeforeValidator(_factors2),
    Field(json_schema_extra={"kind": "factors"}),
]
Turn = Annotated[float, Field(ge=-1e4, le=1e4, allow_inf_nan=False)]
Uv = Annotated[tuple[Turn, Turn], BeforeValidator(_uv)]
Angle = Annotated[float, Field(ge=-360, le=360, allow_inf_nan=False)]
Euler = Annotated[tuple[Angle, Angle, Angle], BeforeValidator(numbers)]
HalfAngle = Annotated[
    float,
    Field(ge=0, le=180, allow_inf_nan=False, json_schema_extra={"unit": "deg", "slider": [0, 90]}),
]


def field(unit: str = "", slider: tuple[float, float] | None = None, scale: str = "linear") -> dict:  # type: ignore[type-arg]
    """What a slider needs to know of a field, beside its limits."""
    return {"unit": unit, "scale": scale} | ({"slider": list(slider)} if slider else {})


Intensity = Annotated[
    float, Field(ge=0, le=1e30, allow_inf_nan=False, json_schema_extra=field("", (0, 100)))
]
