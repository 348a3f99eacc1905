"""Scenes from files: the presets of a folder, a person's own, and what they refer to.

In a file a texture may name an image beside it, `"file": "textures/brick.png"`, and a scene a
model, `"model": "room.gltf"`, under which its own entries stand. Both end up in the asset store.
"""

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

from lightbench import assets
from lightbench.errors import ModelError, NotFoundError, SceneError
from lightbench.gltf import Limits, read_gltf
from lightbench.scene import Scene
from lightbench.texels import as_png, open_image

__all__ = ["MODELS", "model_scene", "read_scene", "scene_names"]

Data = dict[str, Any]
# Endings of the models that are read.
MODELS = (".glb", ".gltf")
# What a scene takes from its model entry by entry, and what only as a whole.
TABLES = ("textures", "meshes", "materials", "objects", "lights", "parts", "settings")
WHOLE = ("title", "about", "camera")


def scene_names(root: Path) -> list[str]:
    """Names of the presets in a folder of scenes, `lab/shadows` for one in a sub-folder."""
    return sorted(p.relative_to(root).with_suffix("").as_posix() for p in root.rglob("*.json"))


def read_scene(name: str, root: Path, limits: Limits | None = None) -> Scene:
    """A preset by name, a scene file by path, or a glTF model by path.

    Raises NotFoundError naming the presets, SceneError naming the offending field, ModelError
    naming the place in a model.
    """
    names = scene_names(root)
    if name in names:
        return _read_file(root / f"{name}.json", name, root.resolve())
    path = Path(name)
    if path.suffix.lower() in MODELS and path.is_file():
        return model_scene(path, limits)
    if path.suffix == ".json" and path.is_file():
        return _read_file(path, name, path.resolve().parent)
    raise NotFoundError(
        f"no scene '{name}'; there is: {', '.join(names)}, or a .json, .glb or .gltf file"
    )


def model_scene(
    source: Path | bytes, limits: Limits | None = None, name: str | None = None
) -> Scene:
    """The scene of a glTF model: of a file with its neighbours, or of bytes that stand alone.

    What comes as bytes may give way to later uploads. Raises ModelError.
    """
    shown = name or (source.name if isinstance(source, Path) else "model")
    keep = isinstance(source, Path)
    return Scene.parse(read_gltf(source, name=shown, limits=limits or Limits(), keep=keep), shown)


def _read_file(path: Path, name: str, root: Path) -> Scene:
    """A scene file; what it refers to must lie within `root`."""
    try:
        data = json.loads(path.read_text())
    except (OSError, ValueError, RecursionError) as error:
        raise SceneError(f"{name}: not a JSON file: {error}") from None
    if isinstance(data, dict):
        data = _with_textures(_with_model(data, name, path.parent, root), name, path.parent, root)
    return Scene.parse(data, name)


def _with_model(data: Data, name: str, folder: Path, root: Path) -> Data:
    if "model" not in data:
        return data
    path = _inside(data["model"], f"{name}: model", folder, root)
    stamps = tuple(p.stat().st_mtime_ns for p in (path, path.with_suffix(".bin")) if p.is_file())
    try:
        model: Data = json.loads(_model_json(path, stamps))
    except ModelError as error:
        raise SceneError(f"{name}: model: {error}") from None
    merged = {key: value for key, value in data.items() if key != "model"}
    for table in TABLES:
        own = data.get(table, {})
        merged[table] = {**model.get(table, {}), **own} if isinstance(own, dict) else own
    if "lights" in data:
        merged["lights"] = data["lights"]
        merged["settings"] = data.get("settings", {})
    return {key: model[key] for key in WHOLE if key in model} | merged


@lru_cache(maxsize=64)
def _model_json(path: Path, _stamps: tuple[int, ...]) -> str:
    """What a model's scene is, read once for each state of its files."""
    return json.dumps(read_gltf(path, name=path.name))


def _with_textures(data: Data, name: str, folder: Path, root: Path) -> Data:
    textures = data.get("textures")
    if not isinstance(textures, dict):
        return data
    made = {}
    for key, texture in textures.items():
        made[key] = texture
        if isinstance(texture, dict) and "file" in texture:
            path = _inside(texture["file"], f"{name}: textures.{key}.file", folder, root)
            rest = {field: value for field, value in texture.items() if field != "file"}
            stamp = path.stat().st_mtime_ns
            made[key] = rest | {"image": _image(path, stamp, f"{name}: textures.{key}.file")}
    return {**data, "textures": made}


@lru_cache(maxsize=256)
def _image(path: Path, _stamp: int, where: str) -> str:
    """The key of an image file, in the asset store as PNG."""
    try:
        with open_image(path.read_bytes()) as image:
            return assets.add_image(as_png(image), keep=True)
    except ValueError as error:
        raise SceneError(f"{where}: {error}") from None


def _inside(given: object, where: str, folder: Path, root: Path) -> Path:
    path = (folder / str(given)).resolve()
    if not isinstance(given, str) or not path.is_relative_to(root) or not path.is_file():
        raise SceneError(f"{where}: no file {given!r} beside the scene")
    return path
