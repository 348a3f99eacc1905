"""Accessors: typed arrays out of buffer views, sparse and normalised ones too, all finite."""

from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import ModelError
from lightbench.gltf.buffers import Buffers
from lightbench.gltf.limits import Budget
from lightbench.gltf.schema import Accessor, Document

__all__ = ["Accessors", "as_floats"]

DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
Raw = NDArray[Any]


def as_floats(raw: Raw, *, normalized: bool) -> NDArray[np.float32]:
    """Components as float32: integers as they are, or normalised to 0..1 or -1..1.

    Specification, section 3.6.2.2: unsigned c / (2^n - 1); signed max(c / (2^(n-1) - 1), -1).
    """
    if raw.dtype.kind == "f" or not normalized:
        return raw.astype(np.float32)
    scaled = raw.astype(np.float64) / np.iinfo(raw.dtype).max
    return np.maximum(scaled, -1).astype(np.float32)


class Accessors:
    """The arrays of a document's accessors, read when they are asked for and kept."""

    def __init__(self, document: Document, buffers: Buffers, budget: Budget) -> None:
        self._document = document
        self._buffers = buffers
        self._budget = budget
        self._floats: dict[int, NDArray[np.float32]] = {}
        self._indices: dict[int, NDArray[np.int64]] = {}

    def check(self) -> None:
        """Raise ModelError if any accessor reaches beyond its buffer view."""
        for index, accessor in enumerate(self._document.accessors):
            where = f"accessors[{index}]"
            if accessor.buffer_view is not None:
                width = _element(accessor)
                view = self._document.buffer_views[accessor.buffer_view]
                stride = (view.meshopt.byte_stride if view.meshopt else view.byte_stride) or width
                if stride < width:
                    raise ModelError(f"{where}: elements of {width} bytes every {stride} bytes")
                end = accessor.byte_offset + (accessor.count - 1) * stride + width
                if end > view.byte_length:
                    raise ModelError(
                        f"{where}: ends at byte {end} of bufferViews[{accessor.buffer_view}], "
                        f"which has {view.byte_length}"
                    )
            if accessor.sparse and accessor.sparse.count > accessor.count:
                raise ModelError(
                    f"{where}.sparse.count: {accessor.sparse.count} of {accessor.count} elements"
                )

    def floats(self, index: int, allowed: Collection[str], where: str) -> NDArray[np.float32]:
        """The elements (count, width) of an accessor whose type is among those allowed, finite.

        `where` is the path of what refers to it. Raises ModelError.
        """
        accessor = self._document.accessors[index]
        if accessor.type not in allowed:
            raise ModelError(
                f"accessors[{index}].type: {accessor.type} for {where}; allowed is "
                f"{' or '.join(allowed)}"
            )
        if index not in self._floats:
            values = as_floats(self._raw(index), normalized=accessor.normalized)
            finite = np.isfinite(values).all(axis=1)
            if not finite.all():
                row = int(np.argmin(finite))
                raise ModelError(
                    f"accessors[{index}]: element {row} of {where} is not finite: "
                    f"{', '.join(f'{value:g}' for value in values[row])}"
                )
            self._floats[index] = values
        return self._floats[index]

    def indices(self, index: int, where: str) -> NDArray[np.int64]:
        """Vertex indices (count,). Raises ModelError."""
        accessor = self._document.accessors[index]
        if accessor.type != "SCALAR" or accessor.component_type not in (5121, 5123, 5125):
            raise ModelError(
                f"accessors[{index}]: {accessor.type} of componentType {accessor.component_type} "
                f"for {where}; allowed is SCALAR of 5121, 5123 or 5125"
            )
        if index not in self._indices:
            self._indices[index] = self._raw(index)[:, 0].astype(np.int64)
        return self._indices[index]

    def _raw(self, index: int) -> Raw:
        accessor, where = self._document.accessors[index], f"accessors[{index}]"
        self._budget.decode(accessor.count * 4 * WIDTHS[accessor.type], where)
        if accessor.buffer_view is None:
            dense = np.zeros((accessor.count, WIDTHS[accessor.type]), _dtype(accessor))
        else:
            view = self._document.buffer_views[accessor.buffer_view]
            stride = view.meshopt.byte_stride if view.meshopt else view.byte_stride
            dense = self._read(
                accessor, accessor.buffer_view, accessor.byte_offset, accessor.count, stride, where
            )
        return self._with_sparse(accessor, dense, where) if accessor.sparse else dense

    def _read(
        self, accessor: Accessor, view: int, offset: int, count: int, stride: int | None, where: str
    ) -> Raw:
        dtype, width = _dtype(accessor), WIDTHS[accessor.type]
        return self._array(view, offset, (count, width), stride, dtype, where)

    def _array(
        self, view: int, offset: int, shape: tuple[int, int], stride: int | None,
        dtype: np.dtype[Any], where: str,
    ) -> Raw:  # fmt: skip
        content = self._buffers.view(view)
        element = shape[1] * dtype.itemsize
        step = stride or element
        end = offset + (shape[0] - 1) * step + element
        if end > len(content):
            raise ModelError(
                f"{where}: ends at byte {end} of bufferViews[{view}], which has {len(content)}"
            )
        return np.ndarray(shape, dtype, content, offset, (step, dtype.itemsize))

    def _with_sparse(self, accessor: Accessor, dense: Raw, where: str) -> Raw:
        sparse = accessor.sparse
        assert sparse is not None
        indices, values = sparse.indices, sparse.values
        at = self._array(
            indices.buffer_view, indices.byte_offset, (sparse.count, 1), None,
            np.dtype(DTYPES[indices.component_type]), f"{where}.sparse.indices",
        )[:, 0].astype(np.int64)  # fmt: skip
        if at.max() >= accessor.count:
            raise ModelError(
                f"{where}.sparse.indices: element {at.max()} of an accessor of {accessor.count}"
            )
        changed = dense.copy()
        changed[at] = self._read(
            accessor, values.buffer_view, values.byte_offset, sparse.count, None,
            f"{where}.sparse.values",
        )  # fmt: skip
        return changed


def _dtype(accessor: Accessor) -> np.dtype[Any]:
    return np.dtype(DTYPES[accessor.component_type])


def _element(accessor: Accessor) -> int:
    """Bytes of an element. The columns of the matrices that are read (MAT4) need no padding."""
    return WIDTHS[accessor.type] * _dtype(accessor).itemsize
