"""The gamma of a display: least squares, the command, and the page's twin."""

import json
import math
import random
import subprocess
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from lightbench.cli import main
from lightbench.errors import LightbenchError
from lightbench.gamma import Measured, fit, table
from tests.support import ROOT

LEVELS = (0, 63, 127, 191, 255)
NAN, INF = float("nan"), float("inf")


def shone(gamma: float, white: float = 120.0, levels: Sequence[float] = LEVELS) -> list[Measured]:
    """What a display of that gamma shines with."""
    top = max(levels)
    return [(level, white * (level / top) ** gamma) for level in levels]


def rough(seed: int) -> list[Measured]:
    """Levels at random of a display with a black of its own, read to a few per cent."""
    chance = random.Random(seed)
    levels = sorted({*chance.sample(range(1, 255), chance.randint(1, 20)), 255})
    gamma, black = chance.uniform(0.5, 4.0), chance.uniform(0.0, 0.02)
    return [
        (level, 80 * (black + (level / 255) ** gamma) * chance.uniform(0.97, 1.03))
        for level in levels
    ]


def squares(gamma: float, measured: Sequence[Measured]) -> float:
    """The sum that the fit makes least, as the script says: luminance over its maximum."""
    x, y = np.array(measured).T
    return float(np.sum(((x / x.max()) ** gamma - y / y.max()) ** 2))


@pytest.mark.parametrize("gamma", [0.45, 1.0, 1.8, 2.2, 2.4, 4.0])
def test_a_display_of_a_known_gamma(gamma: float) -> None:
    """In any unit, in either scale, in any order."""
    shares = [level / 255 for level in LEVELS]
    for measured in (shone(gamma), shone(gamma, 1e-3), shone(gamma, 0.3, shares)):
        for order in (measured, measured[::-1], measured[1:]):
            found = fit(order)
            assert found.gamma == pytest.approx(gamma, rel=1e-12)
            assert found.residual < 1e-12
            assert list(found.levels) == sorted(level for level, _ in order)
    assert fit([(127, 9.0 * (127 / 255) ** gamma), (255, 9.0)]).gamma == pytest.approx(gamma)


@pytest.mark.parametrize("seed", range(20))
def test_nothing_near_is_better(seed: int) -> None:
    """The sum is flat there and rises to both sides; it is least of all on a grid."""
    measured = rough(seed)
    found = fit(measured)
    best = squares(found.gamma, measured)
    assert found.residual == pytest.approx(math.sqrt(best / len(measured)), rel=1e-12)
    for step in (1e-4, 1e-2):
        sides = [squares(found.gamma + way * step, measured) for way in (-1, 1)]
        assert min(sides) > best
        assert abs(sides[1] - sides[0]) < 0.2 * (sides[0] + sides[1] - 2 * best) + 1e-15
    assert best <= min(squares(g, measured) for g in np.linspace(0.1, 10.0, 2000)) + 1e-15


def test_it_is_not_the_fit_of_logarithms() -> None:
    """One dark level far off weighs little: it would weigh most in ln y."""
    measured = [*shone(2.2), (10, 120 * 0.02)]
    assert fit(measured).gamma == pytest.approx(2.2, abs=0.02)
    x, y = (np.log(np.array(sorted(measured))[1:-1] / [255, 120])).T
    assert abs(float(np.sum(x * y) / np.sum(x * x)) - 2.2) > 0.3


def test_half_of_white_by_eye() -> None:
    """A patch as bright as a dither of a share of white: gamma = log share / log x."""
    for share in (0.25, 0.5, 0.75):
        found = fit([(186, share), (255, 1.0)])
        assert found.gamma == pytest.approx(math.log(share) / math.log(186 / 255), rel=1e-12)


