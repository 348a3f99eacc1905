"""GLSL signatures, and whether a file defines what its folder promises."""

import re
from collections.abc import Sequence

from lightbench.errors import LightbenchError, ShaderError

__all__ = ["argument_types", "check_contract", "same_arguments"]

_FUNCTION = re.compile(r"^[ \t]*(\w+)\s+(\w+)\s*\(([^()]*)\)\s*\{", re.MULTILINE)


def _signature(text: str) -> tuple[str, str, tuple[str, ...]]:
    """(return type, name, argument types) of a GLSL signature."""
    match = re.fullmatch(r"\s*(\w+)\s+(\w+)\s*\(([^()]*)\)\s*", text)
    if match is None:
        raise LightbenchError(f"'{text}' is no GLSL signature")
    return match[1], match[2], argument_types(match[3])


def argument_types(arguments: str) -> tuple[str, ...]:
    """The types of a GLSL argument list, qualifiers left out."""
    words = [[w for w in a.split() if w not in ("in", "const")] for a in arguments.split(",")]
    return tuple(w[0] for w in words if w and w != ["void"])


def same_arguments(promised: str, optional: Sequence[str]) -> list[str]:
    """Names of the functions of a folder that take what the one it promises ("": none) takes."""
    if not promised:
        return []
    wanted = _signature(promised)[2]
    return [name for _, name, types in map(_signature, (promised, *optional)) if types == wanted]


def check_contract(name: str, code: str, promised: str, optional: Sequence[str]) -> dict[str, int]:
    """Line of every function that the file defines, once its folder's contract is seen to hold.

    The file must define the signature `promised` ("" for none) and may define those of `optional`.
    """
    found: dict[str, int] = {}
    types: dict[str, tuple[str, str, tuple[str, ...]]] = {}
    for match in _FUNCTION.finditer(code):
        if match[1] not in ("else", "return"):
            found[match[2]] = code[: match.start(2)].count("\n") + 1
            types[match[2]] = (match[1], match[2], argument_types(match[3]))
    for text in filter(None, (promised, *optional)):
        wanted = _signature(text)
        if wanted[1] not in found and text == promised:
            raise ShaderError(f"{name}:1: the file must define {text}")
        if wanted[1] in found and types[wanted[1]] != wanted:
            raise ShaderError(f"{name}:{found[wanted[1]]}: {wanted[1]} must be {text}")
    return found
