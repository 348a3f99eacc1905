"""The asset store: meshes and images by content key, for as long as the process lives.

A key says what it names and is a hash of the content, so that the same content is kept once and
a key never comes to mean something else: "mesh-", or "image-640x480-" with the image's size in
pixels, and 32 hexadecimal digits.
"""

import hashlib
import struct
from collections import OrderedDict
from dataclasses import dataclass
from threading import Lock

from lightbench.errors import NotFoundError
from lightbench.mesh import Mesh, pack

__all__ = ["BUDGET", "add_image", "add_mesh", "image", "mesh"]

# Bytes of what may be dropped (uploads); the oldest goes first.
BUDGET = 1 << 30


@dataclass(frozen=True)
class _Asset:
    content: Mesh | bytes
    size: int
    keep: bool


_lock = Lock()
_assets: OrderedDict[str, _Asset] = OrderedDict()


def add_mesh(mesh: Mesh, *, keep: bool) -> str:
    """Store a mesh and return its key; what is not to `keep` may be dropped for newer uploads."""
    packed = pack(mesh)
    return _add("mesh", packed, _Asset(mesh, len(packed), keep))


def add_image(png: bytes, *, keep: bool) -> str:
    """Store the bytes of a PNG and return their key; `keep` as for a mesh."""
    width, height = struct.unpack(">II", png[16:24])  # of the header, which is a PNG's first chunk
    return _add(f"image-{width}x{height}", png, _Asset(png, len(png), keep))


def mesh(key: str) -> Mesh:
    """The mesh of a key. Raises NotFoundError."""
    content = _get(key)
    if not isinstance(content, Mesh):
        raise _missing(key)
    return content


def image(key: str) -> bytes:
    """The PNG of a key. Raises NotFoundError."""
    content = _get(key)
    if not isinstance(content, bytes):
        raise _missing(key)
    return content


def _get(key: str) -> Mesh | bytes | None:
    with _lock:
        found = _assets.get(key)
    return found.content if found else None


def _missing(key: str) -> NotFoundError:
    return NotFoundError(
        f"no asset {key!r}: it was never added or gave way to newer uploads; read its model again"
    )


def _add(kind: str, content: bytes, asset: _Asset) -> str:
    key = f"{kind}-{hashlib.sha256(content).hexdigest()[:32]}"
    with _lock:
        before = _assets.pop(key, None)
        kept = asset.keep or (before is not None and before.keep)
        _assets[key] = _Asset(asset.content, asset.size, kept)
        _drop_oldest(but=key)
    return key


def _drop_oldest(but: str) -> None:
    """Drop what need not be kept, oldest first, until the rest fits; never the newest."""
    loose = [(key, asset.size) for key, asset in _assets.items() if not asset.keep]
    excess = sum(size for _, size in loose) - BUDGET
    for key, size in loose:
        if excess <= 0 or key == but:
            return
        del _assets[key]
        excess -= size
