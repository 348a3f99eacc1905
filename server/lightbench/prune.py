"""Lines of an expanded source that do nothing, taken out."""

import re
from collections import Counter
from collections.abc import Collection

__all__ = ["live"]

# The text, its file and its line there.
Line = tuple[str, str, int]

_NAME = re.compile(r"[A-Za-z_]\w*")
_HANDED_ON = re.compile(r"\s*(?:out\s+\w+\s+(v_\w+)\s*;|(v_\w+)\s*=[^=].*;)$")
# A uniform, an input, a variable in place of one, or a value that is given a name in one line.
_NAMED = re.compile(
    r"\s*(?:(?:uniform|in)\s+(?:(?:high|medium|low)p\s+)?\w+\s+(\w+)\s*;"
    r"|\w+\s+(v_\w+)\s*;"
    r"|(?:const\s+)?[A-Za-z]\w*\s+(\w+)\s*=[^=][^;]*;)$"
)


def live(output: list[Line], stage: str, varyings: Collection[str]) -> list[Line]:
    """Without varyings that nobody takes in, and without names that nothing else mentions.

    `varyings` are those that the fragment stage takes in: the vertex stage hands on no others.
    """
    lines = [line for line in output if not _dropped(line[0], stage, varyings)]
    while True:
        mentions = Counter(name for text, _, _ in lines for name in _NAME.findall(text))
        dead = [
            line
            for line in lines
            if (m := _NAMED.match(line[0])) and mentions[m[1] or m[2] or m[3]] == 1
        ]
        if not dead:
            return lines
        lines = [line for line in lines if line not in dead]


def _dropped(text: str, stage: str, varyings: Collection[str]) -> bool:
    match = _HANDED_ON.match(text) if stage == "VERTEX" else None
    return match is not None and (match[1] or match[2]) not in varyings
