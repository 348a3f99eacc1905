"""Table 5.1 of the thesis: what a frame of the box room costs under each model, beside ours.

Its numbers are means in ms on an Intel UHD 620, in a window of unknown size; so only the ratios to
Phong compare. As there, lights cast hard shadows with a constant bias from maps that are drawn only
when a light moves (its section 4.10.6), and the toon picture has its outlines.
"""

import statistics
from collections.abc import Sequence

from bench.figures import Figure
from bench.offline import Settings

__all__ = ["SETTINGS", "comparison"]

BASE = "phong"
THESIS = {"phong": 10.0, "blinn_phong": 9.5, "cook_torrance": 14.0, "toon": 10.5}
SHADOWS: Settings = {"shadow": "hard", "bias": "constant"}
SETTINGS: dict[str, Settings] = {
    model: {"model": model, **SHADOWS, "outline": "sobel" if model == "toon" else "none"}
    for model in THESIS
}


def comparison(title: str, figures: Sequence[Figure]) -> str:
    """A row a model: median and quartiles; the ratio to Phong and its range over the rounds."""
    base = next(figure for figure in figures if figure.what == BASE)
    lines = [title, ""]
    for figure in figures:
        (low, high), ratios = figure.spread, figure.ratios(base)
        lines.append(
            f"  {figure.what:<13}  {figure.size[0]:>4}x{figure.size[1]:<4}"
            f"  {figure.median:7.1f} ms  ({low:.1f} to {high:.1f})"
            f"  {statistics.median(ratios):5.2f} x  ({min(ratios):.2f} to {max(ratios):.2f})"
            f"  thesis {THESIS[figure.what]:4.1f} ms  {THESIS[figure.what] / THESIS[BASE]:.2f} x"
        )
    frames = f"{len(base.milliseconds)} frames in {base.rounds} rounds"
    return "\n".join([*lines, "", f"  {frames}; {base.renderer}", ""])
