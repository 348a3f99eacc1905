"""Images on the GPU: each uploaded once, however many materials share it."""

import io
from dataclasses import dataclass

import moderngl
from PIL import Image as Pillow

from lightbench import assets
from lightbench.plan_types import PlannedTexture

__all__ = ["Bound", "Textures"]

SRGB8_ALPHA8 = 0x8C43
# Bytes of all images kept between plans.
MAX_KEPT_BYTES = 2**29


@dataclass(frozen=True)
class Bound:
    """A texture and how it is sampled."""

    texture: moderngl.Texture
    sampler: moderngl.Sampler

    def use(self, unit: int) -> None:
        """Bind both to a texture unit."""
        self.texture.use(unit)
        self.sampler.use(unit)


class Textures:
    """Owns the images on the GPU, with their mip levels, and the samplers."""

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self.uploads = 0
        self._images: dict[tuple[str, str], moderngl.Texture] = {}
        self._samplers: dict[tuple[str, str, str, int], moderngl.Sampler] = {}

    def get(self, planned: PlannedTexture) -> Bound:
        """The texture of a plan. Raises NotFoundError where its image is not there any more."""
        return Bound(self.image(planned["image"], planned["encoding"]), self.sampler(planned))

    def image(self, key: str, encoding: str) -> moderngl.Texture:
        """An image with its mip levels; sRGB texels are decoded before they are filtered."""
        if (key, encoding) not in self._images:
            self.make_room()
            with Pillow.open(io.BytesIO(assets.image(key))) as png:
                image = png.convert("RGBA")
            internal = SRGB8_ALPHA8 if encoding == "srgb" else None
            texture = self.context.texture(image.size, 4, image.tobytes(), internal_format=internal)
            texture.build_mipmaps()
            self._images[key, encoding] = texture
            self.uploads += 1
        self._images[key, encoding] = self._images.pop((key, encoding))
        return self._images[key, encoding]

    def make_room(self) -> None:
        """Release the images that were used the longest time ago."""
        while sum(t.width * t.height * 16 // 3 for t in self._images.values()) > MAX_KEPT_BYTES:
            self._images.pop(next(iter(self._images))).release()

    def sampler(self, planned: PlannedTexture) -> moderngl.Sampler:
        """Trilinear filtering, or the nearest texel of the nearest level."""
        u, v = planned["wrap"]
        key = (u, v, planned["filter"], planned["anisotropy"])
        if key not in self._samplers:
            nearest = planned["filter"] == "nearest"
            sampler = self.context.sampler(
                filter=(moderngl.NEAREST_MIPMAP_NEAREST, moderngl.NEAREST)
                if nearest
                else (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR),
                anisotropy=1.0 if nearest else float(planned["anisotropy"]),
            )
            # A mirrored coordinate comes folded.
            sampler.repeat_x, sampler.repeat_y = u == "repeat", v == "repeat"
            self._samplers[key] = sampler
        return self._samplers[key]
