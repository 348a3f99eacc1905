"""The gamma of a display from measured luminances: the power y = x^gamma nearest to them.

web/src/core/gamma.ts is this module's twin.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import LightbenchError, shown

__all__ = ["Fit", "Measured", "fit", "table"]

Values = NDArray[np.float64]
# (level, luminance): what was sent to the display, and what it shone with.
Measured = tuple[float, float]

# No display is outside these.
LOWEST, HIGHEST = 0.1, 10.0
WHITE = 255.0
STEPS = 200
# Steps of float64 between two guesses that are taken for one.
SAME = 4 * 2.0**-52


@dataclass(frozen=True)
class Fit:
    """`gamma` of y = x^gamma, and the root mean square of x^gamma - y over all points.

    `levels` as given, rising; `x` the levels and `y` the luminances, each over its largest.
    """

    gamma: float
    residual: float
    levels: tuple[float, ...]
    x: tuple[float, ...]
    y: tuple[float, ...]


def fit(measured: Sequence[Measured]) -> Fit:
    """The gamma of luminances, in any unit, of levels 0 to 255 or 0 to 1, white among them.

    Luminances are divided by the largest (the lab script's normalisation). Nonlinear least squares
    on y itself, by Gauss-Newton steps within a bracket, from the line through ln y over ln x.
    Raises LightbenchError for what is no such measurement.
    """
    _check_points(measured)
    ordered = sorted(measured)
    top = _check_levels(ordered)
    levels, luminances = (np.array(column) for column in zip(*ordered, strict=True))
    x, y = levels / top, luminances / luminances.max()
    between = (x > 0.0) & (x < 1.0)
    gamma = _least(x[between], y[between])
    residual = math.sqrt(float(np.mean((x**gamma - y) ** 2)))
    return Fit(gamma, residual, *(tuple(map(float, column)) for column in (levels, x, y)))


def _check_points(measured: Sequence[Measured]) -> None:
    for level, luminance in measured:
        if not 0.0 <= level <= WHITE:
            raise LightbenchError(f"level {shown(level)}: levels are 0 to 255, or 0 to 1")
        if not 0.0 <= luminance < math.inf:
            raise LightbenchError(
                f"level {shown(level)}: its luminance {shown(luminance)} must be finite and not "
                "negative"
            )


def _check_levels(ordered: Sequence[Measured]) -> float:
    """The level of white."""
    levels = [level for level, _ in ordered]
    for level in levels:
        if levels.count(level) > 1:
            raise LightbenchError(f"level {shown(level)} is measured more than once")
    top = levels[-1] if levels else 0.0
    if len([level for level in levels if level > 0.0]) < 2:
        raise LightbenchError(
            "too few points: measure white, 255 (or 1), and at least one level between black and it"
        )
    if top not in (1.0, WHITE):
        raise LightbenchError(
            f"no luminance at the top: the highest level is {shown(top)}; measure white, 255 (or "
            "1), too"
        )
    for level in levels:
        if top == WHITE and level != math.floor(level):
            raise LightbenchError(f"level {shown(level)}: levels to 255 are whole numbers")
    if not any(luminance for _, luminance in ordered):
        raise LightbenchError("every luminance is 0: there is no light to fit")
    if ordered[-1][1] == 0.0:
        raise LightbenchError(f"no luminance at the top: level {shown(top)} has 0")
    return top


def _least(x: Values, y: Values) -> float:
    """Where the sum of (x^gamma - y)^2 is least, for x within 0 and 1."""

    def slope(gamma: float) -> tuple[float, float]:
        """Half of the sum's derivative, and of its second one by Gauss and Newton."""
        power = x**gamma
        change = power * logs
        return float(np.sum((power - y) * change)), float(np.sum(change * change))

    logs = np.log(x)
    low, high = LOWEST, HIGHEST
    if slope(low)[0] >= 0.0 or slope(high)[0] <= 0.0:
        raise LightbenchError("no power from 0.1 to 10 fits these luminances")
    gamma = min(max(_log_log(logs, y), low), high)
    for _ in range(STEPS):
        down, curvature = slope(gamma)
        low, high = (gamma, high) if down < 0.0 else (low, gamma)
        following = gamma - down / curvature
        if not low <= following <= high:
            following = 0.5 * (low + high)
        if abs(following - gamma) <= SAME * gamma:
            break
        gamma = following
    return gamma


def _log_log(logs: Values, y: Values) -> float:
    """Least squares of ln y = gamma ln x, where y is not 0."""
    lit = y > 0.0
    return float(np.sum(logs[lit] * np.log(y[lit])) / np.sum(logs[lit] ** 2))


def table(found: Fit) -> str:
    """The fit for a person: gamma, residual, and a line a level."""
    lines = [
        f"gamma {found.gamma:.4f}, by least squares of x^gamma on luminance over its largest",
        f"residual {found.residual:.5f}, root mean square; white is 1",
        f"{'level':>7}  {'measured':>8}  {'x^gamma':>8}  {'off by':>8}  {'x^(1/gamma)':>11}",
    ]
    for level, x, y in zip(found.levels, found.x, found.y, strict=True):
        fitted, corrected = x**found.gamma, x ** (1 / found.gamma)
        lines.append(
            f"{shown(level):>7}  {y:8.4f}  {fitted:8.4f}  {y - fitted:+8.4f}  {corrected:11.4f}"
        )
    return "\n".join(lines)
