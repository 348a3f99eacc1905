"""What several tests share: folders of the checkout, the menu, image comparison."""

import contextlib
import io
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import lightbench as lb
from lightbench.image import Image
from lightbench.library import Library, read_library
from lightbench.plan import Plan, plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import scene_names
from lightbench.settings import Setting

ROOT = Path(__file__).parents[1]
SHADERS = ROOT / "shaders"
SCENES = ROOT / "scenes"
GOLDEN = Path(__file__).parent / "golden"
# What the golden images were rendered with: renderer and version.
PINNED = (GOLDEN / "RENDERER").read_text().splitlines()


def library() -> Library:
    """The menu of the checkout."""
    return read_library(SHADERS)


def presets() -> list[str]:
    """Every preset's name."""
    return scene_names(SCENES)


def alternatives() -> Iterator[dict[str, Setting]]:
    """Every choice of every folder once, all else at its default."""
    menu = library()
    for name, folder in menu.folders.items():
        for choice in menu.choices(name):
            yield {folder.setting: choice}


def planned(
    scene: str, settings: Mapping[str, Setting], size: tuple[int, int] = (64, 48)
) -> Plan:
    """The plan of a preset."""
    return plan(library(), lb.load(scene), settings, size)


def copy_of_shaders(folder: Path, files: Mapping[str, str]) -> Path:
    """A copy of `shaders/` in `folder` with `files` (path: text) dropped in."""
    target = folder / "shaders"
    shutil.copytree(SHADERS, target)
    for path, text in files.items():
        (target / path).write_text(text)
    return target


def driver() -> list[str]:
    """Renderer and version of the GL at hand."""
    return on_gl_thread(lambda: [renderer().name, renderer().version])


@dataclass(frozen=True)
class Difference:
    """How two 8-bit pictures (H, W, 3) differ."""

    largest: int
    share_above_one: float
    flip_mean: float
    flip_p99: float


def compare(actual: NDArray[np.uint8], expected: NDArray[np.uint8]) -> Difference:
    """Codes and FLIP (67 pixels per degree) between two pictures of one size."""
    codes = np.abs(actual.astype(int) - expected.astype(int)).max(axis=2)
    error_map = flip_map(actual, expected)
    return Difference(
        int(codes.max()),
        float((codes > 1).mean()),
        float(error_map.mean()),
        float(np.percentile(error_map, 99)),
    )


def flip_map(actual: NDArray[np.uint8], expected: NDArray[np.uint8]) -> NDArray[np.float32]:
    """FLIP error (H, W), 0 to 1; `actual` and `expected` are display codes (sRGB)."""
    import flip_evaluator

    with contextlib.redirect_stdout(io.StringIO()):
        error_map, _, _ = flip_evaluator.evaluate(
            expected.astype(np.float32) / 255,
            actual.astype(np.float32) / 255,
            "LDR",
            inputsRGB=True,
            applyMagma=False,
        )
    return np.asarray(error_map, np.float32).reshape(actual.shape[:2])


def assert_sound(image: Image) -> None:
    """No NaN, no infinity, nothing negative."""
    assert image.invalid().total == 0, image.invalid()
