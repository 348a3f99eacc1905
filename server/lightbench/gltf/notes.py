"""What a reader did otherwise than the file says."""

__all__ = ["Notes"]

# More lines than a person reads are counted.
SHOWN = 6


class Notes:
    """Lines for a person, once each, in the order in which they came up."""

    def __init__(self) -> None:
        self._lines: dict[str, None] = {}

    def add(self, line: str) -> None:
        """Note a line, unless it is noted."""
        self._lines.setdefault(line)

    def within(self, value: float, low: float, high: float, where: str) -> float:
        """The value, moved into low..high with a note."""
        moved = min(max(value, low), high)
        if moved != value:
            self.add(f"{where}: {value:g} was taken as {moved:g}")
        return moved

    def lines(self) -> list[str]:
        """The first lines, and how many more there are."""
        lines = list(self._lines)
        more = len(lines) - SHOWN
        return [*lines[:SHOWN], f"and {more} notes more"] if more > 0 else lines
