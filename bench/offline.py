"""Milliseconds per frame of the offline renderer: passes only, to their completion."""

import lightbench as lb
from bench.figures import Figure
from lightbench.library import read_library
from lightbench.paths import shaders_folder
from lightbench.plan import plan
from lightbench.render import on_gl_thread, renderer

__all__ = ["frames"]

WARM_UP = 5


def frames(
    scene: str, settings: dict[str, float | str], size: tuple[int, int], count: int
) -> Figure:
    """`count` frames of one plan, after a warm-up that compiles."""
    made = plan(read_library(shaders_folder()), lb.load(scene), settings, size)

    def run() -> list[float]:
        images = [renderer().run(made) for _ in range(WARM_UP + count)]
        return [image.milliseconds for image in images[WARM_UP:]]

    times = on_gl_thread(run)
    return Figure(str(settings.get("model")), size, times, on_gl_thread(lambda: renderer().name))
