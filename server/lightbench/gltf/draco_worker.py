"""Decodes Draco data in a process of its own: whatever the data does, it does to this process.

On standard input comes a length (8 bytes, little-endian) and as many bytes, again and again until
the input ends: the number of attributes that are wanted (4 bytes), their unique ids (4 bytes each)
and Draco data. Each answer has a length before it too: a "-" with a reason, or a "+" with an .npz
of `faces` (T, 3) and an array (V, k) for each attribute found, named by its id.
"""

import contextlib
import io
import os
import sys
from typing import BinaryIO

# Of address space, for the decoder's and the libraries' own memory.
MEMORY = 4 << 30


def answer_to(request: bytes) -> bytes:
    """The answer to a request, without its length."""
    import DracoPy
    import numpy as np

    try:
        start = 4 + 4 * int.from_bytes(request[:4], "little")
        wanted = np.frombuffer(request[4:start], "<u4").tolist()
        mesh = DracoPy.decode(request[start:])
        ids = {a["unique_id"]: a for a in mesh.attributes}
        arrays = {str(i): np.asarray(ids[i]["data"]) for i in wanted if i in ids}
        file = io.BytesIO()
        np.savez(file, allow_pickle=False, faces=np.asarray(mesh.faces, np.int64), **arrays)
    except (
        DracoPy.FileTypeException, ArithmeticError, AttributeError, LookupError, MemoryError,
        RuntimeError, TypeError, ValueError,
    ) as error:  # fmt: skip
        return b"-" + (str(error) or type(error).__name__).encode()
    return b"+" + file.getvalue()


def serve(source: BinaryIO, target: BinaryIO) -> None:
    """Answer until the input ends."""
    while len(head := source.read(8)) == 8:
        answer = answer_to(source.read(int.from_bytes(head, "little")))
        target.write(len(answer).to_bytes(8, "little") + answer)
        target.flush()


def limit_memory() -> None:
    """Where the system can: more than that is an error here, not a burden to others."""
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, most))


if __name__ == "__main__":
    limit_memory()
    # What a library prints is no answer.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    serve(sys.stdin.buffer, answers)
