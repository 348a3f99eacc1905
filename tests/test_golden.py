"""Golden images: every preset under every model looks as it did when someone looked at it."""

from typing import Any

import pytest

import lightbench as lb
from lightbench.golden import Golden
from tests.support import GOLDEN, PINNED, assert_sound, driver, library, presets

SIZE = (320, 240)
MODELS = library().choices("models")
# On another rasteriser than the pinned one.
LOOSE: dict[str, Any] = {"max_share": 1e-3, "flip_mean": 0.02, "flip_p99": 0.05}


def name_of(preset: str, model: str) -> str:
    return f"{preset.replace('/', '.')}.{model}"


def test_the_rasteriser_is_the_pinned_one() -> None:
    """Goldens prove equality only on one rasteriser; a new one asks for new goldens."""
    assert driver() == PINNED


def test_every_golden_has_its_render() -> None:
    expected = {f"{name_of(p, m)}.png" for p in presets() for m in MODELS}
    assert {path.name for path in GOLDEN.glob("*.png")} == expected


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("preset", presets())
def test_golden(preset: str, model: str, golden: Golden) -> None:
    image = lb.render(preset, SIZE, model=model)
    assert_sound(image)
    golden(image, name_of(preset, model), **({} if driver() == PINNED else LOOSE))
