"""The atlas for people: one HTML page that holds its pictures, and sheets of pictures beside it."""

import base64
import io
from collections.abc import Container, Iterator, Mapping, Sequence
from html import escape
from pathlib import Path

from PIL import Image as Pillow

from lightbench.atlas import PRECISIONS, Map, Panel
from lightbench.atlas_figure import INK, PAGE, legend, overview, stacked, strip
from lightbench.image import write_whole
from lightbench.options import version
from lightbench.render import on_gl_thread, renderer

__all__ = ["sentence", "write"]

STYLE = f"""
body {{ margin: 0 auto; max-width: 78rem; padding: 1.5rem; background: {PAGE}; color: {INK};
  font: 15px/1.5 system-ui, sans-serif; font-variant-numeric: tabular-nums; }}
img {{ display: block; max-width: 100%; height: auto; }}
figure img {{ max-width: calc(100vw - 3rem); }}
p {{ max-width: 52rem; }}
.maps {{ display: flex; flex-wrap: wrap; gap: 2rem 0; margin: 1.5rem 0; }}
figure {{ margin: 0; width: min-content; max-width: 100%; scroll-margin-top: 6rem; }}
figcaption {{ padding: 0 .7rem; }}
a {{ color: inherit; }}
table {{ border-collapse: collapse; }}
th, td {{ padding: .15rem .7rem; text-align: right; border-bottom: 1px solid #8a8a8a; }}
th:first-child, td:first-child, td:nth-child(2) {{ text-align: left; }}
.bad {{ font-weight: 700; }}
.legend {{ position: sticky; top: 0; background: {PAGE}; border-bottom: 1px solid #8a8a8a; }}
small {{ color: #2e2e2e; }}
"""
INTRODUCTION = """
Each point of a map is one call of a shader function on the GPU, compared with its exact form in
64 bits. The error counts in ULP, the step between neighbouring numbers: dark is as good as a number
of that precision can be, white has no correct digit left; magenta, yellow and cyan are no valid
values at all. Half precision is emulated: every named number of the code is rounded to 16 bits, as
a <code>mediump</code> variable of a phone may be. What a textbook prints stands before the form
that this project uses. An axis that begins with a band at 0 holds exactly that there."""
UNKNOWN = """
No exact form of it is known: float32 shows only what is no valid value, and half precision is
compared with float32."""


def write(maps: Sequence[Map], folder: Path) -> list[str]:
    """Write index.html and the PNG sheets, one a folder of shaders; the names of what was written.

    `textbook.png` has every textbook form above the form used here, where there is one.
    """
    folder.mkdir(parents=True, exist_ok=True)
    maps = sorted(maps, key=lambda each: not each.sweep.textbook)
    strips = {index: strip(each) for index, each in enumerate(maps) if _to_see(each)}
    scale, files = legend(), {}
    if any(each.sweep.textbook for each in maps):
        files["textbook.png"] = overview(maps)
    sheets: dict[str, list[bytes]] = {}
    for index, picture in strips.items():
        sheets.setdefault(maps[index].sweep.file.split("/")[0], []).append(picture)
    files |= {f"{name}.png": stacked([*own, scale]) for name, own in sheets.items()}
    files["index.html"] = _page(maps, strips, files.get("textbook.png"), scale).encode()
    for name, data in files.items():
        write_whole(folder / name, data)
    return list(files)


def _to_see(each: Map) -> bool:
    """Whether anything of a map is further off than a step of its numbers."""
    figures = [panel.summary() for panel in each.panels]
    return any(f["max_ulp"] > 1.0 or f["wrong"] for f in figures)


def sentence(each: Map) -> str:
    """What one sees on a map, in words."""
    if not each.exact:
        return " ".join(UNKNOWN.split())
    said = []
    for precision in PRECISIONS:
        ours = each.panel(each.sweep.file, precision.name)
        if not each.sweep.textbook:
            said.append(f"In {precision.name}: {_words(ours)}.")
            continue
        textbook = each.panel(each.sweep.textbook, precision.name)
        said.append(
            f"In {precision.name} the textbook form: {_words(textbook)}; ours: {_words(ours)}."
        )
    return " ".join(said)


def _words(panel: Panel) -> str:
    figures = panel.summary()
    kinds = [("NaN", "nan"), ("infinite", "inf"), ("negative", "negative")]
    shares = [(word, figures[key]) for word, key in kinds if figures[key]]
    invalid = ", ".join(f"{word} on {_percent(share)}" for word, share in shares)
    lost = figures["max_ulp"] >= panel.precision.full
    worst = "no correct digit left" if lost else f"{_ulp(figures['max_ulp'])} ULP off"
    if figures["wrong"] > sum(share for _, share in shares) + 1e-9:
        beside = f" ({invalid})" if invalid else ""
        share = _percent(figures["wrong"])
        return f"off by more than 1 % on {share} of the map{beside}, at worst {worst}"
    return f"{invalid} of the map, elsewhere at most {worst}" if invalid else f"at most {worst}"


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share >= 1e-4 else "single points"


