"""The small expression language of `#if`, of a pass's `when` and of a target's `scale`.

Numbers, names, 'strings', `|| && == != < <= > >= + - * ! ( )` with C's precedence; a comparison
is 0 or 1.
"""

import re
from collections.abc import Callable, Mapping

from lightbench.errors import LightbenchError

__all__ = ["Value", "evaluate"]

Value = float | str

_TOKEN = re.compile(
    r"\s*(?:(?P<number>\d+\.?\d*|\.\d+)|(?P<name>[A-Za-z_]\w*)|'(?P<string>[^']*)'"
    r"|(?P<operator>\|\||&&|[=!<>]=|[<>!+\-*()]))"
)
_LEVELS = (("||",), ("&&",), ("==", "!="), ("<", "<=", ">", ">="), ("+", "-"), ("*",))
_NUMERIC: dict[str, Callable[[float, float], float]] = {
    "||": lambda a, b: float(bool(a) or bool(b)),
    "&&": lambda a, b: float(bool(a) and bool(b)),
    "<": lambda a, b: float(a < b),
    "<=": lambda a, b: float(a <= b),
    ">": lambda a, b: float(a > b),
    ">=": lambda a, b: float(a >= b),
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
}


def evaluate(text: str, names: Mapping[str, Value]) -> Value:
    """The value of `text` with `names` bound.

    Raises LightbenchError when the text does not parse, a name is not defined or a string is used
    as a number.
    """
    return _Parser(text, names).parse()


class _Parser:
    def __init__(self, text: str, names: Mapping[str, Value]) -> None:
        self.text, self.names = text, names
        self.tokens: list[tuple[str, str]] = []
        self.at = 0
        position, end = 0, len(text.rstrip())
        while position < end:
            match = _TOKEN.match(text, position)
            if match is None or match.lastgroup is None:
                raise LightbenchError(
                    f"'{text.strip()}' does not parse at '{text[position:].strip()}'"
                )
            self.tokens.append((match.lastgroup, match[match.lastgroup]))
            position = match.end()

    def parse(self) -> Value:
        value = self.binary(0)
        if self.at < len(self.tokens):
            raise self.unexpected()
        return value

    def unexpected(self) -> LightbenchError:
        found = f"'{self.tokens[self.at][1]}'" if self.at < len(self.tokens) else "its end"
        return LightbenchError(f"'{self.text.strip()}' does not parse at {found}")

    def accept(self, *operators: str) -> str | None:
        if self.at < len(self.tokens):
            kind, token = self.tokens[self.at]
            if kind == "operator" and token in operators:
                self.at += 1
                return token
        return None

    def binary(self, level: int) -> Value:
        if level == len(_LEVELS):
            return self.unary()
        left = self.binary(level + 1)
        while operator := self.accept(*_LEVELS[level]):
            left = self.apply(operator, left, self.binary(level + 1))
        return left

    def apply(self, operator: str, left: Value, right: Value) -> Value:
        if operator in ("==", "!="):
            return float((left == right) == (operator == "=="))
        return _NUMERIC[operator](self.number(left), self.number(right))

    def number(self, value: Value) -> float:
        if isinstance(value, str):
            raise LightbenchError(f"'{self.text.strip()}' uses the text '{value}' as a number")
        return value

    def unary(self) -> Value:
        if self.accept("!"):
            return float(not self.number(self.unary()))
        if self.accept("-"):
            return -self.number(self.unary())
        if self.accept("("):
            value = self.binary(0)
            if not self.accept(")"):
                raise self.unexpected()
            return value
        return self.primary()

    def primary(self) -> Value:
        if self.at >= len(self.tokens) or self.tokens[self.at][0] == "operator":
            raise self.unexpected()
        kind, token = self.tokens[self.at]
        self.at += 1
        if kind == "number":
            return float(token)
        if kind == "string":
            return token
        if token not in self.names:
            known = ", ".join(sorted(self.names))
            raise LightbenchError(f"'{token}' is not defined; defined are: {known}")
        return self.names[token]
