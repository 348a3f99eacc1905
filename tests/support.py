"""What several tests share: folders of the checkout, the menu, what a picture must be."""

import os
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path

import lightbench as lb
from lightbench.image import Image
from lightbench.library import Library, read_library
from lightbench.plan import plan
from lightbench.plan_types import Plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene_file import scene_names
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


def planned(scene: str, settings: Mapping[str, Setting], size: tuple[int, int] = (64, 48)) -> Plan:
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


def assert_sound(image: Image) -> None:
    """No NaN, no infinity, nothing negative."""
    assert image.invalid().total == 0, image.invalid()


def shared_models() -> Path:
    """The folder of sample models, `shared/models` beside the checkout or in LIGHTBENCH_SHARED."""
    return Path(os.environ.get("LIGHTBENCH_SHARED", ROOT.parent / "shared")) / "models"
