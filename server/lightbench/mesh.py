"""A triangle mesh and its packed form, which the browser reads."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["COLORS", "UVS1", "Mesh", "pack"]

# Flags in a packed mesh's header: which of the optional arrays follow.
COLORS, UVS1 = 1, 2


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles, counter-clockwise seen from outside. The arrays are read-only.

    `positions` (V, 3), `normals` (V, 3) unit, `uvs` (V, 2), `tangents` (V, 4: unit xyz and the
    bitangent's sign) and the optional `colors` (V, 4: linear RGB and alpha) and `uvs1` (V, 2, a
    second set) are float32; `indices` (T, 3) is uint32.

    Texture coordinates are glTF's: v grows down the image, whose first row is at v = 0. The
    bitangent w * cross(normal, tangent) points up the image.
    """

    positions: NDArray[np.float32]
    normals: NDArray[np.float32]
    uvs: NDArray[np.float32]
    tangents: NDArray[np.float32]
    indices: NDArray[np.uint32]
    colors: NDArray[np.float32] | None = None
    uvs1: NDArray[np.float32] | None = None

    def __post_init__(self) -> None:
        for array in (*self.floats(), self.indices):
            array.flags.writeable = False

    def floats(self) -> Iterator[NDArray[np.float32]]:
        """The vertex arrays that there are, in the order in which they are packed."""
        every = (self.positions, self.normals, self.uvs, self.tangents, self.colors, self.uvs1)
        yield from (array for array in every if array is not None)


def pack(mesh: Mesh) -> bytes:
    """The mesh as one block of little-endian bytes.

    Three uint32: vertices, indices, flags (1 colors, 2 uvs1); then positions, normals, uvs and
    tangents, colors and uvs1 where flagged, as float32; then the indices as uint32.
    """
    flags = COLORS * (mesh.colors is not None) + UVS1 * (mesh.uvs1 is not None)
    header = struct.pack("<III", len(mesh.positions), mesh.indices.size, flags)
    floats = (_bytes(array, "<f4") for array in mesh.floats())
    return b"".join([header, *floats, _bytes(mesh.indices, "<u4")])


def _bytes(array: NDArray[Any], kind: str) -> bytes:
    return array.astype(kind, copy=False).tobytes()
