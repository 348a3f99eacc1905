"""The playground as static files: the built page and, under `data/`, all that it loads."""

import json
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from lightbench import assets, atlas_data, render_plan
from lightbench.errors import LightbenchError
from lightbench.library import Library, read_library
from lightbench.options import THUMB, manifest, preset, version
from lightbench.paths import scenes_folder, shaders_folder, web_folder
from lightbench.scene import Scene
from lightbench.scene_file import scene_names
from lightbench.shapes import ICOSPHERE_ERRORS, mesh, pack
from lightbench.tables import packed_hierarchy

__all__ = ["bake", "hierarchy_keys", "mesh_keys", "require_web"]

# Marks a folder as made here, so that it may be replaced.
MARK = "data/baked.json"


def bake(folder: Path) -> int:
    """Write the playground into `folder`, whole or not at all; returns the number of files.

    Raises LightbenchError for a folder that holds anything not made by this function, that cannot
    be written, or where the playground is not built.
    """
    folder = folder.resolve()
    web = require_web()
    _check_replaceable(folder)
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".lightbench-", dir=folder.parent) as scratch:
            made = Path(scratch) / "made"
            shutil.copytree(web, made)
            made.chmod(0o755)
            for name, data in _files(read_library(shaders_folder()), scenes_folder()):
                path = made / "data" / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(data)
            count = sum(1 for path in made.rglob("*") if path.is_file())
            _swap(made, folder, Path(scratch) / "old")
    except OSError as error:
        raise LightbenchError(f"{folder}: cannot be written: {error.strerror}") from None
    return count


def require_web() -> Path:
    """The built playground. Raises LightbenchError with the command that builds it."""
    web = web_folder()
    if not (web / "index.html").is_file():
        raise LightbenchError(
            "the playground is not built; in a checkout run: make web/dist/index.html"
        )
    return web


def mesh_keys(scenes: list[Scene]) -> list[str]:
    """Every mesh that the page may ask for: all spheres, these scenes' cones and models."""
    things = (thing for scene in scenes for thing in scene.objects.values())
    cones = {f"cone-{t.stacks}x{t.sectors}" for t in things if t.shape == "cone"}
    spheres = [f"icosphere-{level}" for level in range(len(ICOSPHERE_ERRORS))]
    return ["plane", "triangle", "cube", *spheres, *sorted(cones), *hierarchy_keys(scenes)]


def hierarchy_keys(scenes: list[Scene]) -> list[str]:
    """Every mesh that rays of the page may meet as one: those of models."""
    return sorted({asset.mesh for scene in scenes for asset in scene.meshes.values()})


def _files(library: Library, root: Path) -> Iterator[tuple[str, bytes]]:
    """(path below data/, content) of every file."""
    presets = {name: preset(name, root) for name in scene_names(root)}
    yield "baked.json", _json({"lightbench": version()})
    yield "manifest.json", _json(manifest(library, root))
    for name, scene in presets.items():
        yield f"scenes/{name}.json", _json(scene.data())
        yield f"thumbs/{name}.png", render_plan(scene, THUMB, {}).png()
    for key in mesh_keys(list(presets.values())):
        yield f"meshes/{key}.bin", pack(mesh(key))
    for key in hierarchy_keys(list(presets.values())):
        yield f"hierarchies/{key}.bin", packed_hierarchy(key)
    images = {texture.image for scene in presets.values() for texture in scene.textures.values()}
    for key in sorted(images):
        yield f"textures/{key}.png", assets.image(key)
    yield "atlas.json", _json(atlas_data.index(library))
    yield from atlas_data.documents(library)


def _json(data: object) -> bytes:
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).encode()


def _check_replaceable(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise LightbenchError(f"{folder}: is a file; name a folder")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / MARK).is_file():
        raise LightbenchError(
            f"{folder}: holds files that `bake` did not make; name an empty folder"
        )


def _swap(made: Path, folder: Path, old: Path) -> None:
    """Put `made` where `folder` is; what was there goes, or comes back if that fails."""
    if folder.exists():
        folder.rename(old)
    try:
        made.rename(folder)
    except OSError:
        with suppress(FileNotFoundError):
            old.rename(folder)
        raise
