"""Millions of rays a second against the size of the scene, beside Mitsuba 3 on the same triangles.

Primary rays: those of the pass that traces a picture without shadows, which makes each ray, finds
what it meets and shades that by Lambert. Both: with those to the lamps, over the pass with shadows.
Shadow rays: over the time that it takes longer; none is given where that is lost in the noise.
Frame: both over a whole frame, with what displays it and, in a browser, with planning. Mitsuba
makes no picture: its rays are given, and it shades nothing.

Each round measures everybody in turn, so that all meet the same load.
"""

import argparse
import statistics
from collections.abc import Callable, Iterable

from playwright.sync_api import Page

from bench.browser import pages
from bench.mitsuba_rays import available, peer
from bench.offline import linear_only, times
from bench.rates import Costs, Measure, Row, table
from bench.works import Work, planned, settings, works
from lightbench.render import on_gl_thread, renderer
from tests.browser import BACKENDS

__all__ = ["report"]

SIZE = (512, 512)
ROUNDS = 5
FRAMES = 3
OFFLINE = "offline"
# Milliseconds of frames: with shadows or without, whole or up to the linear picture.
Time = Callable[[bool, bool], list[float]]


def costs(work: Work, time: Time) -> Costs:
    """Milliseconds of a work's rays; the shadow rays' are those that the picture takes longer."""
    shadows = work.shadow > 0
    bare = statistics.median(time(False, False))
    made = {"primary": bare, "frame": statistics.median(time(shadows, True))}
    if shadows:
        made["both"] = statistics.median(time(True, False))
        made["shadow"] = made["both"] - bare
    return made


def offline(work: Work) -> Measure:
    """What measures a work by the offline renderer."""
    plans = {shadows: planned(work.scene, work.size, shadows) for shadows in (False, True)}

    def time(shadows: bool, whole: bool) -> list[float]:
        made = plans[shadows]
        return times(made if whole else linear_only(made), FRAMES)

    return lambda: costs(work, time)


def in_page(page: Page) -> Callable[[Work], Measure]:
    """What measures a work in a browser."""

    def prepare(work: Work) -> Measure:
        def time(shadows: bool, whole: bool) -> list[float]:
            call = f"(given) => lightbench.{'measure' if whole else 'measureLinear'}(...given)"
            given = [work.scene.data(), settings(shadows), work.size, FRAMES]
            milliseconds: list[float] = page.evaluate(call, given)["milliseconds"]
            return milliseconds

        return lambda: costs(work, time)

    return prepare


def in_turn(work: Work, everybody: dict[str, Callable[[Work], Measure]], rounds: int) -> Row:
    """The rounds of one work; who needs to warm up does so first."""
    measures = {who: prepare(work) for who, prepare in everybody.items()}
    found: dict[str, list[Costs]] = {who: [] for who in measures}
    for _ in range(rounds):
        for who, measure in measures.items():
            found[who].append(measure())
    return Row(work, found)


def report(backends: Iterable[str], size: tuple[int, int] = SIZE, rounds: int = ROUNDS) -> str:
    """A table for the offline renderer, for each browser, and for each of Mitsuba's variants."""
    variants, missing = available()
    with pages(backends) as opened:
        browsers = {f"in Chromium on {backend}": in_page(page) for backend, page in opened.items()}
        peers = {variant: peer(variant) for variant in variants}
        everybody = {OFFLINE: offline, **browsers, **peers}
        rows = [in_turn(work, everybody, rounds) for work in works(size)]
    name = on_gl_thread(lambda: renderer().name)
    unit = "millions a second, median (quartiles)"
    over = "; / as many times Mitsuba 3's" if variants else ""
    return "\n".join([
        f"Rays of {size[0]}x{size[1]} pixels, {rounds} rounds; offline is {name}",
        *([missing] if missing else []),
        "",
        *(table(f"Rays {who}: {unit}{over}", who, rows, variants) for who in (OFFLINE, *browsers)),
        *(table(f"Rays of Mitsuba 3, {who}: {unit}", who, rows) for who in variants),
    ])  # fmt: skip


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m bench.rays")
    parser.add_argument("--offline", action="store_true", help="leave the browsers out")
    print(report(() if parser.parse_args().offline else BACKENDS))
