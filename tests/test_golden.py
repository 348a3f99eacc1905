"""Golden images: presets and choices look as they did when someone looked at them.

Every preset in its own settings, and one room under every choice of every folder: what two presets
would show of a choice, one does.
"""

from typing import Any

import pytest

import lightbench as lb
from lightbench.golden import Golden
from lightbench.settings import Setting
from tests.support import GOLDEN, PINNED, assert_sound, driver, library, presets

SIZE = (320, 240)
ROOM = "box-room"
# On another rasteriser than the pinned one.
LOOSE: dict[str, Any] = {"max_share": 1e-3, "flip_mean": 0.02, "flip_p99": 0.05}
# Choices of a folder show only together with these.
WITH: dict[str, dict[str, Setting]] = {
    "bias": {"shadow": "hard", "shadow_resolution": 256},
    "outline": {"model": "toon"},
    "shadow": {"shadow_resolution": 512},
    "technique": {"shadow": "ray"},
}
# As do these views.
VIEWED: dict[str, dict[str, Setting]] = {
    "depth": {"depth_range": 8.0},
    "light_depth": {"depth_light": 1, "shadow_resolution": 256},
    "shadow": {"shadow": "pcf", "shadow_resolution": 512},
}
# Folders that another scene shows.
SHOWN_IN = {"mapping": "texture-compare"}
Case = tuple[str, dict[str, Setting]]


def cases() -> dict[str, Case]:
    """Every golden's name: preset and settings."""
    found: dict[str, Case] = {preset.replace("/", "."): (preset, {}) for preset in presets()}
    menu, own = library(), lb.load(ROOM).settings
    for name, folder in menu.folders.items():
        plain = "" if folder.setting in WITH else own.get(folder.setting, folder.default)
        for choice in (each for each in menu.choices(name) if each != plain):
            more = VIEWED.get(choice, {}) if folder.setting == "view" else WITH.get(folder.setting)
            settings = {**(more or {}), folder.setting: choice}
            scene = SHOWN_IN.get(folder.setting, ROOM)
            found[f"{scene}.{folder.setting}-{choice}"] = (scene, settings)
    return found


CASES = cases()


def test_the_rasteriser_is_the_pinned_one() -> None:
    """Goldens prove equality only on one rasteriser; a new one asks for new goldens."""
    assert driver() == PINNED


def test_every_golden_has_its_render() -> None:
    assert {path.name for path in GOLDEN.glob("*.png")} == {f"{name}.png" for name in CASES}


def test_goldens_are_small() -> None:
    """All of them in less than 6 MB, so that a clone stays quick."""
    assert sum(path.stat().st_size for path in GOLDEN.glob("*.png")) < 6_000_000


@pytest.mark.parametrize("name", CASES)
def test_golden(name: str, golden: Golden) -> None:
    preset, settings = CASES[name]
    image = lb.render(preset, SIZE, **settings)
    assert_sound(image)
    golden(image, name, **({} if driver() == PINNED else LOOSE))
