"""The tests tested: a shader broken in any small way is noticed by some formula, law or picture.

A few mutants of every file by default, the same ones in every run; all of them with --all-mutants.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import pytest

from lightbench.errors import ShaderError
from tests import functions
from tests.mutation_checks import FORMULAS, LAWS, PICTURES, Workbench
from tests.mutations import Mutant, mutants
from tests.support import library
from tests.survivors import EXPECTED_SURVIVORS

# At least so many mutants of a file that compile, and by default no more than that.
LEAST, FEW = 1, 2
GATE = 0.95
# Files that declare and compute nothing: broken, they do not compile.
DECLARATIONS = (
    "lib/light.glsl", "lib/material.glsl", "lib/receiver.glsl", "mappings/own.glsl",
    "stages/light_uniforms.glsl", "stages/varyings.glsl", "techniques/raster.glsl",
)  # fmt: skip
FILES = [path for path in library().files if path not in DECLARATIONS]
# What no test can call: pictures tell first.
DRAWN = [
    path
    for path in FILES
    if "main" in library().files[path].functions
    or path.startswith(("stages/", "views/"))
    or any(path == file for file, _ in functions.ELSEWHERE)
]


@dataclass
class Tally:
    """What became of the mutants so far: those noticed, those explained, and the others."""

    killed: int = 0
    known: int = 0
    missed: list[str] = field(default_factory=list)


@pytest.fixture(scope="module")
def tally() -> Tally:
    return Tally()


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Workbench:
    return Workbench(tmp_path_factory.mktemp("mutants"))


@pytest.fixture
def everything(request: pytest.FixtureRequest) -> bool:
    return bool(request.config.getoption("--all-mutants"))


def shuffled(path: str) -> list[Mutant]:
    """The mutants of a file, in an order that is its own."""
    found = mutants(path, library().files[path])
    return random.Random(path).sample(found, len(found))


def outcomes(
    bench: Workbench, path: str, everything: bool
) -> Iterator[tuple[Mutant, str | None, str | None]]:
    """(mutant, the check that fails, why none should) of those mutants that compile."""
    expected = EXPECTED_SURVIVORS.get(path, {})
    checks = [*FORMULAS, *LAWS]
    if everything:
        checks = [*PICTURES, *checks] if path in DRAWN else [*checks, *PICTURES]
    own = [check for check in FORMULAS if path in check.name]
    counted = 0
    for mutant in shuffled(path):
        why = expected.get(mutant.place)
        if not everything and counted >= FEW and why is None:
            continue
        try:
            # That a survivor survives the slow checks too is seen when all of them run.
            caught = bench.caught(mutant, checks if everything or why is None else own)
        except ShaderError:
            continue
        counted += why is None
        yield mutant, caught, why


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """By default the files whose functions a test can call: pictures take minutes a file."""
    if metafunc.function is test_a_broken_file_is_noticed:
        everything = metafunc.config.getoption("--all-mutants")
        metafunc.parametrize("path", FILES if everything else [f for f in FILES if f not in DRAWN])


def test_a_broken_file_is_noticed(
    path: str, bench: Workbench, tally: Tally, everything: bool
) -> None:
    stale, missed, killed = [], [], 0
    for mutant, caught, why in outcomes(bench, path, everything):
        killed += caught is not None
        tally.known += caught is None and why is not None
        if caught is None and why is None:
            missed.append(mutant.place)
        elif caught is not None and why is not None:
            stale.append(f"{mutant.place} (by {caught})")
    tally.killed += killed
    tally.missed += [f"{path}: {place}" for place in missed]
    assert not missed, f"nothing fails on these, so test them or explain them: {missed}"
    assert not stale, f"these are noticed, so they are no survivors: {stale}"
    assert killed >= LEAST


@pytest.mark.parametrize("path", list(EXPECTED_SURVIVORS))
def test_a_survivor_is_a_mutant(path: str) -> None:
    places = {mutant.place for mutant in mutants(path, library().files[path])}
    gone = [place for place in EXPECTED_SURVIVORS[path] if place not in places]
    assert not gone, f"the code has changed, and these are no mutants of it any more: {gone}"


def test_a_whole_file_is_not_noticed(bench: Workbench) -> None:
    """What the mutants are caught by is being broken, not being copied."""
    for path in ("distributions/ggx.glsl", "passes/forward.glsl", "lib/spot.glsl"):
        whole = Mutant(path, library().files[path].code, "none", "")
        checks = [check for check in FORMULAS if path in check.name]
        assert bench.caught(whole, [*checks, *PICTURES[:4]]) is None


def test_kill_rate(tally: Tally, note: Callable[[str], None], everything: bool) -> None:
    """Of all mutants that compile, the explained ones included; by default the sample has none of
    these, for they are looked at apart."""
    survivors = len(tally.missed) + (tally.known if everything else 0)
    count = tally.killed + survivors
    if not count:
        return  # none of the tests above was selected
    rate = tally.killed / count
    which = "all" if everything else f"{FEW} a file"
    note(f"mutants ({which}): {tally.killed} of {count} noticed, {rate:.1%}")
    note(f"survivors: {tally.known} explained in tests/survivors.py, {len(tally.missed)} not")
    for place in tally.missed:
        note(f"  {place}")
    assert rate >= GATE
