"""The material library: measured and chosen values of common surfaces, read from materials.toml.

A material of a scene that names one, `"library": "gold"`, has its values wherever it gives none of
its own.
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from lightbench.errors import SceneError
from lightbench.paths import materials_file

__all__ = ["FIELDS", "LibraryMaterial", "completed", "known", "materials"]

Share = Annotated[float, Field(ge=0, le=1)]
Amount = Annotated[float, Field(ge=0, le=100)]
Index = Annotated[float, Field(ge=1e-2, le=100)]
# What a material has one of, at most.
ALTERNATIVES = (("f0", "ior"), ("ior", "f0"))


class LibraryMaterial(BaseModel):
    """One material: its name for people, where its numbers come from, and values of a scene's.

    Colours are linear Rec. 709; kd and ks reflectances; eta and k for red, green and blue. A value
    that is null follows from the others, as in a scene.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    title: str
    source: str
    base_color: tuple[Share, Share, Share]
    metalness: Share = 0.0
    roughness: Share
    f0: tuple[Share, Share, Share] | None = None
    ior: Annotated[float, Field(ge=1, le=5)] | None = None
    eta: tuple[Index, Index, Index] | None = None
    k: tuple[Amount, Amount, Amount] | None = None
    kd: tuple[Share, Share, Share] | None = None
    ks: tuple[Amount, Amount, Amount] | None = None
    shininess: Annotated[float, Field(ge=0, le=1e6)] | None = None

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if self.f0 is not None and self.ior is not None:
            raise ValueError("give f0 or ior, not both")
        if (self.eta is None) != (self.k is None):
            raise ValueError("give both eta and k, or neither")
        return self

    def values(self) -> dict[str, object]:
        """The fields of a scene's material that it sets."""
        return self.model_dump(mode="json", include=set(FIELDS), exclude_none=True)


# The fields of a scene's material that belong to its library material.
FIELDS = tuple(name for name in LibraryMaterial.model_fields if name not in ("title", "source"))


def materials() -> dict[str, LibraryMaterial]:
    """Every material by its name: those of the scene folder's materials.toml, or the built-in ones.

    Raises SceneError naming the file and the field for one that does not hold.
    """
    path = materials_file()
    try:
        return _read(path, path.stat().st_mtime_ns)
    except OSError as error:
        raise SceneError(f"{path}: cannot be read: {error.strerror}") from None


@cache
def _read(path: Path, _stamp: int) -> dict[str, LibraryMaterial]:
    try:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise SceneError(f"{path.name}: not a TOML file: {error}") from None
    return {name: _material(path, name, table) for name, table in tables.items()}


def _material(path: Path, name: str, table: object) -> LibraryMaterial:
    try:
        return LibraryMaterial.model_validate(table)
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join([name, *map(str, first["loc"])])
        what = first["msg"].removeprefix("Value error, ")
        raise SceneError(f"{path.name}: {where}: {what}") from None


def completed(given: Mapping[str, object]) -> Mapping[str, object]:
    """A scene's material with the values of its library material under its own.

    One that names none, or none that there is, comes back as it is.
    """
    name = given.get("library")
    found = materials().get(name) if isinstance(name, str) and name != "auto" else None
    if found is None:
        return given
    own = found.values()
    for one, other in ALTERNATIVES:
        if given.get(one) not in (None, "auto"):
            own.pop(other, None)
    return {**own, **given}


def known(name: str) -> str:
    """The name of a library material. Raises ValueError naming those there are."""
    if name not in materials():
        raise ValueError(f"no material '{name}'; there is: {', '.join(materials())}")
    return name
