"""Half precision, emulated: a specialised source whose every named number is rounded to a half.

What a `mediump` variable may hold on a phone, made visible on any GPU, most of which compute
`mediump` in 32 bits. Each store is rounded: parameters as a function begins, initialisers,
assignments, results, and constants that are written as numbers. Inside an expression the arithmetic
stays float32, and so do matrices, arrays and the header of a `for`.
"""

import re
from collections.abc import Iterator

import numpy as np

__all__ = ["HALF", "halved"]

# Rounds its argument; what a half cannot hold is infinite.
HALF = "toHalf"
_PRELUDE = " ".join([
    f"float {HALF}(float x) {{ return unpackHalf2x16(packHalf2x16(vec2(x, 0.0))).x; }}",
    f"vec2 {HALF}(vec2 x) {{ return unpackHalf2x16(packHalf2x16(x)); }}",
    f"vec3 {HALF}(vec3 x) {{ return vec3({HALF}(x.xy), {HALF}(x.z)); }}",
    f"vec4 {HALF}(vec4 x) {{ return vec4({HALF}(x.xy), {HALF}(x.zw)); }}",
])  # fmt: skip
_FLOATS = ("float", "vec2", "vec3", "vec4")
_KIND = "|".join(_FLOATS)
_LARGEST = 65504.0

_FUNCTION = re.compile(r"\s*(?:(?:high|medium|low)p\s+)?(\w+)\s+\w+\s*\(([^()]*)\)\s*$")
_STRUCT = re.compile(r"\s*struct\s+(\w+)\s*$")
_FIELD = re.compile(r"(\w+)\s+(\w+)\s*$")
_CONTROL = re.compile(r"\s*(?:(else|do)\b|(if|for|while|switch)\s*(?=\())")
_RETURN = re.compile(r"(\s*)return\b[^\S\n]*(.+)$", re.DOTALL)
_DECLARATION = re.compile(
    r"(\s*)(const\s+)?((?:high|medium|low)p\s+)?(\w+)\s+(\w+\s*(?:[=,].*)?)$", re.DOTALL
)
_INITIALISER = re.compile(r"(\s*(\w+)\s*=)[^\S\n]*(.+)$", re.DOTALL)
_ASSIGNMENT = re.compile(
    r"(\s*)(([A-Za-z_]\w*)((?:\.\w+)*))\s*([-+*/]?)=(?!=)[^\S\n]*(.+)$", re.DOTALL
)
_LITERALS = re.compile(r"\s*(?:vec[234]\s*\()?[-+\d.eE\s,]+\)?\s*$")
_NUMBER = re.compile(r"(?<![\w.])(\d+\.\d*|\.\d+|\d+(?=[eE]))([eE][-+]?\d+)?")


def halved(text: str) -> str:
    """A specialised source with every named float and vector rounded to half precision.

    The lines stay where they are, so that a compile error still names its file and line.
    """
    lines = text.split("\n")
    first = max(i for i, line in enumerate(lines) if line.startswith("precision")) + 1
    # A macro among the code would be cut at its semicolons: it is set aside.
    macros = {f"/*{i}*/": line for i, line in enumerate(lines[first:]) if line.startswith("#")}
    marks = {line: mark for mark, line in macros.items()}
    code = _Halving().run("\n".join(marks.get(line, line) for line in lines[first:]))
    for mark, line in macros.items():
        code = code.replace(mark, line)
    head = lines[:first]
    head[-1] += f" {_PRELUDE}"
    return "\n".join([*head, code])


