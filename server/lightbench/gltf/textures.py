"""Textures of a document and their images, as a scene has them."""

from typing import Any

from lightbench.errors import ModelError
from lightbench.gltf.buffers import Buffers
from lightbench.gltf.container import Container
from lightbench.gltf.limits import Budget
from lightbench.gltf.names import Names
from lightbench.gltf.schema import Document, Sampler
from lightbench.texels import as_png, open_image

__all__ = ["Textures"]

WRAPS = {10497: "repeat", 33071: "clamp", 33648: "mirror"}
NEAREST = 9728


class Textures:
    """The textures in use by name, one for each pair of an image and a way to read it.

    An entry's `image` is its position in `images` (PNGs); it gets a key when it is stored.
    """

    def __init__(
        self, document: Document, container: Container, buffers: Buffers, budget: Budget
    ) -> None:
        self.entries: dict[str, dict[str, Any]] = {}
        self.images: list[bytes] = []
        self._document = document
        self._container = container
        self._buffers = buffers
        self._budget = budget
        self._names = Names()
        self._name_by_use: dict[tuple[object, ...], str] = {}
        self._by_index: dict[int, int] = {}
        self._by_content: dict[bytes, int] = {}

    def name(self, index: int, encoding: str) -> str | None:
        """The name of a texture read as "srgb" or "linear", made when first asked for.

        None for a texture without an image that can be read. Raises ModelError.
        """
        texture = self._document.textures[index]
        if texture.image is None:
            return None
        sampler = Sampler() if texture.sampler is None else self._document.samplers[texture.sampler]
        wrap = (WRAPS[sampler.wrap_s], WRAPS[sampler.wrap_t])
        filtering = "nearest" if sampler.mag_filter == NEAREST else "linear"
        image = self._image(texture.image)
        use = (image, encoding, wrap, filtering)
        if use not in self._name_by_use:
            self._budget.spend("textures", 1, f"textures[{index}]")
            stem = self._document.images[texture.image].name.rsplit(".", 1)[0]
            name = self._names.new(texture.name, stem, f"texture_{index}")
            self._name_by_use[use] = name
            self.entries[name] = {
                "image": image, "encoding": encoding, "wrap": list(wrap), "filter": filtering,
            }  # fmt: skip
        return self._name_by_use[use]

    def _image(self, index: int) -> int:
        """The position in `images` of a document's image, decoded when first asked for."""
        if index not in self._by_index:
            png = self._decoded(index)
            position = self._by_content.setdefault(png, len(self.images))
            if position == len(self.images):
                self.images.append(png)
            self._by_index[index] = position
        return self._by_index[index]

    def _decoded(self, index: int) -> bytes:
        where, side = f"images[{index}]", self._budget.limits.image_side
        content = self._content(index, where)
        try:
            image = open_image(content)
            width, height = image.size
            if max(width, height) > side:
                raise ModelError(f"{where}: {width} x {height} texels; allowed are {side} a side")
            self._budget.spend("image_pixels", width * height, where)
            return as_png(image)
        except ValueError as error:
            raise ModelError(f"{where}: {error}") from None

    def _content(self, index: int, where: str) -> bytes:
        image = self._document.images[index]
        if image.uri is not None:
            return self._container.resolve(image.uri, f"{where}.uri")
        if image.buffer_view is None:
            raise ModelError(f"{where}: has neither uri nor bufferView")
        return bytes(self._buffers.view(image.buffer_view))
