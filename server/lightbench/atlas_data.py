"""The stability atlas for the page: what it computes by itself, and the truth beside it.

A GPU has no float64. So a document holds the shader sources of a sweep, the arguments of every
point in float32 and the exact values in float64; a browser runs the former and compares.

A document is a uint32, the length of its header; the header, JSON padded with spaces to a multiple
of 8 bytes with the uint32; then arrays one after the other, each from a multiple of 8 on. All is
little-endian. `at` is where an array begins, counted from the end of the header.
"""

import json
import struct
from collections.abc import Iterator
from dataclasses import asdict
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench.atlas import PRECISIONS, Precision
from lightbench.batches import ById
from lightbench.exact import reference
from lightbench.glsl import prepare
from lightbench.glsl_run import Prepared, one_call, program, sampler
from lightbench.library import Library
from lightbench.sweep import Input, Sweep, points, sweep_of, sweeps
from lightbench.sweep_arguments import Given, arguments, doubled

__all__ = ["SIZE", "document", "documents", "index"]

# Points an axis.
SIZE = 96
ALIGNED = 8


def index(library: Library) -> dict[str, Any]:
    """Every function of the atlas: title, inputs to choose axes from, the usual pairs first."""
    found: dict[tuple[str, str], dict[str, Any]] = {}
    for sweep in sweeps(library):
        entry = found.setdefault((sweep.file, sweep.function), _entry(library, sweep))
        entry["axes"].append([sweep.x, sweep.y])
    return {"size": SIZE, "functions": list(found.values())}


def _entry(library: Library, sweep: Sweep) -> dict[str, Any]:
    folder = library.folders.get(sweep.file.split("/")[0])
    return {
        "file": sweep.file,
        "function": sweep.function,
        "group": folder.title if folder else "Geometry and light",
        "title": library.files[sweep.file].meta.title or sweep.file,
        "inputs": [{"name": i.name, "label": i.label, "unit": i.unit} for i in sweep.inputs],
        "axes": [],
    }


def documents(library: Library) -> Iterator[tuple[str, bytes]]:
    """(path below data/, document) of every usual sweep."""
    for sweep in sweeps(library):
        stem = sweep.file.removesuffix(".glsl")
        path = f"atlas/{stem}/{sweep.function}/{sweep.x}/{sweep.y}.bin"
        yield path, document(library, sweep.file, sweep.function, sweep.x, sweep.y)


def document(library: Library, file: str, function: str, x: str, y: str) -> bytes:
    """The document of a function over two of its inputs.

    Raises NotFoundError for a function or an input that there is not, LightbenchError for one input
    on both axes, ShaderError for a file that cannot be assembled.
    """
    return _document(ById(library), sweep_of(library, file, function, x, y))


@lru_cache(maxsize=32)
def _document(library: ById, sweep: Sweep) -> bytes:
    return _Document(library.value, sweep).pack()


class _Document:
    """The arrays of one document, equal ones once."""

    def __init__(self, library: Library, sweep: Sweep) -> None:
        self.library, self.sweep = library, sweep
        self.exact = reference(library, sweep.file, sweep.function)
        self.places: dict[bytes, int] = {}
        self.length = 0

    def pack(self) -> bytes:
        text = json.dumps(self.header(), ensure_ascii=False, separators=(",", ":")).encode()
        text += b" " * (-(len(text) + 4) % ALIGNED)
        arrays = b"".join(raw + b"\0" * (-len(raw) % ALIGNED) for raw in self.places)
        return struct.pack("<I", len(text)) + text + arrays

    def header(self) -> dict[str, Any]:
        sweep = self.sweep
        values = points(sweep, SIZE)
        fixed = [i for i in sweep.inputs if i.name not in (sweep.x, sweep.y)]
        files = filter(None, (sweep.textbook, sweep.file))
        given = [(file, arguments(self.library, sweep, file, values)) for file in files]
        return {
            "file": sweep.file,
            "function": sweep.function,
            "title": self.library.files[sweep.file].meta.title or sweep.file,
            "note": sweep.note,
            "size": SIZE,
            "x": _axis(sweep.axis(sweep.x)),
            "y": _axis(sweep.axis(sweep.y)),
            "fixed": [asdict(each) for each in fixed],
            "forms": [self.form(*each, p) for p in PRECISIONS for each in given],
        }

    def form(self, file: str, given: Given, precision: Precision) -> dict[str, Any]:
        """One map: the program, what it reads, what is true (null: no exact form is known)."""
        prepared = prepare(
            self.library, file, self.sweep.function, given[0], given[1], half=precision.half
        )
        return {
            "file": file,
            "textbook": file == self.sweep.textbook,
            "precision": asdict(precision) | {"full": precision.full},
            "program": program(prepared, one_call(prepared)),
            "uniforms": _uniforms(prepared),
            "columns": [
                {"sampler": sampler(name)} | self.place(np.asarray(column, "<f4"))
                for name, column in prepared.columns.items()
            ],
            "components": prepared.components,
            "exact": self.truth(given),
        }

    def truth(self, given: Given) -> dict[str, Any] | None:
        if self.exact is None:
            return None
        first, settings = doubled(given)
        with np.errstate(all="ignore"):
            want = np.asarray(self.exact(*first, **settings), "<f8")
        return self.place(want.reshape(len(want), -1))

    def place(self, array: NDArray[Any]) -> dict[str, Any]:
        raw = array.tobytes()
        at = self.places.setdefault(raw, self.length)
        if at == self.length:
            self.length += len(raw) + -len(raw) % ALIGNED
        return {"at": at, "rows": array.shape[0], "components": array.shape[1]}


def _uniforms(prepared: Prepared) -> dict[str, list[float]]:
    """Parameters that are the same at every point."""
    read = (name for name in prepared.source.uniforms if name not in prepared.columns)
    known = {name: prepared.resolved.values.get(name.removeprefix("u_")) for name in read}
    return {
        name: [float(v) for v in (value if isinstance(value, tuple) else (value,))]
        for name, value in known.items()
        if value is not None
    }


def _axis(axis: Input) -> dict[str, Any]:
    return asdict(axis) | {"values": axis.samples(SIZE).tolist()}