MISTAKES: list[tuple[list[Measured], str]] = [
    ([], "too few points: measure white, 255 (or 1), and at least one level between black and it"),
    ([(255, 3.0)], "too few points"),
    ([(0, 0.0), (255, 3.0)], "too few points"),
    ([(-1, 3.0), (255, 3.0)], "level -1: levels are 0 to 255, or 0 to 1"),
    ([(256, 3.0), (255, 3.0)], "level 256: levels"),
    ([(NAN, 3.0), (255, 3.0)], "level nan: levels"),
    ([(128, NAN), (255, 3.0)], "level 128: its luminance nan must be finite and not negative"),
    ([(128, INF), (255, 3.0)], "level 128: its luminance inf"),
    ([(128, -0.5), (255, 3.0)], "level 128: its luminance -0.5"),
    ([(128, 1.0), (128, 1.0), (255, 3.0)], "level 128 is measured more than once"),
    ([(64, 1.0), (128, 2.0)], "no luminance at the top: the highest level is 128; measure white"),
    ([(0.25, 1.0), (0.5, 2.0)], "no luminance at the top: the highest level is 0.5; measure white"),
    ([(64, 1.0), (255, 0.0)], "no luminance at the top: level 255 has 0"),
    ([(64, 0.0), (255, 0.0)], "every luminance is 0: there is no light to fit"),
    ([(0.5, 1.0), (255, 2.0)], "level 0.5: levels to 255 are whole numbers"),
    ([(128, 2.0), (255, 2.0)], "no power from 0.1 to 10 fits these luminances"),
    ([(128, 0.0), (255, 2.0)], "no power from 0.1 to 10 fits these luminances"),
]


@pytest.mark.parametrize(("measured", "message"), MISTAKES)
def test_what_is_no_measurement(measured: list[Measured], message: str) -> None:
    with pytest.raises(LightbenchError) as refused:
        fit(measured)
    assert str(refused.value).startswith(message)


def in_node(cases: Sequence[Sequence[Measured]]) -> list[dict[str, Any]]:
    """What the page's twin answers."""
    finite = [
        [[v if math.isfinite(v) else str(v).replace("inf", "Infinity").replace("nan", "NaN")
          for v in point] for point in case]
        for case in cases
    ]  # fmt: skip
    done = subprocess.run(
        ["node", "scripts/gammas.mjs"],
        cwd=ROOT / "web",
        input=json.dumps(finite),
        capture_output=True,
        text=True,
        check=True,
    )
    answers: list[dict[str, Any]] = json.loads(done.stdout)
    return answers


def test_the_page_fits_alike() -> None:
    cases = [*map(rough, range(60)), shone(2.4), shone(1.8, 1.0, (0.1, 0.5, 1.0))]
    for case, answer in zip(cases, in_node(cases), strict=True):
        ours, theirs = fit(case), answer["fit"]
        for name in ("gamma", "residual"):
            assert theirs[name] == pytest.approx(getattr(ours, name), rel=1e-9, abs=1e-12), case
        for name in ("levels", "x", "y"):
            assert theirs[name] == list(getattr(ours, name))


def test_the_page_refuses_alike() -> None:
    cases = [measured for measured, _ in MISTAKES]
    for case, answer in zip(cases, in_node(cases), strict=True):
        with pytest.raises(LightbenchError) as refused:
            fit(case)
        assert answer == {"error": ["LightbenchError", str(refused.value)]}


# The command


def lightbench(*arguments: str) -> int:
    with pytest.raises(SystemExit) as stop:
        main(["gamma", *arguments])
    assert isinstance(stop.value.code, int)
    return stop.value.code


def test_the_command_prints_a_table(capsys: pytest.CaptureFixture[str]) -> None:
    measured = shone(2.4)
    assert lightbench(*(f"{level}={luminance!r}" for level, luminance in measured)) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out == table(fit(measured)) + "\n"
    assert out.startswith("gamma 2.4000, ")
    _, second, head, *rows = out.splitlines()
    assert second.startswith("residual 0.00000")
    assert head.split() == ["level", "measured", "x^gamma", "off", "by", "x^(1/gamma)"]
    cells = [list(map(float, row.split())) for row in rows]
    assert [row[0] for row in cells] == list(LEVELS)
    for level, y, fitted, off, corrected in cells:
        assert y == fitted == pytest.approx((level / 255) ** 2.4, abs=6e-5)
        assert off == 0.0
        assert corrected == pytest.approx((level / 255) ** (1 / 2.4), abs=6e-5)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "too few points"),
        (["128"], "'128' is not LEVEL=LUMINANCE, such as 128=21.5"),
        (["128=1=2"], "'128=1=2' is not LEVEL=LUMINANCE"),
        (["dark=1"], "'dark=1' is not LEVEL=LUMINANCE"),
        (["-1=1", "255=2"], "level -1: levels are 0 to 255"),
        (["128=nan", "255=2"], "level 128: its luminance nan"),
    ],
)
def test_a_mistake_is_one_line(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert lightbench(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"lightbench: {message}")
    assert err.count("\n") == 1
