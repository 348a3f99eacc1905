"""Where shaders, scenes and the built playground lie: named by the caller, or the built-in ones."""

import os
from pathlib import Path

__all__ = ["materials_file", "scenes_folder", "shaders_folder", "web_folder"]


def shaders_folder() -> Path:
    """`LIGHTBENCH_SHADERS`, or the built-in shaders."""
    return _folder("LIGHTBENCH_SHADERS", "shaders")


def scenes_folder() -> Path:
    """`LIGHTBENCH_SCENES`, or the built-in scenes."""
    return _folder("LIGHTBENCH_SCENES", "scenes")


def materials_file() -> Path:
    """The material library of the folder of scenes, or the built-in one where it has none."""
    own = scenes_folder() / "materials.toml"
    return own if own.is_file() else _built_in("scenes") / "materials.toml"


def web_folder() -> Path:
    """The built playground; absent in a checkout where it was not built."""
    installed = Path(__file__).parent / "_data" / "web"
    return installed if installed.is_dir() else _checkout() / "web" / "dist"


def _folder(variable: str, name: str) -> Path:
    named = os.environ.get(variable)
    return Path(named) if named else _built_in(name)


def _built_in(name: str) -> Path:
    installed = Path(__file__).parent / "_data" / name
    return installed if installed.is_dir() else _checkout() / name


def _checkout() -> Path:
    return Path(__file__).parents[2]
