"""Where flat parts lie in the picture: 3x3 matrices, flat and column-major, in float64.

web/src/core/parts.ts is this module's twin.
"""

from collections.abc import Mapping, Sequence

from lightbench.matrix import cos_sin
from lightbench.scene import Scene
from lightbench.scene_parts import Part
from lightbench.values import Values, float32

__all__ = [
    "multiply", "part_matrices", "part_records", "part_values", "rotation", "scaling",
    "translation",
]  # fmt: skip

Matrix = list[float]


def translation(offset: Sequence[float]) -> Matrix:
    """3x3: moves by (x, y)."""
    return [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, *offset, 1.0]


def scaling(factors: Sequence[float]) -> Matrix:
    """3x3: stretches along x and y."""
    return [factors[0], 0.0, 0.0, 0.0, factors[1], 0.0, 0.0, 0.0, 1.0]


def rotation(degrees: float) -> Matrix:
    """3x3: turns about (0, 0), from x towards y."""
    c, s = cos_sin(degrees)
    return [c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0]


def multiply(a: Sequence[float], b: Sequence[float]) -> Matrix:
    """The product a b, which does first what b does."""
    out = []
    for column in range(3):
        b0, b1, b2 = b[3 * column : 3 * column + 3]
        out += [b0 * a[r] + b1 * a[3 + r] + b2 * a[6 + r] for r in range(3)]
    return out


def part_matrices(parts: Mapping[str, Part]) -> dict[str, Matrix]:
    """From each part's own coordinates to the picture's: that of its frame, times its scaling."""
    frames: dict[str, Matrix] = {}
    for name in parts:
        waiting = [name]
        while (parent := parts[waiting[-1]].parent) is not None and parent not in frames:
            waiting.append(parent)
        for each in reversed(waiting):
            part = parts[each]
            own = multiply(translation(part.position), rotation(part.rotation))
            frames[each] = own if part.parent is None else multiply(frames[part.parent], own)
    return {name: multiply(frames[name], scaling(part.scale)) for name, part in parts.items()}


def part_records(scene: Scene) -> tuple[tuple[tuple[str, str], ...], ...]:
    """The records of PARTS: which part, of which shape."""
    return tuple(
        (("index", str(index)), ("shape", part.shape), ("square", str(int(part.shape == "square"))))
        for index, part in enumerate(scene.parts.values())
    )


def part_values(scene: Scene) -> Values:
    """Uniforms of every part."""
    found: Values = {}
    matrices = part_matrices(scene.parts)
    for index, (name, part) in enumerate(scene.parts.items()):
        own = {"matrix": matrices[name], "color": part.color, "width": [part.width]}
        found |= {f"u_part{index}_{key}": float32(value) for key, value in own.items()}
    return found
