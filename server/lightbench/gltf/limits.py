"""How large a model may be: settings of the reader, and what is left of them while it reads."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from lightbench.errors import ModelError

__all__ = ["Budget", "Limits"]

Count = Annotated[int, Field(ge=1, le=2**31 - 1)]

# Bytes that a vertex and a triangle of the file's own arrays may take, all attributes together.
VERTEX_BYTES, TRIANGLE_BYTES = 128, 12


class Limits(BaseModel):
    """The largest model that is read; whatever goes beyond is refused with the limit's name.

    `file_bytes` counts the file and what it refers to; `nodes` also bounds meshes and the objects
    that come of them; `image_side` and `image_pixels` (of all images together) are in texels.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    file_bytes: Count = 64 << 20
    vertices: Count = 2_000_000
    triangles: Count = 4_000_000
    nodes: Count = 10_000
    materials: Count = 1024
    lights: Count = 64
    textures: Count = 128
    image_side: Count = 8192
    image_pixels: Count = 1 << 27


class Budget:
    """What one reading has left of its limits; to spend more raises ModelError."""

    def __init__(self, limits: Limits) -> None:
        self.limits = limits
        self._spent: dict[str, int] = {}

    def spend(self, limit: str, amount: int, where: str) -> None:
        """Count `amount` of what the limit's name says, before it is made."""
        self._count(limit, amount, getattr(self.limits, limit), where, limit)

    def decode(self, size: int, where: str) -> None:
        """Count `size` bytes of decoded vertex data."""
        limits = self.limits
        allowed = limits.vertices * VERTEX_BYTES + limits.triangles * TRIANGLE_BYTES
        self._count("decoded", size, allowed, where, "bytes of vertex data")

    def _count(self, name: str, amount: int, allowed: int, where: str, what: str) -> None:
        total = self._spent.get(name, 0) + amount
        if total > allowed:
            raise ModelError(f"{where}: {total} {what.replace('_', ' ')}; allowed are {allowed}")
        self._spent[name] = total
