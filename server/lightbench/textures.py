"""Images on the GPU: each uploaded once, however many materials share it."""

import io
from collections.abc import Collection
from dataclasses import dataclass
from typing import NamedTuple

import moderngl
import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow

from lightbench import assets
from lightbench.plan_types import Plan, PlannedArray, PlannedTexture, Sampling

__all__ = ["Bound", "Textures"]

SRGB8_ALPHA8 = 0x8C43
# Bytes of all images kept between plans.
MAX_KEPT_BYTES = 2**29
# What an image's first level takes is 3/4 of all its levels.
LEVELS = 4 / 3
Texture = moderngl.Texture | moderngl.TextureArray


class Key(NamedTuple):
    """What makes a texture: one image, or the images of its layers."""

    images: tuple[str, ...]
    encoding: str
    layered: bool


@dataclass(frozen=True)
class Bound:
    """A texture and how it is sampled."""

    texture: Texture
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
        self._images: dict[Key, Texture] = {}
        self._samplers: dict[tuple[str, str, str, int], moderngl.Sampler] = {}

    def load(self, plan: Plan) -> tuple[dict[str, Bound], dict[str, Bound]]:
        """The textures and the arrays of a plan, by name.

        Raises NotFoundError where an image is not there any more.
        """
        textures, arrays = plan["textures"], plan["arrays"]
        self.make_room({*map(_key_of, textures.values()), *map(_key_of_array, arrays.values())})
        return (
            {n: Bound(self.image(_key_of(t)), self.sampler(t)) for n, t in textures.items()},
            {n: Bound(self.array(_key_of_array(a)), self.sampler(a)) for n, a in arrays.items()},
        )

    def image(self, key: Key) -> Texture:
        """An image with its mip levels; sRGB texels are decoded before they are filtered."""
        if key not in self._images:
            pixels = _pixels(key.images[0])
            internal = SRGB8_ALPHA8 if key.encoding == "srgb" else None
            size = (pixels.shape[1], pixels.shape[0])
            texture = self.context.texture(size, 4, pixels.tobytes(), internal_format=internal)
            self.keep(key, texture)
        return self.used(key)

    def array(self, key: Key) -> Texture:
        """Images as layers. moderngl has no array of sRGB texels: they are decoded here."""
        if key not in self._images:
            layers = np.stack([_pixels(image) for image in key.images])
            size = (layers.shape[2], layers.shape[1], len(layers))
            if key.encoding == "srgb":
                texture = self.context.texture_array(
                    size, 4, _decoded(layers).tobytes(), dtype="f2"
                )
            else:
                texture = self.context.texture_array(size, 4, layers.tobytes())
            self.keep(key, texture)
        return self.used(key)

    def keep(self, key: Key, texture: Texture) -> None:
        texture.build_mipmaps()
        self._images[key] = texture
        self.uploads += 1

    def used(self, key: Key) -> Texture:
        """The texture, which is from now on the last to go."""
        self._images[key] = self._images.pop(key)
        return self._images[key]

    def make_room(self, wanted: Collection[Key]) -> None:
        """Release the images that were used the longest time ago, but none that is `wanted`."""
        held = sum(map(_bytes, self._images.values()))
        for key in [key for key in self._images if key not in wanted]:
            if held <= MAX_KEPT_BYTES:
                return
            texture = self._images.pop(key)
            held -= _bytes(texture)
            texture.release()

    def sampler(self, planned: Sampling) -> moderngl.Sampler:
        """Trilinear filtering, or the nearest texel of the image itself."""
        u, v = planned["wrap"]
        key = (u, v, planned["filter"], planned["anisotropy"])
        if key not in self._samplers:
            nearest = planned["filter"] == "nearest"
            sampler = self.context.sampler(
                filter=(moderngl.NEAREST, moderngl.NEAREST)
                if nearest
                else (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR),
                anisotropy=1.0 if nearest else float(planned["anisotropy"]),
            )
            # A mirrored coordinate comes folded.
            sampler.repeat_x, sampler.repeat_y = u == "repeat", v == "repeat"
            self._samplers[key] = sampler
        return self._samplers[key]


def _key_of(planned: PlannedTexture) -> Key:
    return Key((planned["image"],), planned["encoding"], layered=False)


def _key_of_array(planned: PlannedArray) -> Key:
    return Key(tuple(planned["images"]), planned["encoding"], layered=True)


def _bytes(texture: Texture) -> float:
    layers = texture.layers if isinstance(texture, moderngl.TextureArray) else 1
    texel = 8 if texture.dtype == "f2" else 4
    return texture.width * texture.height * layers * texel * LEVELS


def _pixels(key: str) -> NDArray[np.uint8]:
    """(H, W, 4) codes."""
    with Pillow.open(io.BytesIO(assets.image(key))) as png:
        return np.asarray(png.convert("RGBA"))


def _decoded(codes: NDArray[np.uint8]) -> NDArray[np.float16]:
    """sRGB codes to linear values (IEC 61966-2-1), alpha as it is."""
    level = np.arange(256) / 255
    linear = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    made = linear.astype(np.float16)[codes]
    made[..., 3] = level.astype(np.float16)[codes[..., 3]]
    return made
