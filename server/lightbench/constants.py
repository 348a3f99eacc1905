"""Uniforms made constants: what a compiler knows, it folds.

web/src/core/constants.ts is this module's twin: same source and values, same text.
"""

import re
from collections.abc import Mapping, Sequence
from decimal import Decimal

from lightbench.assemble import UNIFORM

__all__ = ["with_constants"]


def with_constants(source: str, values: Mapping[str, Sequence[float]]) -> str:
    """A GLSL source with the uniforms that have a value here as constants, line for line.

    `values`: float32 by name, matrices column by column, as uniforms take them.
    """

    def made(match: re.Match[str]) -> str:
        kind, name = match.groups()
        if name not in values:
            return match[0]
        before = match[0][: match[0].index("uniform")]
        return f"{before}const {kind} {name} = {kind}({', '.join(map(_literal, values[name]))});"

    return UNIFORM.sub(made, source)


def _literal(value: float) -> str:
    """The shortest decimal that is this number: 2.5e-1."""
    return f"{Decimal(repr(float(value))).normalize():e}"
