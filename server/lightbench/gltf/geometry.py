"""The arrays of a glTF primitive: read, indexed as triangles, without what draws nothing."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import ModelError
from lightbench.gltf import draco
from lightbench.gltf.accessors import WIDTHS, Accessors, as_floats
from lightbench.gltf.buffers import Buffers
from lightbench.gltf.limits import Budget
from lightbench.gltf.schema import Document, Primitive

__all__ = ["Geometry", "GeometryReader"]

Floats32 = NDArray[np.float32]
Ints = NDArray[np.int64]

TRIANGLES, STRIP, FAN = 4, 5, 6
# The attributes that are read, with the types they may have.
ATTRIBUTES = {
    "POSITION": ("VEC3",), "NORMAL": ("VEC3",), "TANGENT": ("VEC4",), "TEXCOORD_0": ("VEC2",),
    "TEXCOORD_1": ("VEC2",), "COLOR_0": ("VEC3", "VEC4"), "JOINTS_0": ("VEC4",),
    "WEIGHTS_0": ("VEC4",),
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Geometry:
    """Vertex arrays (V, k) by attribute name, in float32, and triangles (T, 3) of all of them.

    No triangle has two corners at one position, and every vertex is used. `source` is the path of
    the primitive, for messages.
    """

    arrays: dict[str, Floats32]
    triangles: Ints
    source: str


class GeometryReader:
    """Geometry by primitive. Primitives of equal arrays get one and the same."""

    def __init__(
        self, document: Document, buffers: Buffers, accessors: Accessors, budget: Budget
    ) -> None:
        self._document = document
        self._buffers = buffers
        self._accessors = accessors
        self._budget = budget
        self._known: dict[tuple[object, ...], Geometry | None] = {}

    def read(self, primitive: Primitive, where: str) -> Geometry | None:
        """The geometry of a primitive of triangles; None if nothing of it can be seen.

        Raises ModelError.
        """
        packed = primitive.extensions.draco
        key = (
            tuple(sorted(primitive.attributes.items())),
            primitive.indices,
            primitive.mode,
            packed and (packed.buffer_view, tuple(sorted(packed.attributes.items()))),
        )
        if key not in self._known:
            self._known[key] = self._read(primitive, where)
        return self._known[key]

    def _read(self, primitive: Primitive, where: str) -> Geometry | None:
        if "POSITION" not in primitive.attributes:
            raise ModelError(f"{where}.attributes: POSITION is missing")
        wanted = {k: i for k, i in primitive.attributes.items() if k in ATTRIBUTES}
        arrays, triangles = (
            self._compressed(primitive, wanted, where)
            if primitive.extensions.draco
            else self._plain(primitive, wanted, where)
        )
        _check_lengths(arrays, where)
        _check_indices(triangles, len(arrays["POSITION"]), where)
        triangles = triangles[_visible(arrays["POSITION"], triangles)]
        if not len(triangles):
            return None
        used, compact = np.unique(triangles, return_inverse=True)
        gathered = {name: array[used] for name, array in arrays.items()}
        return Geometry(gathered, compact.reshape(-1, 3).astype(np.int64), where)

    def _plain(
        self, primitive: Primitive, wanted: dict[str, int], where: str
    ) -> tuple[dict[str, Floats32], Ints]:
        arrays = {name: self._array(name, index, where) for name, index in wanted.items()}
        if primitive.indices is None:
            indices = np.arange(len(arrays["POSITION"]))
        else:
            indices = self._accessors.indices(primitive.indices, f"{where}.indices")
        self._budget.decode(24 * len(indices), where)
        return arrays, _as_triangles(indices, primitive.mode)

    def _array(self, name: str, index: int, where: str) -> Floats32:
        return self._accessors.floats(index, ATTRIBUTES[name], f"{where}.attributes.{name}")

    def _compressed(
        self, primitive: Primitive, wanted: dict[str, int], where: str
    ) -> tuple[dict[str, Floats32], Ints]:
        packed, accessors = primitive.extensions.draco, self._document.accessors
        assert packed is not None
        if primitive.indices is None or primitive.mode not in (TRIANGLES, STRIP):
            raise ModelError(f"{where}: compressed by Draco, it must be triangles with indices")
        points, indices = accessors[wanted["POSITION"]].count, accessors[primitive.indices].count
        self._budget.decode(sum(accessors[index].count * 16 for index in wanted.values()), where)
        self._budget.decode(4 * indices, where)
        faces = indices // 3 if primitive.mode == TRIANGLES else indices
        limits = self._budget.limits
        triangles, decoded = draco.decode(
            bytes(self._buffers.view(packed.buffer_view)),
            {packed.attributes[name] for name in wanted if name in packed.attributes},
            min(points, limits.vertices),
            min(faces, limits.triangles),
            f"{where}.extensions.KHR_draco_mesh_compression",
        )
        arrays = {}
        for name, index in wanted.items():
            if name not in packed.attributes:
                arrays[name] = self._array(name, index, where)
            elif packed.attributes[name] not in decoded:
                raise ModelError(f"{where}: Draco holds no attribute {packed.attributes[name]}")
            else:
                arrays[name] = self._decoded(name, index, decoded[packed.attributes[name]], where)
        return arrays, triangles

    def _decoded(self, name: str, index: int, raw: NDArray[Any], where: str) -> Floats32:
        """What Draco decoded, as the attribute's accessor says to take it."""
        accessor, place = self._document.accessors[index], f"{where}.attributes.{name}"
        width = WIDTHS[accessor.type]
        if accessor.type not in ATTRIBUTES[name] or raw.shape[1] != width:
            raise ModelError(f"{place}: Draco holds {raw.shape[1]} components; allowed is {width}")
        if raw.dtype.kind != "f":
            raw = raw.astype(_integer(accessor.component_type))
        values = as_floats(raw, normalized=accessor.normalized)
        if not np.isfinite(values).all():
            raise ModelError(f"{place}: has an element that is not finite")
        return values


def _integer(component_type: int) -> str:
    return {5120: "i1", 5121: "u1", 5122: "i2", 5123: "u2"}.get(component_type, "u4")


def _as_triangles(indices: Ints, mode: int) -> Ints:
    """Triangles (T, 3) of a list, a strip or a fan (specification, section 3.7.2.1)."""
    if mode == TRIANGLES:
        return indices[: len(indices) // 3 * 3].reshape(-1, 3)
    if len(indices) < 3:
        return np.empty((0, 3), np.int64)
    i = np.arange(len(indices) - 2)
    if mode == FAN:
        return np.stack([indices[i + 1], indices[i + 2], np.full(len(i), indices[0])], axis=1)
    odd = i % 2
    return np.stack([indices[i], indices[i + 1 + odd], indices[i + 2 - odd]], axis=1)


def _check_lengths(arrays: dict[str, Floats32], where: str) -> None:
    expected = len(arrays["POSITION"])
    for name, array in arrays.items():
        if len(array) != expected:
            raise ModelError(
                f"{where}.attributes.{name}: {len(array)} elements for {expected} positions"
            )


def _check_indices(triangles: Ints, count: int, where: str) -> None:
    if triangles.size and triangles.max() >= count:
        raise ModelError(
            f"{where}.indices: vertex {triangles.max()} is out of range; there are {count}"
        )


def _visible(positions: Floats32, triangles: Ints) -> NDArray[np.bool_]:
    """Which triangles have three different corners."""
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    apart: NDArray[np.bool_] = (a != b).any(axis=1) & (b != c).any(axis=1) & (c != a).any(axis=1)
    return apart
