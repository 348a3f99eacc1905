"""Buffers and their views: bytes within bounds, decompressed where they are (meshopt)."""

import meshopt

from lightbench.errors import ModelError
from lightbench.gltf.container import Container
from lightbench.gltf.schema import BufferView, Document, Meshopt

__all__ = ["Buffers"]


class Buffers:
    """The bytes of a document's buffer views, read when they are asked for and kept."""

    def __init__(self, document: Document, container: Container) -> None:
        self._document = document
        self._container = container
        self._buffers: dict[int, memoryview] = {}
        self._views: dict[int, memoryview] = {}

    def view(self, index: int) -> memoryview:
        """The bytes of a buffer view. Raises ModelError."""
        if index not in self._views:
            view, where = self._document.buffer_views[index], f"bufferViews[{index}]"
            packed = view.meshopt
            self._views[index] = (
                self._decompressed(view, packed, where)
                if packed
                else self._slice(view.buffer, view.byte_offset, view.byte_length, where)
            )
        return self._views[index]

    def _slice(self, buffer: int, offset: int, length: int, where: str) -> memoryview:
        content = self._buffer(buffer)
        if offset + length > len(content):
            raise ModelError(
                f"{where}: bytes {offset} to {offset + length} of buffers[{buffer}], which has "
                f"{len(content)}"
            )
        return content[offset : offset + length]

    def _buffer(self, index: int) -> memoryview:
        if index not in self._buffers:
            buffer, where = self._document.buffers[index], f"buffers[{index}]"
            if buffer.uri is not None:
                content = self._container.resolve(buffer.uri, f"{where}.uri")
            elif index == 0 and self._container.binary is not None:
                content = self._container.binary
            else:
                raise ModelError(f"{where}.uri: is missing, and there is no binary chunk for it")
            if len(content) < buffer.byte_length:
                raise ModelError(
                    f"{where}.byteLength: declares {buffer.byte_length} bytes; there are "
                    f"{len(content)}"
                )
            self._buffers[index] = memoryview(content)[: buffer.byte_length]
        return self._buffers[index]

    def _decompressed(self, view: BufferView, packed: Meshopt, where: str) -> memoryview:
        size = packed.count * packed.byte_stride
        if size > view.byte_length:
            raise ModelError(f"{where}.byteLength: {view.byte_length} of {size} decoded bytes")
        if packed.mode == "ATTRIBUTES" and packed.byte_stride % 4:
            raise ModelError(f"{where}: a stride of {packed.byte_stride} bytes; allowed are fours")
        self._container.budget.decode(size, where)
        source = self._slice(packed.buffer, packed.byte_offset, packed.byte_length, where)
        try:
            decoded = meshopt.decode_gltf_buffer(
                bytes(source), packed.count, packed.byte_stride, packed.mode, packed.filter
            )
        except ValueError as error:
            raise ModelError(f"{where}: meshopt cannot decode it: {error}") from None
        return memoryview(decoded.tobytes())
