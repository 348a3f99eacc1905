"""Broken copies of a shader file: each differs from it by one small edit of its live code.

The edits are made from the tokens of the functions and constants, never by hand, so that a new
file gets its own: a sign, a factor, an exchanged argument, a dropped term, a constant, a
comparison, an exponent, min for max, a guard or a branch of `#if` turned over.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from lightbench.front_matter import ShaderFile

TOKEN = re.compile(
    r"(?P<directive>^[ \t]*\#[^\n]*)|(?P<space>[ \t]+|\n)"
    r"|(?P<number>(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<name>(?:[A-Za-z_]|@\{\w+\})(?:\w|@\{\w+\})*)"
    r"|(?P<sign>\+\+|--|<<|>>|[-+*/<>=!]=|&&|\|\||.)",
    re.MULTILINE,
)
KEYWORDS = ("return", "if", "for", "else", "while")
CONSTRUCTORS = ("float", "int", "vec2", "vec3", "vec4", "mat3", "ivec2", "bool")
# What a name is mistaken for: the other direction, the other end, the neighbour in the manual.
EXCHANGED = [
    ("l", "v"), ("r", "v"), ("NoL", "NoV"), ("cosLambdaL", "cosLambdaV"), ("kd", "ks"),
    ("min", "max"), ("any", "all"), ("isnan", "isinf"), ("exp", "exp2"), ("log", "log2"),
    ("inversesqrt", "sqrt"), ("lessThan", "greaterThan"), ("lessThanEqual", "lessThan"),
    ("xy", "yz"), ("xyz", "zxy"), ("z", "x"), ("x", "y"), ("rgb", "gbr"),
]  # fmt: skip
FLIPPED = {
    "<": (">", "<="), ">": ("<", ">="), "<=": (">=", "<"), ">=": ("<=", ">"), "==": ("!=",),
    "!=": ("==",), "&&": ("||",), "||": ("&&",), "<<": (">>",), ">>": ("<<",), "&": ("|",),
    "+=": ("-=", "="), "-=": ("+=", "="), "*=": ("/=", "="), "/=": ("*=", "="),
}  # fmt: skip
# Exchanging their arguments changes nothing: of clamp(), which is min(max(x, low), high), the first
# two.
COMMUTATIVE = ("min", "max", "dot", "distance", "halfVector", "clamp")
BOUNDS = ("min", "max", "clamp", "mix")
FACTORS = {"return": ("-1.0", "2.0", "0.25", "3.14159265"), "=": ("-1.0", "2.0")}
# What no factor changes.
NOTHING = ("0.0", "vec2(0.0)", "vec3(0.0)", "vec4(0.0)")


@dataclass(frozen=True)
class Mutant:
    """One broken file: its whole code, what kind of edit it is, and the place as it then reads."""

    path: str
    code: str
    kind: str
    place: str


@dataclass(frozen=True)
class Edit:
    """The characters from `start` to `end` replaced."""

    kind: str
    start: int
    end: int
    text: str


@dataclass(frozen=True)
class Token:
    """A word of the code and where it stands."""

    kind: str
    text: str
    start: int
    end: int


def mutants(path: str, file: ShaderFile) -> list[Mutant]:
    """Every mutant of a file, once each, in the order of their places."""
    code = Code(file.code)
    seen = {words(file.code)}
    found = []
    for edit in sorted(code.edits(), key=lambda e: (e.start, e.end, e.kind, e.text)):
        text = file.code[: edit.start] + edit.text + file.code[edit.end :]
        if words(text) not in seen:
            seen.add(words(text))
            found.append(Mutant(path, text, edit.kind, place(file, edit, text)))
    return found


def words(text: str) -> tuple[str, ...]:
    """The tokens, without the space between them."""
    return tuple(m[0].strip() for m in TOKEN.finditer(text) if m[0].strip())


def place(file: ShaderFile, edit: Edit, text: str) -> str:
    """Function and line of an edit, as the line reads after it."""
    line = file.code.count("\n", 0, edit.start) + 1
    owners = [
        name for first, name in sorted((n, f) for f, n in file.functions.items()) if first <= line
    ]
    begin = text.rfind("\n", 0, edit.start) + 1
    until = text.find("\n", edit.start + len(edit.text))
    shown = " ".join(text[begin : until if until >= 0 else None].split())
    return f"{owners[-1]}: {shown}" if owners else shown


class Code:
    """The tokens of a file, its brackets matched."""

    def __init__(self, text: str) -> None:
        self.text = text
        spans = [Token(str(m.lastgroup), m[0], *m.span()) for m in TOKEN.finditer(text)]
        self.directives = [t for t in spans if t.kind == "directive"]
        self.tokens = [t for t in spans if t.kind not in ("directive", "space")]
        self.mate: dict[int, int] = {}
        opened: list[int] = []
        for at, token in enumerate(self.tokens):
            if token.text in "([{":
                opened.append(at)
            elif token.text in ")]}":
                self.mate[at] = opened.pop()
                self.mate[self.mate[at]] = at
        self.live = list(self._live())

    def _live(self) -> Iterator[int]:
        """Tokens of function bodies and of the values of constants."""
        at = 0
        while at < len(self.tokens):
            if self.word(at) == "{" and self.word(at - 1) == ")":
                yield from range(at + 1, self.mate[at])
                at = self.mate[at]
            elif self.word(at) == "const":
                end = self.seek(at, ";")
                yield from range(self.seek(at, "=") + 1, end)
                at = end
            at += 1

    def word(self, at: int) -> str:
        return self.tokens[at].text if 0 <= at < len(self.tokens) else ""

    def seek(self, at: int, *ends: str) -> int:
        """The first of `ends` from here on that no bracket encloses."""
        while self.word(at) not in (*ends, ")", "]", "}", ""):
            at = self.mate[at] + 1 if self.word(at) in ("(", "[", "{") else at + 1
        return at

    def back(self, at: int, *ends: str) -> int:
        """The last of `ends` before here that no bracket encloses."""
        while self.word(at) not in (*ends, "(", "[", "{", ""):
            at = self.mate[at] - 1 if self.word(at) in (")", "]", "}") else at - 1
        return at

    # Operands

    def ends_operand(self, at: int) -> bool:
        token = self.tokens[at]
        return token.text in ")]" or (token.kind in ("number", "name") and not self.keyword(at))

    def keyword(self, at: int) -> bool:
        return self.word(at) in KEYWORDS

    def binary(self, at: int) -> bool:
        return self.word(at) in "+-*/" and self.ends_operand(at - 1)

    def after(self, at: int) -> int:
        """One past the operand that begins here."""
        while self.word(at) in ("-", "!"):
            at += 1
        at = self.mate[at] + 1 if self.word(at) == "(" else at + 1
        while self.word(at) in ("(", "[", "."):
            at = at + 2 if self.word(at) == "." else self.mate[at] + 1
        return at

    def before(self, at: int) -> int:
        """The first token of the operand that ends here."""
        if self.word(at) in (")", "]"):
            at = self.mate[at]
            named = self.tokens[at - 1].kind == "name" and not self.keyword(at - 1)
            at -= int(named)
        if self.word(at - 1) == ".":
            return self.before(at - 2)
        negated = self.word(at - 1) == "-" and not self.binary(at - 1)
        return at - int(negated)

    def term_after(self, at: int) -> int:
        """One past the product that begins here."""
        at = self.after(at)
        while self.word(at) in ("*", "/"):
            at = self.after(at + 1)
        return at

    def term_before(self, at: int) -> int:
        """The first token of the product that ends here."""
        at = self.before(at)
        while self.word(at - 1) in ("*", "/"):
            at = self.before(at - 2)
        return at

    # Edits

    def edit(self, kind: str, first: int, last: int, text: str) -> Edit:
        """The tokens from `first` to `last`, both included, replaced."""
        return Edit(kind, self.tokens[first].start, self.tokens[last].end, text)

    def source(self, first: int, last: int) -> str:
        return self.text[self.tokens[first].start : self.tokens[last].end]

    def edits(self) -> Iterator[Edit]:
        for at in self.live:
            token = self.tokens[at]
            if token.kind == "number":
                yield from self.of_number(at)
            elif token.kind == "name":
                yield from self.of_name(at)
            elif self.binary(at):
                yield from self.of_binary(at)
            else:
                yield from self.of_sign(at)
        for line in self.directives:
            match = re.match(r"[ \t]*#(?:el)?if (.*)", line.text)
            if match and match[1] not in ("VERTEX", "FRAGMENT"):
                start = line.start + match.start(1)
                yield Edit("branch", start, line.end, f"!({match[1]})")

    def of_number(self, at: int) -> Iterator[Edit]:
        text = self.word(at)
        if text.isdigit():
            for whole in (int(text) + 1, int(text) - 1):
                yield self.edit("constant", at, at, str(whole))
        else:
            value = float(text)
            for other in (value + 1.0, value * 2.0) if value else (1.0, 0.5, -1.0):
                if struct.pack("f", other) != struct.pack("f", value):
                    yield self.edit("constant", at, at, repr(other))

    def of_name(self, at: int) -> Iterator[Edit]:
        text = self.word(at)
        for one, other in EXCHANGED:
            if text in (one, other):
                yield self.edit("exchanged", at, at, other if text == one else one)
        if text == "return":
            yield from self.scaled(at)
        elif text == "if":
            yield self.edit("guard", at + 2, self.mate[at + 1] - 1, "false")
            condition = self.source(at + 1, self.mate[at + 1])
            yield self.edit("guard", at + 1, self.mate[at + 1], f"(!{condition})")
        elif self.word(at + 1) == "(" and not self.keyword(at):
            yield from self.of_call(at)

    def scaled(self, at: int) -> Iterator[Edit]:
        """What follows `return` or `=`, up to the end of its statement, times a factor."""
        first, end = at + 1, self.seek(at + 1, ";", ",")
        if self.word(end) == ";" and end > first:
            value = self.source(first, end - 1)
            for factor in FACTORS[self.word(at)] if value not in NOTHING else ():
                yield self.edit("factor", first, end - 1, f"{factor} * ({value})")

    def of_call(self, at: int) -> Iterator[Edit]:
        name, close = self.word(at), self.mate[at + 1]
        commas = [at + 1]
        while self.word(commas[-1]) != ")":
            commas.append(self.seek(commas[-1] + 1, ","))
        arguments = [self.source(a + 1, b - 1) for a, b in pairwise(commas) if b > a + 1]
        if name not in CONSTRUCTORS and (name in BOUNDS or len(arguments) == 1):
            for argument in arguments[:2]:
                yield self.edit("function left out", at, close, f"({argument})")
        if name not in COMMUTATIVE or name == "clamp":
            for i in range(int(name == "clamp"), len(arguments) - 1):
                text = f"{arguments[i + 1]}, {arguments[i]}"
                yield self.edit("exchanged", commas[i] + 1, commas[i + 2] - 1, text)

    def of_binary(self, at: int) -> Iterator[Edit]:
        text = self.word(at)
        other = {"+": "-", "-": "+", "*": "/", "/": "*"}[text]
        yield self.edit("sign" if text in "+-" else "exponent", at, at, other)
        if text in "+-":
            last, first = self.term_after(at + 1) - 1, self.term_before(at - 1)
        else:
            last, first = self.after(at + 1) - 1, self.before(at - 1)
        yield self.edit("term left out", at, last, "")
        if text == "-":
            yield self.edit("term left out", first, at - 1, "")
        elif text != "/":
            yield self.edit("term left out", first, at, "")

    def of_sign(self, at: int) -> Iterator[Edit]:
        text = self.word(at)
        for other in FLIPPED.get(text, ()):
            yield self.edit("comparison", at, at, other)
        if text in ("-", "!"):
            yield self.edit("sign", at, at, "")
        elif text == "=":
            yield from self.scaled(at)
        elif text == "?":
            first = self.back(at - 1, "=", "return", ",", ";") + 1
            yield self.edit("guard", first, at - 1, f"!({self.source(first, at - 1)})")
        elif text in ("+=", "-=", "*=", "/="):
            first = self.back(at - 1, ";", "}") + 1
            yield self.edit("term left out", first, self.seek(at, ";"), "")
