"""Milliseconds per frame in Chromium, ours and three.js's in turn on the same backend."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

from fastapi import FastAPI
from fastapi.staticfiles import StaticFiles
from playwright.sync_api import Page, sync_playwright

from bench.figures import Figure
from bench.offline import Settings
from lightbench.api import create_app
from tests.browser import browsing, launched, serving

__all__ = ["AS_NEEDED", "Bench", "benching", "pages"]

FOLDER = Path(__file__).parent
ROUNDS = 4
MEASURE = "([scene, s, z, n]) => lightbench.measure(scene, s, z, n)"
# The sphere as fine as the picture needs; without it, at the level that three.js draws.
AS_NEEDED = " (detail as needed)"


class Bench:
    """Two pages of one browser, drawing the same room."""

    def __init__(self, ours: Page, three: Page) -> None:
        self.ours, self.three = ours, three

    def in_turn(
        self, scene: str, settings: Mapping[str, Settings], size: tuple[int, int], count: int
    ) -> list[Figure]:
        """`count` of our frames of each of some settings by name, in rounds."""
        times: dict[str, list[float]] = {name: [] for name in settings}
        ran_on = ""
        for _ in range(ROUNDS):
            for name, given in settings.items():
                answer = self.ours.evaluate(MEASURE, [scene, given, size, -(-count // ROUNDS)])
                times[name].extend(answer["milliseconds"])
                ran_on = answer["renderer"]
        return [Figure(name, size, values, ran_on, ROUNDS) for name, values in times.items()]

    def measure(
        self, models: list[str], materials: list[str], size: tuple[int, int], count: int
    ) -> list[Figure]:
        """Frames of each of our models and of each three.js material, interleaved in rounds."""
        times: dict[tuple[str, str], list[float]] = {}
        names: dict[str, str] = {}
        for _ in range(ROUNDS):
            for model in models:
                for label, extra in (("", {"subdivision": 5}), (AS_NEEDED, {})):
                    settings = {"model": model, **extra}
                    answer = self.ours.evaluate(
                        MEASURE, ["box-room", settings, list(size), count // ROUNDS]
                    )
                    names["ours"] = answer["renderer"]
                    times.setdefault(("ours", model + label), []).extend(answer["milliseconds"])
            for material in materials:
                answer = self.three.evaluate(
                    "([m, z, n]) => measure(m, z, n)", [material, list(size), count // ROUNDS]
                )
                names["three.js"] = answer["renderer"]
                times.setdefault(("three.js", material), []).extend(answer["milliseconds"])
        return [
            Figure(f"{who} {what}", size, values, names[who])
            for (who, what), values in times.items()
        ]


@contextmanager
def benching(backend: str) -> Iterator[Bench]:
    """Both pages, loaded and ready, in Chromium on `backend`."""
    app = FastAPI()
    app.mount("/bench", StaticFiles(directory=FOLDER, html=True))
    app.mount("/", create_app())
    with serving(app) as address, browsing(backend) as browser:
        ours, three = browser.new_page(), browser.new_page()
        ours.goto(f"{address}/")
        ours.evaluate("lightbench.ready")
        three.goto(f"{address}/bench/three/index.html")
        three.evaluate("ready")
        yield Bench(ours, three)


@contextmanager
def pages(backends: Iterable[str]) -> Iterator[dict[str, Page]]:
    """Our page in a Chromium of its own on each backend, all open at once."""
    with ExitStack() as stack:
        opened: dict[str, Page] = {}
        for backend in backends:
            if not opened:
                address = stack.enter_context(serving())
                playwright = stack.enter_context(sync_playwright())
            opened[backend] = stack.enter_context(launched(playwright, backend)).new_page()
            opened[backend].goto(f"{address}/")
            opened[backend].evaluate("lightbench.ready")
        yield opened
