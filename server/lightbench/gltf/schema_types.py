"""The kinds of numbers in a glTF document, and how its parts are validated."""

from typing import Annotated, TypeVar

from pydantic import BaseModel, ConfigDict, FailFast, Field
from pydantic.alias_generators import to_camel

__all__ = [
    "Index",
    "Many",
    "Matrix",
    "Named",
    "Number",
    "Part",
    "Positive",
    "Size",
    "Unit",
    "Vector2",
    "Vector3",
]

Index = Annotated[int, Field(ge=0, le=2**31 - 1)]
Size = Annotated[int, Field(ge=0, le=2**40)]
Number = Annotated[float, Field(allow_inf_nan=False, ge=-3.5e38, le=3.5e38)]
Unit = Annotated[float, Field(ge=0, le=1)]
Positive = Annotated[float, Field(ge=0, allow_inf_nan=False, le=3.5e38)]
Vector2 = tuple[Number, Number]
Vector3 = tuple[Number, Number, Number]
Matrix = Annotated[tuple[Number, ...], Field(min_length=16, max_length=16)]
# More of one thing than any limit lets pass, so that a flood of them ends early.
MANY = 1 << 16
T = TypeVar("T")
Many = Annotated[tuple[T, ...], Field(max_length=MANY), FailFast()]


class Part(BaseModel):
    """An object of the JSON text, by its own names; what is not listed is ignored."""

    model_config = ConfigDict(
        strict=True, extra="ignore", frozen=True, alias_generator=to_camel, protected_namespaces=()
    )


class Named(Part):
    """A part that a person may have named."""

    name: str = ""
