"""Compile logs of GL, with their positions turned into files of the shader folder."""

import re
from collections.abc import Sequence

__all__ = ["explain"]

_ERROR = re.compile(r"(?:ERROR:\s*)?\b0[:(](\d+)\)?(?:\(\d+\))?\s*:\s*(.*)")


def explain(log: str, text: str, lines: Sequence[str]) -> str:
    """A GL compile log with every position turned into `file:line` and its excerpt.

    `lines[i]` says where line i of the specialised `text` comes from, as `file:line`.
    """
    code = text.split("\n")
    found = []
    for raw in log.splitlines():
        match = _ERROR.search(raw)
        if match and 0 < int(match[1]) <= len(lines):
            at = int(match[1]) - 1
            found.append(f"{lines[at]}: {match[2].strip()}\n    {code[at].strip()}")
    return "\n".join(found) or log.strip()
