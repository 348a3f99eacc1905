"""Names for a scene out of names in a file."""

import re
import unicodedata

__all__ = ["Names"]

LONGEST = 48


class Names:
    """Unique names of small letters, digits and underscores, each as near as can be to its own."""

    def __init__(self) -> None:
        self._taken: set[str] = set()
        self._counts: dict[str, int] = {}

    def new(self, *wanted: str, suffix: str = "") -> str:
        """A name from the first of `wanted` that has a letter or digit left; the last one must."""
        stem = next(filter(None, map(_plain, wanted))) + suffix
        name = stem
        while name in self._taken:
            self._counts[stem] = self._counts.get(stem, 1) + 1
            name = f"{stem}_{self._counts[stem]}"
        self._taken.add(name)
        return name


def _plain(text: str) -> str:
    ascii_text = unicodedata.normalize("NFKD", text[: 4 * LONGEST]).encode("ascii", "ignore")
    words = re.sub(r"[^a-z0-9]+", "_", ascii_text.decode().lower()).strip("_")[:LONGEST].strip("_")
    return words if not words[:1].isdigit() else f"n{words}"
