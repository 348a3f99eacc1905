"""Medians, spreads and the table that prints them."""

import statistics
from collections.abc import Sequence
from dataclasses import dataclass

__all__ = ["Figure", "table"]


@dataclass(frozen=True)
class Figure:
    """One measured thing: milliseconds of each frame, and what ran it.

    Of `rounds` in which several were measured in turn, each has as many frames.
    """

    what: str
    size: tuple[int, int]
    milliseconds: Sequence[float]
    renderer: str
    rounds: int = 1

    @property
    def median(self) -> float:
        """The middle frame."""
        return statistics.median(self.milliseconds)

    @property
    def spread(self) -> tuple[float, float]:
        """First and third quartile."""
        low, _, high = statistics.quantiles(self.milliseconds, n=4)
        return low, high

    def ratios(self, base: "Figure") -> list[float]:
        """The median of each round over the base's in the same round."""
        return [
            statistics.median(own) / statistics.median(other)
            for own, other in zip(self._each_round(), base._each_round(), strict=True)
        ]

    def _each_round(self) -> list[Sequence[float]]:
        count = len(self.milliseconds) // self.rounds
        return [self.milliseconds[i * count : (i + 1) * count] for i in range(self.rounds)]


def table(title: str, figures: Sequence[Figure], base: str = "") -> str:
    """Rows of median and quartiles; with `base`, each median as a ratio to the row of that name."""
    width = max(len(figure.what) for figure in figures)
    lines = [title, ""]
    bases = {figure.size: figure.median for figure in figures if figure.what == base}
    for figure in figures:
        low, high = figure.spread
        ratio = f"  {figure.median / bases[figure.size]:5.2f} x" if figure.size in bases else ""
        lines.append(
            f"  {figure.what:<{width}}  {figure.size[0]:>4}x{figure.size[1]:<4}"
            f"  {figure.median:7.1f} ms  ({low:.1f} to {high:.1f}){ratio}"
        )
    names = "; ".join(sorted({figure.renderer for figure in figures}))
    return "\n".join([*lines, "", f"  {len(figures[0].milliseconds)} frames; {names}", ""])
