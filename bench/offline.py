"""Milliseconds per frame of the offline renderer: passes only, to their completion."""

from collections.abc import Mapping

import lightbench as lb
from bench.figures import Figure
from lightbench.library import read_library
from lightbench.paths import shaders_folder
from lightbench.plan import plan
from lightbench.plan_types import Plan
from lightbench.render import on_gl_thread, renderer

__all__ = ["frames", "in_turn", "linear_only", "times"]

Settings = Mapping[str, float | str]
WARM_UP = 5
ROUNDS = 8


def frames(scene: str, settings: Settings, size: tuple[int, int], count: int) -> Figure:
    """`count` frames of one plan, after a warm-up that compiles."""
    made = times(_planned(scene, settings, size), count)
    return Figure(str(settings.get("model")), size, made, on_gl_thread(lambda: renderer().name))


def in_turn(
    scene: str, settings: Mapping[str, Settings], size: tuple[int, int], count: int
) -> list[Figure]:
    """`count` frames of each of some settings by name, in rounds, so that all meet the same load.

    A map of a light that nothing moves is drawn once, in the warm-up.
    """
    plans = {name: _planned(scene, given, size) for name, given in settings.items()}
    found: dict[str, list[float]] = {name: [] for name in plans}
    for _ in range(ROUNDS):
        for name, made in plans.items():
            found[name].extend(times(made, -(-count // ROUNDS)))
    ran_on = on_gl_thread(lambda: renderer().name)
    return [Figure(name, size, values, ran_on, ROUNDS) for name, values in found.items()]


def _planned(scene: str, settings: Settings, size: tuple[int, int]) -> Plan:
    return plan(read_library(shaders_folder()), lb.load(scene), settings, size)


def times(made: Plan, count: int) -> list[float]:
    """Milliseconds of each frame after the warm-up."""

    def run() -> list[float]:
        images = [renderer().run(made) for _ in range(WARM_UP + count)]
        return [image.milliseconds for image in images[WARM_UP:]]

    return on_gl_thread(run)


def linear_only(whole: Plan) -> Plan:
    """The plan without the passes after its linear picture."""
    targets = [planned["target"] for planned in whole["passes"]]
    last = targets.index(whole["outputs"]["linear"])
    return {**whole, "passes": whole["passes"][: last + 1]}
