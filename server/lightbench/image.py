"""A rendered picture: linear float32 values, their display code, and the files made of them."""

import io
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenEXR
from numpy.typing import NDArray
from PIL import Image as Pillow

from lightbench.errors import LightbenchError

__all__ = ["FORMATS", "Image", "Invalid", "write_whole"]


@dataclass(frozen=True)
class Invalid:
    """How many pixels hold a NaN, an infinity, or a negative channel."""

    nan: int
    inf: int
    negative: int

    @property
    def total(self) -> int:
        """All of them."""
        return self.nan + self.inf + self.negative


@dataclass(frozen=True)
class Image:
    """`linear`: (H, W, 3) float32 radiance, row 0 at the top. `display`: (H, W, 3) uint8 codes.

    `milliseconds` is the time the passes took, measured to their completion; `renderer` names
    what ran them. A `signed` picture holds negative numbers by right.
    """

    linear: NDArray[np.float32]
    display: NDArray[np.uint8]
    milliseconds: float
    renderer: str
    signed: bool = False

    def invalid(self) -> Invalid:
        """Counts of NaN, infinite and, unless it is signed, negative pixels of `linear`."""
        if np.isfinite(self.linear).all() and (self.signed or self.linear.min() >= 0):
            return Invalid(0, 0, 0)
        nan = np.isnan(self.linear).any(axis=2)
        inf = np.isinf(self.linear).any(axis=2) & ~nan
        with np.errstate(invalid="ignore"):
            negative = (self.linear < 0).any(axis=2) & ~nan & ~inf & (not self.signed)
        return Invalid(int(nan.sum()), int(inf.sum()), int(negative.sum()))

    def as_stored(self) -> "Image":
        """The same with its linear values for display codes: 0 to 1 as 0 to 255, NaN as 0."""
        shares = np.nan_to_num(np.clip(self.linear, 0.0, 1.0))
        display = (shares * 255 + 0.5).astype(np.uint8)
        return Image(self.linear, display, self.milliseconds, self.renderer, self.signed)

    def png(self, level: int = 6) -> bytes:
        """The display codes as PNG; `level` 0 to 9 is zlib's, 1 is the quickest."""
        buffer = io.BytesIO()
        Pillow.fromarray(self.display).save(buffer, "PNG", compress_level=level)
        return buffer.getvalue()

    def npy(self) -> bytes:
        """`linear` as a NumPy file."""
        buffer = io.BytesIO()
        np.save(buffer, self.linear)
        return buffer.getvalue()

    def exr(self) -> bytes:
        """`linear` as OpenEXR, float32 RGB, Rec. 709 primaries."""
        header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "image.exr"
            with OpenEXR.File(header, {"RGB": self.linear}) as file:
                file.write(str(path))
            return path.read_bytes()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write `.png`, `.npy` or `.exr`, whole or not at all.

        Raises LightbenchError for another ending or a folder that cannot be written.
        """
        suffix = Path(path).suffix
        if suffix not in FORMATS:
            raise LightbenchError(
                f"{path}: no format '{suffix}'; allowed are: {', '.join(FORMATS)}"
            )
        write_whole(Path(path), FORMATS[suffix][0](self))

    def _repr_png_(self) -> bytes:
        return self.png()


# Ending: (encoder, media type).
FORMATS = {
    ".png": (Image.png, "image/png"),
    ".npy": (Image.npy, "application/octet-stream"),
    ".exr": (Image.exr, "image/x-exr"),
}


def write_whole(path: Path, data: bytes) -> None:
    """Write to a temporary folder beside `path`, then rename: no reader ever sees half of it."""
    try:
        with tempfile.TemporaryDirectory(prefix=".lightbench-", dir=path.parent) as folder:
            temporary = Path(folder) / path.name
            temporary.write_bytes(data)
            temporary.replace(path)
    except OSError as error:
        raise LightbenchError(f"{path}: cannot be written: {error.strerror}") from None
