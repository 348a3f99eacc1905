"""Image files of any kind that textures come in, as PNGs that every decoder reads alike."""

import io
import struct
import warnings
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

__all__ = ["FORMATS", "Texels", "as_png", "open_image"]

FORMATS = ("PNG", "JPEG", "WEBP")
# What Pillow's decoders raise for broken files.
BROKEN = (
    OSError, SyntaxError, ValueError, EOFError, ArithmeticError, LookupError, TypeError,
    AttributeError, NotImplementedError, struct.error, zlib.error, MemoryError,
    Image.DecompressionBombError, Image.DecompressionBombWarning,
)  # fmt: skip
# Of zlib, 0 to 9: from here on the files hardly get smaller, only slower to write.
COMPRESSION = 3

Texels = NDArray[np.uint8]


def open_image(content: bytes) -> Image.Image:
    """An image file's header: its `size` is known, no texel decoded yet. Raises ValueError."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            return Image.open(io.BytesIO(content), formats=FORMATS)
    except BROKEN as error:
        raise ValueError(_reason(error)) from None


def as_png(image: Image.Image) -> bytes:
    """The texels as a PNG of 8 bit RGB, or RGBA where the image has any transparency.

    Colour profiles, gamma and orientation tags are left out: texels mean what their use says.
    Raises ValueError for a broken image.
    """
    try:
        texels = _texels(image)
    except BROKEN as error:
        raise ValueError(_reason(error)) from None
    file = io.BytesIO()
    Image.fromarray(texels).save(file, "PNG", compress_level=COMPRESSION)
    return file.getvalue()


def _texels(image: Image.Image) -> Texels:
    """(H, W, 3) or (H, W, 4)."""
    image.load()
    if image.mode.startswith("I;16") or image.mode == "I":
        return _from_grey16(np.asarray(image))
    transparent = image.mode in ("RGBA", "LA", "PA", "La", "RGBa") or "transparency" in image.info
    return np.asarray(image.convert("RGBA" if transparent else "RGB"))


def _from_grey16(values: NDArray[Any]) -> Texels:
    """The 8 bit codes nearest to 16 bit ones."""
    codes = np.clip((values.astype(np.int64) * 255 + 32767) // 65535, 0, 255).astype(np.uint8)
    return np.repeat(codes[..., None], 3, axis=2)


def _reason(error: BaseException) -> str:
    if isinstance(error, UnidentifiedImageError):
        return f"is no image of the allowed kinds: {', '.join(FORMATS)}"
    return " ".join(str(error).split()) or type(error).__name__
