"""Times of rays as rates: a row a scene, and what a scene of more triangles costs."""

import math
import statistics
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from bench.works import Work

__all__ = ["Measure", "Row", "growth", "table"]

# Milliseconds of one round, by kind: "primary" and "shadow" rays, "both", and the whole "frame".
Costs = Mapping[str, float]
Measure = Callable[[], Costs]
# Those that are compared: shadow rays alone are a difference of two times.
KINDS = ("primary", "both")
# Columns of a rate with its quartiles, of a ratio and of a rate alone.
WIDE, NARROW, ALONE = 22, 8, 6


class Row(NamedTuple):
    """A work, and each round of each who did it."""

    work: Work
    rounds: Mapping[str, Sequence[Costs]]

    def milliseconds(self, who: str, kind: str) -> list[float]:
        """Of each round; empty where there was nothing of that kind to do."""
        return [costs[kind] for costs in self.rounds[who] if kind in costs]

    def rates(self, who: str, kind: str) -> list[float]:
        """Millions of rays a second: median and quartiles; infinite for no time at all."""
        work, found = self.work, self.milliseconds(who, kind)
        every = {"primary": work.primary, "shadow": work.shadow}
        rays = every.get(kind, work.primary + work.shadow)
        low, middle, high = statistics.quantiles(found, n=4)
        return [rays / ms / 1e3 if ms > 0 else math.inf for ms in (middle, high, low)]

    def ratio(self, who: str, peer: str, kind: str) -> float:
        """How many times the peer's rate `who` has: the median of the rounds."""
        pairs = zip(self.milliseconds(who, kind), self.milliseconds(peer, kind), strict=True)
        return statistics.median(other / own if own > 0 else math.inf for own, other in pairs)


def table(title: str, who: str, rows: Sequence[Row], peers: Sequence[str] = ()) -> str:
    """Rates of `who`, and how many times those of each peer they are."""
    name = max(len(row.work.name) for row in rows)
    over = [f"/ {peer.partition('_')[0]}".rjust(NARROW) for peer in peers]
    heads = [head for kind in KINDS for head in (kind.rjust(WIDE), *over)]
    last = [k for k in ("shadow", "frame") if any(row.milliseconds(who, k) for row in rows)]
    lines = [title, "", "  ".join([" " * (name + 2), *heads, *(k.rjust(ALONE) for k in last)])]
    for row in rows:
        cells = [cell for kind in KINDS for cell in _cells(row, who, kind, peers)]
        cells.extend(_alone(row, who, kind) for kind in last)
        lines.append("  ".join([f"  {row.work.name:<{name}}", *cells]).rstrip())
    return "\n".join([*lines, "", growth(who, rows), ""])


def _alone(row: Row, who: str, kind: str) -> str:
    rate = row.rates(who, kind)[0] if row.milliseconds(who, kind) else math.inf
    return f"{rate:.3g}".rjust(ALONE) if math.isfinite(rate) else " " * ALONE


def _cells(row: Row, who: str, kind: str, peers: Sequence[str]) -> list[str]:
    if not row.milliseconds(who, kind):
        return [" " * WIDE, *[" " * NARROW for _ in peers]]
    rate, low, high = row.rates(who, kind)
    ratios = [row.ratio(who, peer, kind) for peer in peers]
    spread = f"{rate:.3g} ({low:.3g} to {high:.3g})"
    return [spread.rjust(WIDE), *(f"{ratio:.2f} x".rjust(NARROW) for ratio in ratios)]


def growth(who: str, rows: Sequence[Row]) -> str:
    """How the time grows from the ball of fewest triangles to that of most, and the logarithm."""
    balls = sorted((r for r in rows if r.work.triangles), key=lambda r: r.work.triangles)
    small, large = balls[0], balls[-1]
    few, many = small.work.triangles, large.work.triangles
    parts = []
    for kind in KINDS:
        a, b = (statistics.median(row.milliseconds(who, kind)) for row in (small, large))
        parts.append(f"{kind} {a:.3g} to {b:.3g} ms ({b / a:.2f} x)" if a > 0 else f"{kind} 0 ms")
    log = math.log(many) / math.log(few)
    return f"  From {few} to {many} triangles: {', '.join(parts)}; the logarithm {log:.2f} x"