def _ulp(value: float) -> str:
    if value < 0.01:
        return "0"
    return f"{value:.2g}" if value < 100 else f"{value:.0f}" if value < 1e5 else f"{value:.1g}"


def _image(picture: bytes, text: str) -> str:
    with Pillow.open(io.BytesIO(picture)) as opened:
        width, height = opened.size
    data = base64.b64encode(picture).decode()
    return (
        f'<img src="data:image/png;base64,{data}" width="{width}" height="{height}" '
        f'alt="{escape(text, quote=True)}">'
    )


def _page(
    maps: Sequence[Map], strips: Mapping[int, bytes], pairs: bytes | None, scale: bytes
) -> str:
    name, gl = on_gl_thread(lambda: (renderer().name, renderer().version))
    size = len(maps[0].panels[0].ulp)
    return "\n".join([
        '<!doctype html><html lang="en"><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>Lightbench: stability atlas</title><style>{STYLE}</style>",
        f"<h1>Stability atlas</h1><p>{INTRODUCTION}</p>",
        f"<p><small>Lightbench {escape(version())}; {escape(name)}, {escape(gl)}; "
        f"{size} × {size} points a map.</small></p>",
        *([f"<h2>Textbook forms, and ours</h2>{_image(pairs, PAIRS)}"] if pairs else []),
        "<h2>Every function</h2>", f"<p>{TABLE}</p>", *_table(maps, strips),
        f'<h2>Maps</h2><div class="legend">{_image(scale, SCALE)}</div>',
        '<div class="maps">', *(_figure(i, maps[i], own) for i, own in strips.items()), "</div>",
        "</html>\n",
    ])  # fmt: skip


PAIRS = "Heat maps of the error: textbook forms in the upper rows, the forms used here below"
SCALE = "From dark, at most 1 ULP, to white, no correct digit; magenta NaN, yellow infinite"


def _figure(index: int, each: Map, picture: bytes) -> str:
    fixed = [i for i in each.sweep.inputs if i.name not in (each.sweep.x, each.sweep.y)]
    beside = ", ".join(f"{i.label} {i.at:g}{i.unit if i.unit == '°' else ''}" for i in fixed)
    where = f"{each.sweep.file}; {beside}" if beside else each.sweep.file
    said = escape(f"{sentence(each)} {each.sweep.note}".strip()).replace(" %", "\u00a0%")
    return (
        f'<figure id="map-{index}">{_image(picture, f"{each.title}: {each.sweep.function}")}'
        f"<figcaption>{said} <small>{escape(where)}</small></figcaption></figure>"
    )


TABLE = """
Errors in ULP of the precision, and the share of the map that is off by more than 1 %. What has no
link is within 1 ULP everywhere, and is not drawn."""


def _table(maps: Sequence[Map], drawn: Container[int]) -> Iterator[str]:
    heads = [
        f"{p.name}: {text}" for p in PRECISIONS for text in ("median", "largest", ">\u00a01\u00a0%")
    ]
    yield "<table><tr><th>map</th><th>form</th>"
    yield "".join(f"<th>{head}</th>" for head in heads) + "</tr>"
    for index, each in enumerate(maps):
        for file in filter(None, (each.sweep.textbook, each.sweep.file)):
            form = "textbook" if file == each.sweep.textbook else ""
            cells = [_cells(each.panel(file, p.name)) for p in PRECISIONS]
            title = escape(f"{each.title}: {each.sweep.function}")
            title = f'<a href="#map-{index}">{title}</a>' if index in drawn else title
            axes = f"{each.sweep.axis(each.sweep.x).label} × {each.sweep.axis(each.sweep.y).label}"
            yield (
                f"<tr><td>{title} <small>{escape(axes)}</small></td>"
                f"<td>{form}</td>{''.join(cells)}</tr>"
            )
    yield "</table>"


def _cells(panel: Panel) -> str:
    figures = panel.summary()
    worst = figures["max_ulp"]
    lost = worst >= panel.precision.full
    wrong = (
        f'<td class="bad">{_percent(figures["wrong"])}</td>' if figures["wrong"] else "<td></td>"
    )
    return (
        f"<td>{_ulp(figures['median_ulp'])}</td>"
        f"<td>{'no digit' if lost else _ulp(worst)}</td>{wrong}"
    )
