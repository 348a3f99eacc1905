"""4x4 matrices as flat column-major lists of float64, in the operation order of gl-matrix.

The browser's plan multiplies with gl-matrix; the same order here gives the same rounding.
"""

import math
from collections.abc import Sequence

__all__ = [
    "compose", "cos_sin", "cross", "dot", "look_at", "multiply", "normal_matrix", "normalize",
    "orthographic", "rotation", "square_perspective", "subtract", "transform",
    "translation",
]  # fmt: skip

Vector = Sequence[float]
# Sines are rounded to steps of 1/GRID: right angles are exact, and terms that cancel leave no
# noise, in which maths libraries differ.
GRID = 2.0**32


def multiply(a: Vector, b: Vector) -> list[float]:
    """The product a b."""
    out = []
    for column in range(4):
        b0, b1, b2, b3 = b[4 * column : 4 * column + 4]
        out += [b0 * a[r] + b1 * a[4 + r] + b2 * a[8 + r] + b3 * a[12 + r] for r in range(4)]
    return out


def normalize(v: Vector) -> tuple[float, float, float]:
    """The unit vector along v."""
    inverse = 1 / math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return v[0] * inverse, v[1] * inverse, v[2] * inverse


def cross(a: Vector, b: Vector) -> tuple[float, float, float]:
    """The vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def subtract(a: Vector, b: Vector) -> tuple[float, float, float]:
    """a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def dot(a: Vector, b: Vector) -> float:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cos_sin(degrees: float) -> tuple[float, float]:
    """Cosine and sine of an angle in degrees."""
    angle = degrees * math.pi / 180
    return _on_grid(math.cos(angle)), _on_grid(math.sin(angle))


def _on_grid(value: float) -> float:
    return math.floor(value * GRID + 0.5) / GRID


def rotation(degrees: Vector) -> list[float]:
    """3x3 rotation, column-major: about x first, then y, then z, angles in degrees."""
    (cx, sx), (cy, sy), (cz, sz) = map(cos_sin, degrees)
    return [
        cy * cz, cy * sz, -sy,
        sx * sy * cz - cx * sz, sx * sy * sz + cx * cz, sx * cy,
        cx * sy * cz + sx * sz, cx * sy * sz - sx * cz, cx * cy,
    ]  # fmt: skip


def compose(position: Vector, degrees: Vector, scale: Vector) -> list[float]:
    """Model matrix: scale, then rotate, then move."""
    r = rotation(degrees)
    columns = [[r[3 * i + j] * scale[i] for j in range(3)] + [0.0] for i in range(3)]
    return [*columns[0], *columns[1], *columns[2], *position, 1.0]


def normal_matrix(degrees: Vector, scale: Vector) -> list[float]:
    """3x3 inverse transpose of `compose`, column-major: rotation times 1/scale."""
    r = rotation(degrees)
    return [r[3 * i + j] / scale[i] for i in range(3) for j in range(3)]


def look_at(look: Vector, up: Vector) -> list[float]:
    """View matrix of an eye at the origin that looks along `look`: -z forward, +y up."""
    z = normalize((-look[0], -look[1], -look[2]))
    x = normalize(cross(up, z))
    y = cross(z, x)
    return [x[0], y[0], z[0], 0.0, x[1], y[1], z[1], 0.0, x[2], y[2], z[2], 0.0, 0.0, 0.0, 0.0, 1.0]


def square_perspective(tangent: float, near: float, far: float) -> list[float]:
    """OpenGL projection of a square view; `tangent` is that of half its angle."""
    inverse = 1 / (near - far)
    depth, shift = (far + near) * inverse, 2 * far * near * inverse
    f = 1 / tangent
    return [f, 0.0, 0.0, 0.0, 0.0, f, 0.0, 0.0, 0.0, 0.0, depth, -1.0, 0.0, 0.0, shift, 0.0]


def orthographic(height: float, aspect: float, near: float, far: float) -> list[float]:
    """OpenGL projection of a view `height` high, without perspective."""
    inverse = 1 / (near - far)
    depth, shift = 2 * inverse, (far + near) * inverse
    wide, high = 2 / (height * aspect), 2 / height
    return [wide, 0.0, 0.0, 0.0, 0.0, high, 0.0, 0.0, 0.0, 0.0, depth, 0.0, 0.0, 0.0, shift, 1.0]


def transform(m: Vector, point: Vector) -> tuple[float, float, float]:
    """The point moved by an affine matrix."""
    x, y, z = point
    return (
        m[0] * x + m[4] * y + m[8] * z + m[12],
        m[1] * x + m[5] * y + m[9] * z + m[13],
        m[2] * x + m[6] * y + m[10] * z + m[14],
    )


def translation(offset: Vector) -> list[float]:
    """The matrix that moves by an offset."""
    return [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, *offset, 1.0]
