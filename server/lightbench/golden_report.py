"""The report of golden comparisons: one HTML file that holds its pictures and asks for nothing."""

import base64
import io
from collections import Counter
from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path
from typing import Literal, TypedDict

import numpy as np
from numpy.typing import NDArray
from PIL import Image as Pillow

from lightbench.compare import (
    EXPOSURES,
    PIXELS_PER_DEGREE,
    RELMSE_EPSILON,
    Picture,
    codes,
    flip_map,
    linear,
)
from lightbench.errors import LightbenchError
from lightbench.image import write_whole

__all__ = ["Record", "html", "pictures", "write"]

# A difference is multiplied by this before it is shown.
AMPLIFIED = 8


class Record(TypedDict):
    """One comparison, as plain data that passes between processes.

    `metrics` and `limits` go by the metric's name; `pictures` maps a caption to a PNG in base64.
    """

    test: str
    path: str
    status: Literal["passed", "failed", "missing", "written"]
    message: str
    renderer: str
    metrics: dict[str, float]
    limits: dict[str, float]
    pictures: dict[str, str]


def pictures(actual: Picture, expected: Picture | None) -> dict[str, str]:
    """What the report shows of a comparison; of a missing golden, the picture alone."""
    if expected is None:
        return {"Actual": _png(codes(actual))}
    shown = {"Reference": _png(codes(expected)), "Actual": _png(codes(actual))}
    if actual.shape == expected.shape:
        kind = "codes" if actual.dtype == np.uint8 else "linear values"
        caption = f"Difference of {kind} × {AMPLIFIED}, clipped"
        shown[caption] = _png(_amplified(actual, expected))
        flip = flip_map(actual, expected, magma=True)
        shown["FLIP, black 0 to pale yellow 1"] = _png(np.round(flip * 255).astype(np.uint8))
    return shown


def _amplified(actual: Picture, expected: Picture) -> NDArray[np.uint8]:
    if actual.dtype == np.uint8:
        apart = np.abs(actual.astype(np.int64) - expected) * AMPLIFIED
        return np.asarray(np.minimum(apart, 255), np.uint8)
    return codes(np.abs(linear(actual) - linear(expected)) * AMPLIFIED)


def _png(picture: NDArray[np.uint8]) -> str:
    buffer = io.BytesIO()
    Pillow.fromarray(picture).save(buffer, "PNG")
    return base64.b64encode(buffer.getvalue()).decode()


def write(path: Path, records: Sequence[Record]) -> None:
    """Write the page whole, making its folder.

    Raises LightbenchError where it cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise LightbenchError(f"{path}: cannot be written: {error.strerror}") from None
    write_whole(path, html(records).encode())


def html(records: Sequence[Record]) -> str:
    """The page: what failed first, then what is new, then what passed."""
    order = {"failed": 0, "missing": 1, "written": 2, "passed": 3}
    ordered = sorted(records, key=lambda record: order[record["status"]])
    counts = Counter(record["status"] for record in ordered)
    summary = ", ".join(f"{count} {status}" for status, count in counts.items())
    body = "".join(_section(record) for record in ordered)
    return PAGE.format(
        summary=escape(summary or "no comparison"),
        body=body,
        degree=PIXELS_PER_DEGREE,
        exposures=EXPOSURES["numExposures"],
        low=EXPOSURES["startExposure"],
        high=EXPOSURES["stopExposure"],
        epsilon=RELMSE_EPSILON,
    )


def _section(record: Record) -> str:
    facts = {"test": record["test"], "golden": record["path"], "renderer": record["renderer"]}
    lines = "".join(f"<dt>{k}</dt><dd>{escape(v)}</dd>" for k, v in facts.items() if v)
    message = f"<pre>{escape(record['message'])}</pre>" if record["message"] else ""
    title = escape(record["path"].replace("\\", "/").rsplit("/", 1)[-1])
    status = record["status"]
    return (
        f'<section class="{status}"><h2><span class="status">{status}</span> {title}</h2>'
        f"<dl>{lines}</dl>{message}{_figures(record)}{_table(record)}</section>"
    )


def _figures(record: Record) -> str:
    figures = "".join(
        f"<figure><figcaption>{escape(caption)}</figcaption>"
        f'<img alt="{escape(caption)}" src="data:image/png;base64,{data}"></figure>'
        for caption, data in record["pictures"].items()
    )
    return f'<div class="pictures">{figures}</div>' if figures else ""


def _table(record: Record) -> str:
    if not record["metrics"]:
        return ""
    rows = "".join(_rows(record["metrics"], record["limits"]))
    return f"<table><tr><th>metric</th><th>value</th><th>limit</th></tr>{rows}</table>"


def _rows(metrics: dict[str, float], limits: dict[str, float]) -> Iterable[str]:
    for name, value in metrics.items():
        limit = limits.get(name)
        beyond = ' class="beyond"' if limit is not None and value > limit else ""
        shown = "" if limit is None else f"{limit:g}"
        yield f"<tr{beyond}><td>{escape(name)}</td><td>{value:.4g}</td><td>{shown}</td></tr>"


# Neutral grey around the pictures, so that nothing beside them shifts how they look.
PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Golden report: {summary}</title>
<style>
body {{ margin: 0; padding: 1.5rem; background: #777; color: #111; font: 15px/1.45 sans-serif }}
h1 {{ font-size: 1.4rem; margin: 0 0 1rem }}
h2 {{ font-size: 1.1rem; margin: 0 0 .5rem; overflow-wrap: anywhere }}
section {{ background: #808080; border: 1px solid #555; padding: 1rem; margin: 0 0 1.5rem }}
.status {{ background: #333; color: #eee; padding: .1rem .5rem; margin-right: .3rem }}
.failed .status, .missing .status {{ background: #6b0f0f; color: #fff }}
dl {{ display: grid; grid-template-columns: max-content 1fr; gap: 0 .8rem; margin: 0 0 .5rem }}
dd {{ margin: 0; overflow-wrap: anywhere }}
pre {{ white-space: pre-wrap; overflow-wrap: anywhere; margin: 0 0 .8rem; font: 13px monospace }}
.pictures {{ display: grid; gap: 1rem; margin: 0 0 1rem; align-items: end;
  grid-template-columns: repeat(auto-fill, minmax(min(280px, 100%), 1fr)) }}
figure {{ margin: 0 }}
figcaption {{ margin: 0 0 .25rem }}
img {{ display: block; width: 100%; image-rendering: pixelated }}
table {{ border-collapse: collapse }}
th, td {{ text-align: right; padding: .1rem .8rem .1rem 0; font-variant-numeric: tabular-nums }}
th:first-child, td:first-child {{ text-align: left }}
.beyond td {{ font-weight: bold; color: #6b0f0f; background: #a9a9a9 }}
</style>
<h1>Golden report: {summary}</h1>
{body}
<p>FLIP at {degree:g} pixels per degree; of linear pictures the worst of {exposures} exposures
from {low:+g} to {high:+g} stops. RMSE and relMSE = mean((I &minus; R)² / (R² + {epsilon:g})) are
of linear values, codes decoded as sRGB. Linear pictures are shown clipped to 0 to 1 and encoded as
sRGB.</p>
</html>
"""
