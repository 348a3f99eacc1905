"""What an alternative form costs beside what it is off by: one table of all that compete."""

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from lightbench.exact import Array, reference
from lightbench.glsl import call
from lightbench.library import Library
from lightbench.options import version
from lightbench.render import on_gl_thread, renderer
from lightbench.stopwatch import Duration, nanoseconds
from lightbench.sweep import Input, sweep_of
from lightbench.sweep_arguments import arguments, doubled

__all__ = ["Form", "Group", "as_json", "compare", "groups", "table"]

ROWS = 2**16
# What a mean counts of an error at most, lest a single wrong point be all that it tells.
WHOLE = 1.0
# Values below this may be anything as small: no light that a picture could show.
NEGLIGIBLE = 1e-30


@dataclass(frozen=True)
class Group:
    """Forms of one thing, the exact one or the one used here first: files with one `function`."""

    title: str
    function: str
    files: tuple[str, ...]


@dataclass(frozen=True)
class Form:
    """One form measured. Errors are relative, `invalid` is the share that is NaN or infinite."""

    group: str
    title: str
    file: str
    function: str
    duration: Duration
    largest: float
    mean: float
    invalid: float


# Forms that differ in more than rounding. Beside these stand all textbook forms of the folders.
CHOICES = (
    Group(
        "G with Beckmann's Λ, exact and fitted", "masking",
        ("maskings/smith_beckmann_exact.glsl", "maskings/smith_beckmann.glsl"),
    ),
    Group(
        "G / (4 n·l n·v) of Smith and GGX", "visibility",
        ("maskings/smith_ggx.glsl", "maskings/smith_ggx_textbook.glsl",
         "maskings/smith_ggx_fast.glsl", "maskings/smith_ggx_uncorrelated.glsl"),
    ),
    Group(
        "F of glass, f0 = 0.04", "fresnel", ("fresnels/dielectric.glsl", "fresnels/schlick.glsl")
    ),
    Group("sRGB", "transfer", ("transfers/srgb_pow.glsl", "transfers/srgb.glsl")),
)  # fmt: skip


def groups(library: Library) -> list[Group]:
    """What is compared: of CHOICES what the folders have, and every textbook form with ours."""
    found = [
        Group(group.title, group.function, files)
        for group in CHOICES
        if len(files := tuple(f for f in group.files if f in library.files)) > 1
    ]
    known = {file for group in found for file in group.files}
    for path, file in library.files.items():
        ours = f"{path.rpartition('/')[0]}/{file.meta.textbook_of}.glsl"
        if file.meta.textbook_of and path not in known:
            shared = [name for name in library.files[ours].functions if name in file.functions]
            found.append(Group(library.files[ours].meta.title or ours, shared[0], (ours, path)))
    return found


def compare(library: Library, group: Group, runs: int) -> list[Form]:
    """Measure each form of a group against the exact form of the first."""
    sweep = sweep_of(library, group.files[0], group.function)
    values = {each.name: _drawn(each) for each in sweep.inputs}
    values |= {name: drawn(values) for name, drawn in LIKELY.items() if name in values}
    exact = reference(library, group.files[0], group.function)
    measured = []
    for file in group.files:
        given = arguments(library, sweep, file, values)
        duration = nanoseconds(library, file, group.function, given, runs)
        got = call(file, group.function, *given[0], settings=given[1]).astype(np.float64)
        first, settings = doubled(given)
        want = np.asarray(exact(*first, **settings)) if exact else got
        title = library.files[file].meta.title or file
        measured.append(
            Form(group.title, title, file, group.function, duration, *_error(got, want))
        )
    return measured


def _drawn(each: Input) -> Array:
    """Values of an input as the atlas sweeps it, at random; the same in every run."""
    random = np.random.default_rng(list(each.name.encode()))
    if each.log:
        return np.exp(random.uniform(np.log(each.low), np.log(each.high), ROWS))
    return random.uniform(each.low, each.high, ROWS)


