"""A glTF file's container: the bytes of the file, its JSON and binary chunk, and its neighbours."""

import base64
import binascii
import re
import struct
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote, unquote_to_bytes

from lightbench.errors import ModelError
from lightbench.gltf.limits import Budget

__all__ = ["Container", "open_container"]

MAGIC = b"glTF"
JSON_CHUNK, BINARY_CHUNK = 0x4E4F534A, 0x004E4942
DATA_URI = re.compile(r"data:[^,;]*((?:;[^,;]*)*),", re.ASCII | re.IGNORECASE)


@dataclass(frozen=True)
class Container:
    """The JSON text, the binary chunk of a .glb, and the folder whose files may be read.

    Without a folder none may.
    """

    text: bytes
    binary: bytes | None
    folder: Path | None
    budget: Budget

    def resolve(self, uri: str, where: str) -> bytes:
        """The bytes of a data URI or of a file beside the model. Raises ModelError."""
        if uri[:5].lower() == "data:":
            return _data(uri, where)
        return self._neighbour(uri, where)

    def _neighbour(self, uri: str, where: str) -> bytes:
        name = unquote(uri)
        if re.match(r"[a-zA-Z][a-zA-Z0-9+.-]*:|[/\\]", name) or "\\" in name or "\0" in name:
            raise ModelError(f"{where}: {_short(uri)} is no path beside the model, nor a data URI")
        if self.folder is None:
            raise ModelError(
                f"{where}: the file {_short(uri)} is missing: what is sent alone must hold its "
                "buffers and images, as a .glb does"
            )
        try:
            path = (self.folder / name).resolve()
            inside, there = path.is_relative_to(self.folder.resolve()), path.is_file()
        except (OSError, RuntimeError) as error:
            raise ModelError(f"{where}: {_short(uri)} is no path: {type(error).__name__}") from None
        if not inside:
            raise ModelError(f"{where}: {_short(uri)} leads out of the model's folder")
        if not there:
            raise ModelError(f"{where}: there is no file {_short(uri)} beside the model")
        return read_bounded(path, self.budget, where)


def open_container(source: Path | bytes, budget: Budget) -> Container:
    """The container of a .glb or .gltf file, told apart by content. Raises ModelError."""
    if isinstance(source, Path):
        if not source.is_file():
            raise ModelError("file: there is none")
        folder, content = source.parent, read_bounded(source, budget, "file")
    else:
        folder, content = None, bytes(source)
        budget.spend("file_bytes", len(content), "file")
    if content[:4] == MAGIC:
        text, binary = _chunks(content)
    else:
        text, binary = content, None
    if not text.strip():
        raise ModelError("file: is empty; allowed are glTF 2.0 (.gltf) and binary glTF (.glb)")
    return Container(text.removeprefix(b"\xef\xbb\xbf"), binary, folder, budget)


def read_bounded(path: Path, budget: Budget, where: str) -> bytes:
    """A file's bytes, no more of them than the budget allows. Raises ModelError."""
    try:
        with path.open("rb") as file:
            content = file.read(budget.limits.file_bytes + 1)
    except OSError as error:
        raise ModelError(f"{where}: {error.strerror}") from None
    budget.spend("file_bytes", len(content), where)
    return content


def _chunks(content: bytes) -> tuple[bytes, bytes | None]:
    """JSON and binary chunk of a binary glTF (specification, section 4.4)."""
    if len(content) < 20:
        raise ModelError(f"header: the file ends after {len(content)} bytes; a .glb has 20 or more")
    version, length = struct.unpack_from("<II", content, 4)
    if version != 2:
        raise ModelError(f"header: version {version} of binary glTF; allowed is 2")
    if length > len(content):
        raise ModelError(f"header: the file has {len(content)} bytes of the {length} it declares")
    chunks = list(_walk(content[:length]))
    if not chunks or chunks[0][0] != JSON_CHUNK:
        raise ModelError("chunks[0]: is not JSON, which a .glb begins with")
    second = chunks[1] if len(chunks) > 1 else (0, b"")
    return chunks[0][1], second[1] if second[0] == BINARY_CHUNK else None


def _walk(content: bytes) -> list[tuple[int, bytes]]:
    """(type, content) of the first chunks; no more than two mean anything."""
    found: list[tuple[int, bytes]] = []
    at = 12
    while at + 8 <= len(content) and len(found) < 2:
        size, kind = struct.unpack_from("<II", content, at)
        if size > len(content) - at - 8:
            left = len(content) - at - 8
            raise ModelError(f"chunks[{len(found)}]: declares {size} bytes where {left} are left")
        found.append((kind, content[at + 8 : at + 8 + size]))
        at += 8 + size
    return found


def _data(uri: str, where: str) -> bytes:
    match = DATA_URI.match(uri)
    if not match:
        raise ModelError(f"{where}: a data URI without a comma")
    body = uri[match.end() :]
    if not match[1].lower().endswith(";base64"):
        return unquote_to_bytes(body)
    try:
        return base64.b64decode(unquote(body) if "%" in body else body, validate=True)
    except (binascii.Error, ValueError) as error:
        raise ModelError(f"{where}: the data URI is not base64: {error}") from None


def _short(uri: str) -> str:
    text = ascii(uri)
    return text if len(text) <= 80 else f"{text[:76]}...'"