class _Halving:
    """One walk through the statements, knowing the types of what they name."""

    def __init__(self) -> None:
        self.structs: dict[str, dict[str, str]] = {}
        self.globals: dict[str, str] = {}
        self.names: dict[str, str] = {}
        self.returns = ""
        self.struct = ""
        self.depth = 0

    def run(self, code: str) -> str:
        return "".join(self.segment(text, end) for text, end in _segments(code))

    def segment(self, text: str, end: str) -> str:
        if end == "{":
            self.depth += 1
            return text + end + (self.opened(text) if self.depth == 1 else "")
        if end == "}":
            self.depth -= 1
            self.struct = self.struct if self.depth else ""
        if end == ";" and self.struct:
            if match := _FIELD.search(text):
                self.structs[self.struct][match[2]] = match[1]
        elif end == ";":
            return self.statement(text) + end
        return text + end

    def opened(self, text: str) -> str:
        """Note the struct or function that begins here; the rounding of a function's parameters."""
        if match := _STRUCT.search(text):
            self.struct = match[1]
            self.structs[self.struct] = {}
            return ""
        function = _FUNCTION.search(text)
        self.returns, given = (function[1], function[2]) if function else ("", "")
        self.names = dict(self.globals)
        rounded = []
        for words in (parameter.split() for parameter in given.split(",")):
            if len(words) < 2:
                continue
            kind, name = words[-2:]
            self.names[name] = kind
            if kind in _FLOATS and not {"const", "out", "inout"} & set(words):
                rounded.append(f" {name} = {HALF}({name});")
        return "".join(rounded)

    def statement(self, text: str) -> str:
        if not self.depth:
            return self.outside(text)
        prefix, rest = _after_control(text)
        if (match := _RETURN.match(rest)) and self.returns in _FLOATS:
            return f"{prefix}{match[1]}return {HALF}({match[2]})"
        if match := _ASSIGNMENT.match(rest):
            return prefix + self.assigned(rest, match)
        if (match := _DECLARATION.match(rest)) and match[4] != "return":
            return prefix + self.declared(rest, match)
        return text

    def assigned(self, text: str, match: re.Match[str]) -> str:
        space, target, base, path, operator, value = match.groups()
        kind = self.names.get(base, "")
        if path and kind in self.structs:
            kind = self.structs[kind].get(path.split(".")[1], "")
        if kind not in _FLOATS:
            return text
        value = f"{target} {operator} ({value})" if operator else value
        return f"{space}{target} = {HALF}({value})"

    def declared(self, text: str, match: re.Match[str]) -> str:
        space, _, precision, kind, rest = match.groups()
        parts = list(_split(rest))
        for part in parts:
            self.names[part.split("=")[0].strip()] = kind
        if kind not in _FLOATS:
            return text
        # No longer a constant expression, so no longer const.
        found = [(_INITIALISER.match(part), part) for part in parts]
        inside = ",".join(f"{m[1]} {HALF}({m[3]})" if m else part for m, part in found)
        return f"{space}{precision or ''}{kind} {inside}"

    def outside(self, text: str) -> str:
        """A global; a constant must stay a constant expression, so its numbers are rounded here."""
        match = _DECLARATION.match(text)
        if match is None:
            return text
        for part in _split(match[5]):
            self.globals[part.split("=")[0].strip()] = match[4]
        name, equals, value = text.partition("=")
        if match[4] in _FLOATS and equals and _LITERALS.match(value):
            return name + equals + _NUMBER.sub(_rounded, value)
        return text


def _segments(code: str) -> Iterator[tuple[str, str]]:
    """The code cut behind each `;`, `{` and `}` that stands in no brackets."""
    start = depth = 0
    for at, char in enumerate(code):
        depth += (char == "(") - (char == ")")
        if char in ";{}" and depth == 0:
            yield code[start:at], char
            start = at + 1
    yield code[start:], ""


def _after_control(text: str) -> tuple[str, str]:
    """A statement parted from the `if (...)`, `else`, `for (...)` before it."""
    at = 0
    while match := _CONTROL.match(text, at):
        at = match.end()
        if match[2]:
            at = _closing(text, at) + 1
    return text[:at], text[at:]


def _closing(text: str, start: int) -> int:
    """Where the bracket closes that opens at `start`."""
    depth = 0
    for at in range(start, len(text)):
        depth += (text[at] == "(") - (text[at] == ")")
        if depth == 0:
            return at
    return len(text)


def _split(text: str) -> Iterator[str]:
    """The parts between commas that stand in no brackets."""
    start = depth = 0
    for at, char in enumerate(text):
        depth += (char in "([") - (char in ")]")
        if char == "," and depth == 0:
            yield text[start:at]
            start = at + 1
    yield text[start:]


def _rounded(match: re.Match[str]) -> str:
    with np.errstate(over="ignore", under="ignore"):
        value = min(float(np.float16(float(match[0]))), _LARGEST)
    return repr(value)
