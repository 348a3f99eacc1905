"""How long one evaluation of a shader function takes on the GPU."""

import re
import time
from dataclasses import dataclass

import numpy as np

from lightbench.glsl import prepare
from lightbench.glsl_run import Draw, Prepared, drawing
from lightbench.library import Library
from lightbench.render import on_gl_thread, renderer
from lightbench.sweep_arguments import Given

__all__ = ["Duration", "nanoseconds"]

# Each draw repeats the call so often that it takes about this long.
SECONDS = 0.02
FIRST, MOST = 16, 100_000
REPEAT = "u_repeat"


@dataclass(frozen=True)
class Duration:
    """Nanoseconds per evaluation: the median of several runs, and the middle half of them."""

    median: float
    low: float
    high: float


def nanoseconds(library: Library, file: str, function: str, given: Given, runs: int) -> Duration:
    """Time a function over rows of arguments; all of the GPU at once, so less than one core takes.

    A draw calls it many times a pixel with arguments that differ a little each time, so that none
    is left out. What a loop takes that makes the arguments and adds them up instead is subtracted.
    """
    prepared = prepare(library, file, function, given[0], given[1])
    return on_gl_thread(_measured, prepared, runs)


def _measured(prepared: Prepared, runs: int) -> Duration:
    result = prepared.result([f"v{index}" for index in range(len(prepared.types))])
    bodies = _loop(prepared, result), _loop(prepared, f"vec4({_sum(prepared)})")
    with drawing(prepared, *bodies, uniforms=[REPEAT]) as ((full, empty), _):
        repeat = FIRST
        while (seconds := _seconds(full, repeat)) < SECONDS / 4.0 and repeat < MOST:
            repeat *= 4
        repeat = int(np.clip(repeat * SECONDS / seconds, FIRST, MOST))
        pairs = [(_seconds(full, repeat), _seconds(empty, repeat)) for _ in range(runs)]
    each = (np.array(pairs) @ [1.0, -1.0]) * 1e9 / (repeat * prepared.count)
    low, median, high = np.percentile(each, [25.0, 50.0, 75.0])
    return Duration(float(median), float(low), float(high))


def _seconds(draw: Draw, repeat: int) -> float:
    """Of one draw, to its completion."""
    context = renderer().context
    context.finish()
    start = time.perf_counter()
    draw({REPEAT: repeat})
    context.finish()
    return time.perf_counter() - start


def _loop(prepared: Prepared, value: str) -> list[str]:
    """A main that adds up `value`, of arguments v0, v1 and so on that shrink a little each time."""
    kinds = enumerate(prepared.types)
    numbers = [column[1:] for column in prepared.columns if column.startswith("a")]
    return [
        "  o_result = vec4(0.0);",
        f"  for (int i = 0; i < {REPEAT}; ++i) {{",
        "    float shrink = 1.0 - 1e-7 * float(i);",
        *(f"    {kind} v{index} = a{index};" for index, kind in kinds),
        *(f"    v{number} = a{number} * shrink;" for number in numbers),
        f"    o_result += {value};",
        "  }",
    ]


def _sum(prepared: Prepared) -> str:
    """All numbers of the arguments that the function's code names, added up."""
    terms = ["0.0"]
    read = _read(prepared)
    for column, array in prepared.columns.items():
        name, size = column[1:], array.shape[1]
        if column.startswith("a") and int(name.partition(".")[0]) in read:
            terms.append(f"dot(v{name}, vec{size}(1.0))" if size > 1 else f"v{name}")
    return " + ".join(terms)


def _read(prepared: Prepared) -> set[int]:
    """Positions of the arguments that the function reads: to make the others costs it nothing."""
    text = prepared.source.text
    head = re.search(rf"\b{prepared.function}\s*\(([^()]*)\)\s*\{{", text)
    assert head is not None
    body = text[head.end() : text.find("\n}", head.end())]
    names = [parameter.split()[-1] for parameter in head[1].split(",")]
    return {index for index, name in enumerate(names) if re.search(rf"\b{name}\b", body)}
