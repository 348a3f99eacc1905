"""Small glTF documents made in a test, as .glb or .gltf."""

import base64
import io
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image

from lightbench.gltf import Limits, read_gltf

Data = dict[str, Any]

COMPONENTS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
FACING = [(0, 0, 1)] * 4
SQUARE = [0, 1, 2, 0, 2, 3]
UPRIGHT = [(0, 1), (1, 1), (1, 0), (0, 0)]


class Model:
    """A document under construction: `json` is free to be changed, `binary` grows."""

    def __init__(self) -> None:
        self.json: Data = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]}
        self.binary = bytearray()

    def add(self, group: str, part: Data) -> int:
        """Append to one of the document's lists and return the index."""
        self.json.setdefault(group, []).append(part)
        return len(self.json[group]) - 1

    def view(self, content: bytes, **more: object) -> int:
        """A buffer view of bytes, aligned to four."""
        self.binary += bytes(-len(self.binary) % 4)
        start = len(self.binary)
        self.binary += content
        place = {"buffer": 0, "byteOffset": start, "byteLength": len(content)}
        return self.add("bufferViews", place | more)

    def accessor(self, values: ArrayLike, kind: str = "f4", **more: object) -> int:
        """An accessor of rows of numbers, of little-endian components such as "u2"."""
        array = np.asarray(values, f"<{kind}")
        rows: NDArray[Any] = array.reshape(len(array), -1)
        about = {
            "bufferView": self.view(rows.tobytes()),
            "componentType": COMPONENTS[kind],
            "count": len(rows),
            "type": TYPES[rows.shape[1]],
        }
        return self.add("accessors", about | more)

    def mesh(self, primitives: list[Data], name: str = "") -> int:
        return self.add("meshes", {"primitives": primitives, "name": name})

    def root(self, **node: object) -> int:
        """A node of the default scene."""
        index = self.add("nodes", dict(node))
        self.json["scenes"][0]["nodes"].append(index)
        return index

    def square(self, **more: object) -> Data:
        """A primitive: the unit square facing +z, with normals and texture coordinates."""
        attributes = {
            "POSITION": self.accessor(CORNERS),
            "NORMAL": self.accessor(FACING),
            "TEXCOORD_0": self.accessor(UPRIGHT),
        }
        return {"attributes": attributes, "indices": self.accessor(SQUARE, "u2")} | more

    def texture(self, color: tuple[int, ...] = (255, 0, 0), **more: object) -> int:
        """A texture of one colour, in an image of its own."""
        return self.textured(png(color), **more)

    def textured(self, image: bytes, **more: object) -> int:
        """A texture of an image file."""
        source = self.add("images", {"bufferView": self.view(image)})
        return self.add("textures", {"source": source} | more)

    def glb(self) -> bytes:
        document = self._with_buffer({})
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + bytes(-len(self.binary) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        if binary:
            chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def gltf(self, uri: str | None = None) -> bytes:
        """As JSON; the buffer is at `uri`, or in a data URI."""
        encoded = base64.b64encode(self.binary).decode()
        data = f"data:application/octet-stream;base64,{encoded}"
        return json.dumps(self._with_buffer({"uri": uri or data})).encode()

    def _with_buffer(self, more: Data) -> Data:
        if not self.binary:
            return self.json
        own = {"byteLength": len(self.binary)} | more
        return {"buffers": [own, *self.json.get("buffers", [])]} | {
            key: value for key, value in self.json.items() if key != "buffers"
        }


def square(**primitive: object) -> Model:
    """A model of one square, with its node and mesh."""
    model = Model()
    model.root(mesh=model.mesh([model.square(**primitive)], "Square"))
    return model


def png(color: tuple[int, ...], size: tuple[int, int] = (2, 2)) -> bytes:
    """An image file of one colour, RGB or RGBA."""
    file = io.BytesIO()
    Image.new("RGBA" if len(color) == 4 else "RGB", size, color).save(file, "PNG")
    return file.getvalue()


def read(source: Model | bytes | Path, **limits: int) -> Data:
    """The scene's data of a model, which is not kept."""
    content = source.glb() if isinstance(source, Model) else source
    return read_gltf(content, name="test.glb", limits=Limits(**limits), keep=False)