def _uniform(name: str, low: float, high: float) -> Array:
    return np.random.default_rng([*name.encode(), 1]).uniform(low, high, ROWS)


def _seldom(values: Array) -> Array:
    """One value in 64 exactly 0, as a black pixel or a hard edge is."""
    return np.where(np.arange(ROWS) % 64 == 0, 0.0, values)


def _facet_angle(values: Mapping[str, Array]) -> Array:
    """Half vectors where the lobe of a width is: as GGX spreads them."""
    u = _uniform("theta_h", 0.0, 0.999)
    return np.degrees(np.arctan(values["alpha"] * np.sqrt(u / (1.0 - u))))


# How inputs fall in a picture, where that is not evenly over their range; in this order.
LIKELY: dict[str, Callable[[Mapping[str, Array]], Array]] = {
    "alpha": lambda _: _uniform("alpha", 1e-2, 1.0) ** 2,
    "theta_h": _facet_angle,
    "NoL": lambda _: _uniform("NoL", 1e-6, 1.0),
    "NoV": lambda _: _uniform("NoV", 1e-6, 1.0),
    "f0": lambda _: np.full(ROWS, 0.04),
    "level": lambda _: _seldom(np.exp(_uniform("level", -9.0, 3.0))),
    "L_white": lambda _: _uniform("L_white", 0.5, 20.0),
    "width": lambda _: _seldom(_uniform("width", 0.0, 0.5)),
    "distance": lambda _: np.exp(_uniform("distance", np.log(2.0), np.log(1e4))),
}


def _error(got: Array, want: Array) -> tuple[float, float, float]:
    """Largest and mean relative error where the value is finite, and the share where it is not."""
    want = np.broadcast_to(want, got.shape)
    finite = np.isfinite(got)
    got, want = got[finite], want[finite]
    size = np.maximum(np.abs(want), np.finfo(np.float32).tiny)
    seen = np.maximum(np.abs(want), np.abs(got)) >= NEGLIGIBLE
    relative = np.where(seen, np.abs(got - want) / size, 0.0)
    return (
        float(relative.max(initial=0.0)),
        float(np.minimum(relative, WHOLE).mean()) if relative.size else 0.0,
        float(1.0 - finite.mean()),
    )


def table(forms: Iterable[Form]) -> str:
    """The table for people, with what ran it."""
    return "\n".join(_lines(list(forms)))


def _lines(forms: list[Form]) -> Iterator[str]:
    yield on_gl_thread(lambda: f"{renderer().name}, {renderer().version}")
    yield (
        f"{'':<36}{'ns':>8}  {'middle half':<16}{'largest error':>14}{'mean error':>12}"
        f"{'not finite':>12}"
    )
    for group, own in itertools.groupby(forms, key=lambda form: form.group):
        yield f"\n{group}"
        for form in own:
            spread = f"{form.duration.low:.2f} to {form.duration.high:.2f}"
            yield (
                f"  {form.title:<34}{form.duration.median:>8.2f}  {spread:<16}"
                f"{_percent(form.largest):>14}{_percent(form.mean):>12}"
                f"{_percent(form.invalid) if form.invalid else '':>12}"
            )
    yield ""
    yield NOTE


NOTE = """\
ns per evaluation, the whole GPU at work; median of the runs and the middle half of them. Errors are
relative to the exact form in float64, over inputs as a picture has them; a mean counts no error as
more than 100 %."""


def _percent(value: float) -> str:
    return f"{100 * value:.2g} %" if value < 10.0 else f"{100 * value:.0e} %"


def as_json(forms: Iterable[Form]) -> dict[str, Any]:
    """The table for machines, with what ran it."""
    name, gl = on_gl_thread(lambda: (renderer().name, renderer().version))
    return {
        "lightbench": version(),
        "renderer": name,
        "opengl": gl,
        "rows": ROWS,
        "forms": [asdict(each) for each in forms],
    }
