"""Settings: a flat {name: value} over the menu (`model`) and the scene (`camera.fov`)."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from lightbench.errors import SceneError, SettingError, shown
from lightbench.front_matter import Parameter
from lightbench.library import Library
from lightbench.materials import FIELDS
from lightbench.scene import Scene
from lightbench.scene_types import color
from lightbench.viewpoint import light_camera

__all__ = ["Resolved", "Setting", "resolve"]

Setting = float | int | bool | str | list[float] | tuple[float, ...] | None
Number = float | tuple[float, float, float]


@dataclass(frozen=True)
class Resolved:
    """A scene with its edits, one file for each choice setting, one value for each parameter."""

    scene: Scene
    choices: Mapping[str, str]
    values: Mapping[str, Number]


def resolve(library: Library, scene: Scene, given: Mapping[str, Setting]) -> Resolved:
    """Defaults of the menu, under the scene's own settings, under `given`.

    Raises SettingError for an unknown name or a value that is not allowed, saying what is, and
    SceneError for an edit that the scene refuses.
    """
    wanted = {**scene.settings, **given}
    edited = _edited(scene, {k: v for k, v in wanted.items() if "." in k})
    menu = {k: v for k, v in wanted.items() if "." not in k}
    choices = {
        folder.setting: _chosen(library, name, menu.pop(folder.setting, folder.default))
        for name, folder in library.folders.items()
    }
    edited = _from_light(edited)
    parameters = _parameters(library, _every_choice(library, choices, edited))
    _check_names(library, menu)
    values = {
        name: _value(name, parameter, menu.get(name, parameter.default))
        for name, parameter in parameters.items()
    }
    _check_lights(library, edited)
    return Resolved(edited, choices, values)


def _chosen(library: Library, folder: str, value: Setting) -> str:
    allowed = library.choices(folder)
    if value not in allowed:
        setting = library.folders[folder].setting
        raise SettingError(f"{setting}: no '{value}'; allowed are: {', '.join(allowed)}")
    return str(value)


def _from_light(scene: Scene) -> Scene:
    """The scene as its camera shows it: from a light, if it says so."""
    if scene.camera.light is None:
        return scene
    camera = light_camera(scene, scene.lights[scene.camera.light])
    return scene.model_copy(update={"camera": camera})


def _every_choice(
    library: Library, choices: Mapping[str, str], scene: Scene
) -> dict[str, set[str]]:
    """The choices in use by setting: the frame's, and those that materials make for themselves."""
    every = {setting: {choice} for setting, choice in choices.items()}
    own = {f.setting: name for name, f in library.folders.items() if f.per == "material"}
    for material, values in scene.materials.items():
        for setting, choice in (values.__pydantic_extra__ or {}).items():
            if setting not in own:
                raise SettingError(
                    f"materials.{material}.{setting}: no such field; beside its own fields a "
                    f"material may have: {', '.join(own)}"
                )
            every[setting].add(_chosen(library, own[setting], choice))
    return every


def _parameters(library: Library, choices: Mapping[str, set[str]]) -> dict[str, Parameter]:
    """The parameters of the chosen files, of passes and of lib."""
    found: dict[str, Parameter] = {}
    for path, file in library.files.items():
        folder, _, name = path.partition("/")
        if folder in library.folders:
            active = choices[library.folders[folder].setting]
            if name.removesuffix(".glsl") not in active:
                continue
        found.update(file.meta.parameters)
    return found


def _check_names(library: Library, menu: Mapping[str, Setting]) -> None:
    known = {name for file in library.files.values() for name in file.meta.parameters}
    for name in menu:
        if name not in known:
            settings = sorted([*known, *(f.setting for f in library.folders.values())])
            raise SettingError(
                f"no setting '{name}'; there is: {', '.join(settings)}, and the scene's own such "
                "as camera.fov, lights.NAME.intensity, materials.NAME.roughness"
            )


def _check_lights(library: Library, scene: Scene) -> None:
    known = {
        name: parameter
        for file in library.files.values()
        for name, parameter in file.meta.parameters.items()
        if parameter.per == "light"
    }
    for name, light in scene.lights.items():
        for extra, value in (light.__pydantic_extra__ or {}).items():
            if extra not in known:
                allowed = ", ".join([*type(light).model_fields, *sorted(known)])
                raise SceneError(f"lights.{name}.{extra}: no such field; allowed are: {allowed}")
            _value(f"lights.{name}.{extra}", known[extra], value)


def _value(name: str, parameter: Parameter, value: Setting) -> Number:
    if parameter.kind == "color":
        return _color(name, value)
    if parameter.kind == "bool":
        return float(_bool(name, value))
    low, high = parameter.range or (-math.inf, math.inf)
    whole = "a whole number" if parameter.kind == "int" else "a number"
    number = _number(value)
    if not low <= number <= high or (parameter.kind == "int" and number != int(number)):
        unit = f" {parameter.unit}" if parameter.unit else ""
        raise SettingError(f"{name}: {shown(value)} is not {whole} from {low:g} to {high:g}{unit}")
    return number + 0.0  # -0 becomes 0


def _number(value: Setting) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        return math.nan
    try:
        return float(value)
    except (ValueError, OverflowError):
        return math.nan


def _bool(name: str, value: Setting) -> bool:
    words = {"true": True, "1": True, "false": False, "0": False}
    if str(value).lower() not in words:
        raise SettingError(f"{name}: {shown(value)} is not true or false")
    return words[str(value).lower()]


def _color(name: str, value: Setting) -> tuple[float, float, float]:
    try:
        channels = color(value)
    except ValueError as error:
        raise SettingError(f"{name}: {error}") from None
    if not isinstance(channels, list | tuple) or len(channels) != 3:
        raise SettingError(
            f"{name}: {shown(value)} is no colour; write #rrggbb (sRGB) or r,g,b (linear)"
        )
    r, g, b = (_number(c) for c in channels)
    if not all(0 <= c <= 1e30 for c in (r, g, b)):
        raise SettingError(f"{name}: {shown(value)} has a channel that is negative or no number")
    return r, g, b


def _edited(scene: Scene, edits: Mapping[str, Setting]) -> Scene:
    """The scene with each `path.to.field` of `edits` replaced, validated anew."""
    if not edits:
        return scene
    data = scene.data()
    places = []
    for path, value in edits.items():
        *parents, last = path.split(".")
        at: Any = data
        for key in parents:
            at = at.get(key) if isinstance(at, dict) else None
        group = parents[0]
        depth = {"camera": 1, "lights": 2, "materials": 2, "objects": 2, "parts": 2}.get(group)
        if not isinstance(at, dict) or len(parents) != depth:
            raise SettingError(f"no setting '{path}'; {_known_paths(scene)}")
        if last not in at and group not in ("lights", "materials"):
            raise SettingError(f"no setting '{path}'; allowed here are: {', '.join(map(str, at))}")
        places.append((at, last, value))
    for at, last, value in places:
        if last == "library" and value not in (None, "auto"):
            for field in FIELDS:  # the new material's, where they are not edited too
                at.pop(field, None)
    for at, last, value in places:
        at[last] = value
    return Scene.parse(data, "settings")


def _known_paths(scene: Scene) -> str:
    groups: dict[str, Mapping[str, object]] = {
        "lights": scene.lights, "materials": scene.materials, "objects": scene.objects,
        "parts": scene.parts,
    }  # fmt: skip
    names = "; ".join(f"{group}: {', '.join(members)}" for group, members in groups.items())
    return f"the scene has camera; {names}"
