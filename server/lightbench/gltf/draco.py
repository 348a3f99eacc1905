"""Draco-compressed primitives, decoded by Google's library (DracoPy) in a process of its own.

The header is read first: how many points and faces it will decode to is known before any memory
is taken for them. What else the data may hold is not; a process that takes too long or too much
ends, and with it nothing but the reading of that model.
"""

import atexit
import io
import struct
import subprocess
import sys
from collections.abc import Collection
from pathlib import Path
from threading import Lock, Timer
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import ModelError

__all__ = ["decode"]

MAGIC, HEADER = b"DRACO", 11
TRIANGULAR_MESH, METADATA = 1, 0x8000
SEQUENTIAL, EDGEBREAKER = 0, 1
# Seconds for one primitive: the largest that the limits allow takes two or three.
PATIENCE = 15.0
# Bytes of an answer: more than the worker's memory holds is none.
LONGEST = 4 << 30
WORKER = Path(__file__).with_name("draco_worker.py")
Decoded = tuple[NDArray[np.int64], dict[int, NDArray[Any]]]


def decode(content: bytes, ids: Collection[int], points: int, faces: int, where: str) -> Decoded:
    """Triangles (T, 3), and the attributes (V, k) of these unique ids that there are.

    Of no more than so many points and faces. Raises ModelError.
    """
    _check_header(content, points, faces, where)
    answer = _worker.ask(struct.pack(f"<{len(ids) + 1}I", len(ids), *ids) + content)
    if answer[:1] != b"+":
        reason = answer[1:].decode(errors="replace") or "it takes too much time or memory"
        raise ModelError(f"{where}: Draco cannot decode it: {' '.join(reason.split())[:200]}")
    with np.load(io.BytesIO(answer[1:]), allow_pickle=False) as arrays:
        triangles = arrays["faces"].reshape(-1, 3)
        attributes = {int(name): arrays[name] for name in arrays.files if name != "faces"}
    if any(a.ndim != 2 or len(a) > points for a in attributes.values()):
        raise ModelError(f"{where}: Draco decoded something else than {points} points")
    return triangles, attributes


class _Worker:
    """The decoding process, started when first asked, and anew after it has failed."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._process: subprocess.Popen[bytes] | None = None

    def ask(self, request: bytes) -> bytes:
        """The worker's answer; empty if it ended or was ended instead."""
        with self._lock:
            process = self._process or subprocess.Popen(
                [sys.executable, "-P", WORKER],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
            )
            self._process = process
            timer = Timer(PATIENCE, process.kill)
            timer.start()
            try:
                answer = _exchange(process, request)
            finally:
                timer.cancel()
            if not answer:
                self._end()
            return answer

    def close(self) -> None:
        """End the process, if there is one."""
        with self._lock:
            self._end()

    def _end(self) -> None:
        process, self._process = self._process, None
        if process:
            process.kill()
            process.communicate()


def _exchange(process: subprocess.Popen[bytes], request: bytes) -> bytes:
    source, target = process.stdout, process.stdin
    assert source is not None
    assert target is not None
    try:
        target.write(len(request).to_bytes(8, "little") + request)
        target.flush()
    except OSError:
        return b""
    length = int.from_bytes(source.read(8), "little")
    answer = source.read(length) if length <= LONGEST else b""
    return answer if len(answer) == length else b""


_worker = _Worker()
atexit.register(_worker.close)


def _check_header(content: bytes, points: int, faces: int, where: str) -> None:
    """Draco bitstream 2.2: "DRACO", version, type, method, flags, then the connectivity."""
    if content[:5] != MAGIC or len(content) < HEADER + 3:
        raise ModelError(f"{where}: is no Draco data")
    major, minor, kind, method = content[5:9]
    if (major, minor) != (2, 2):
        raise ModelError(f"{where}: Draco bitstream {major}.{minor}; allowed is 2.2")
    if kind != TRIANGULAR_MESH or method not in (SEQUENTIAL, EDGEBREAKER):
        raise ModelError(f"{where}: is no triangle mesh of Draco's")
    if int.from_bytes(content[9:11], "little") & METADATA:
        raise ModelError(f"{where}: Draco data with metadata; allowed is data without")
    at = HEADER + (method == EDGEBREAKER)
    first, at = _varint(content, at)
    second, _ = _varint(content, at)
    found_faces, found_points = (second, first) if method == EDGEBREAKER else (first, second)
    if found_points > points or found_faces > faces:
        raise ModelError(
            f"{where}: Draco holds {found_points} points and {found_faces} faces where the "
            f"accessors have {points} and {faces}"
        )


def _varint(content: bytes, at: int) -> tuple[int, int]:
    """A number in groups of seven bits, lowest first, and the place after it."""
    value = 0
    for shift in range(0, 35, 7):
        byte = content[at + shift // 7] if at + shift // 7 < len(content) else 0
        value |= (byte & 0x7F) << shift
        if byte < 0x80:
            return value, at + shift // 7 + 1
    return value, at + 5
