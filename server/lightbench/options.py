"""What there is to choose: scenes and settings, as data for the service, the page and the CLI."""

from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as installed_version
from pathlib import Path
from typing import Any, get_args

from lightbench.errors import NotFoundError
from lightbench.front_matter import Choice, Parameter
from lightbench.library import Library
from lightbench.materials import materials
from lightbench.scene import Camera, Object, Scene
from lightbench.scene_file import read_scene, scene_names
from lightbench.scene_lights import Light
from lightbench.scene_parts import Part
from lightbench.scene_surfaces import Material

__all__ = ["THUMB", "listing", "manifest", "options", "preset", "scenes", "version"]

# Width and height of a preset's picture in the menu.
THUMB = (192, 144)
MENU_FIELDS = {
    "title", "about", "equation", "source", "domain", "unit", "breaks", "parameters", "textbook_of",
}  # fmt: skip


def version() -> str:
    """The installed version of Lightbench."""
    try:
        return installed_version("lightbench")
    except PackageNotFoundError:
        return "0+source"


def preset(name: str, root: Path) -> Scene:
    """A preset by its name alone, never by a path. Raises NotFoundError naming the presets."""
    names = scene_names(root)
    if name not in names:
        raise NotFoundError(f"no scene '{name}'; there is: {', '.join(names)}")
    return read_scene(name, root)


def scenes(root: Path) -> dict[str, dict[str, str]]:
    """Title and description of every preset by its name."""
    found = ((name, preset(name, root)) for name in scene_names(root))
    return {name: {"title": scene.title, "about": scene.about} for name, scene in found}


def manifest(library: Library, root: Path) -> dict[str, Any]:
    """All that the browser plans with: the library, the presets, the schema of a scene."""
    data = library.model_dump(mode="json")
    return data | {
        "scenes": scenes(root),
        "materials": _materials(),
        "schema": Scene.model_json_schema(),
    }


def _materials() -> dict[str, Any]:
    return {name: each.model_dump(mode="json") for name, each in materials().items()}


def options(library: Library) -> dict[str, Any]:
    """Every setting: choices with their parameters, other parameters, the scene's own fields.

    And the material library, whose names are values of `materials.NAME.library`.
    """
    return {
        "choices": {
            folder.setting: {
                "title": folder.title,
                "about": folder.about,
                "default": folder.default,
                "allowed": {
                    choice: _menu(library.files[f"{name}/{choice}.glsl"].meta)
                    for choice in library.choices(name)
                },
            }
            for name, folder in sorted(library.folders.items())
        },
        "parameters": {
            name: parameter.model_dump(mode="json") | {"file": path}
            for path, file in sorted(library.files.items())
            if path.split("/")[0] not in library.folders
            for name, parameter in file.meta.parameters.items()
        },
        "scene": _scene_settings(),
        "materials": _materials(),
    }


def _menu(meta: Choice) -> dict[str, Any]:
    return meta.model_dump(mode="json", include=MENU_FIELDS)


def _scene_settings() -> dict[str, list[str]]:
    """The fields of a scene that are settings too: `camera.fov`, `lights.NAME.intensity`."""
    kinds = get_args(get_args(Light)[0])
    lights = dict.fromkeys(field for kind in kinds for field in kind.model_fields)
    return {
        "camera": list(Camera.model_fields),
        "lights.NAME": list(lights),
        "materials.NAME": list(Material.model_fields),
        "objects.NAME": list(Object.model_fields),
        "parts.NAME": list(Part.model_fields),
    }


def listing(library: Library) -> str:
    """`options` for a person to read."""
    return "\n".join(_lines(library))


def _lines(library: Library) -> Iterator[str]:
    for folder, about in sorted(library.folders.items()):
        yield f"{about.setting}: {about.title} (default {about.default})"
        for name in library.choices(folder):
            meta = library.files[f"{folder}/{name}.glsl"].meta
            yield f"  {name:<30} {meta.title}"
            yield from (_line(key, value, 6) for key, value in meta.parameters.items())
        yield ""
    yield "any choice:"
    for path, file in sorted(library.files.items()):
        if path.split("/")[0] not in library.folders:
            yield from (_line(key, value, 2) for key, value in file.meta.parameters.items())
    yield ""
    yield "the scene's own:"
    yield from (
        f"  {group}.FIELD: {', '.join(known)}" for group, known in _scene_settings().items()
    )
    yield ""
    yield "materials.NAME.library:"
    yield from (f"  {name:<30} {each.title}" for name, each in materials().items())


def _line(name: str, parameter: Parameter, indent: int) -> str:
    kinds = {"bool": "true or false", "color": "#rrggbb or r,g,b", "int": "whole number, "}
    allowed = kinds.get(parameter.kind, "")
    if parameter.range:
        allowed += f"{parameter.range[0]:g} to {parameter.range[1]:g}"
    unit = f" {parameter.unit}" if parameter.unit else ""
    values = parameter.default if isinstance(parameter.default, tuple) else (parameter.default,)
    shown = ",".join(f"{v:g}" if isinstance(v, float) else str(v).lower() for v in values)
    per = ", also lights.NAME." + name if parameter.per == "light" else ""
    head = f"{' ' * indent}{name}"
    return f"{head:<32} {parameter.label or name}: {allowed}{unit}, default {shown}{per}"
