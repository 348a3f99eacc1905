"""A glTF 2.0 file read whole, or refused: its scene as JSON data, its assets in the store."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lightbench import assets
from lightbench.errors import ModelError
from lightbench.gltf.accessors import Accessors
from lightbench.gltf.buffers import Buffers
from lightbench.gltf.container import open_container
from lightbench.gltf.document import parse
from lightbench.gltf.framing import Sphere, View, around, camera_of, framed
from lightbench.gltf.geometry import GeometryReader
from lightbench.gltf.lights import three_lights, with_lights
from lightbench.gltf.limits import Budget, Limits
from lightbench.gltf.materials import Materials
from lightbench.gltf.nodes import placed, worlds
from lightbench.gltf.notes import Notes
from lightbench.gltf.objects import Objects
from lightbench.gltf.schema import Document
from lightbench.gltf.textures import Textures
from lightbench.mesh import Mesh

__all__ = ["read_gltf"]

Data = dict[str, Any]
DEFAULT_LIMITS = Limits()
LONGEST_NAME = 120
# Metres that a model may reach, so that a camera that has it all in sight stands within a scene's.
FARTHEST = 2e5
# As the scene "metals": highlights of metals burn out softly.
TONE: Data = {"tonemap": "reinhard_extended", "L_white": 4.0}
STUDIO_AMBIENT: Data = {"ambient_level": 0.2}
STUDIO_BACKGROUND = [0.02, 0.021, 0.024]


def read_gltf(
    source: Path | bytes, *, name: str, limits: Limits = DEFAULT_LIMITS, keep: bool = True
) -> dict[str, object]:
    """The JSON data of the scene in a glTF file, its meshes and images put into the asset store.

    `source` is the path of a .glb or .gltf, whose neighbours are read with it, or the bytes of one
    that stands alone; `name` is its name, for messages and the title. `keep` is as in
    `lightbench.assets`. Nothing is stored unless the whole file is good.

    Raises ModelError: one line with the file's name, the place in it and what is wrong there.
    """
    name = " ".join(name.split())[:LONGEST_NAME]
    try:
        return _read(source, name, Budget(limits), keep=keep)
    except ModelError as error:
        raise ModelError(f"{name}: {error}") from None
    except MemoryError:
        raise ModelError(f"{name}: takes more memory than there is") from None


def _read(source: Path | bytes, name: str, budget: Budget, *, keep: bool) -> Data:
    container = open_container(source, budget)
    document = parse(container.text, budget)
    buffers, notes = Buffers(document, container), Notes()
    accessors = Accessors(document, buffers, budget)
    accessors.check()
    textures = Textures(document, container, buffers, budget)
    materials = Materials(document, textures, notes)
    everywhere = worlds(document)
    places = placed(document, everywhere)
    reader = GeometryReader(document, buffers, accessors, budget)
    objects = Objects(document, reader, accessors, materials, everywhere, budget, notes)
    for place in places:
        if place.node.mesh is not None:
            objects.add(place)
    if not objects.entries:
        raise ModelError("scene: has no triangle to show")
    _note_what_is_ignored(document, notes)
    seen = around(objects.entries, objects.meshes)
    _check_reach(seen)
    view = camera_of(document, places, seen, notes) or framed(seen)
    lights = with_lights(document, places, budget, notes)
    scene: Data = {
        "title": _title(name),
        "about": _about(document, objects, notes),
        "camera": view.data,
        **_lighting(lights, view, seen),
        "materials": materials.entries,
        "objects": objects.entries,
    }
    return scene | _stored(textures, objects.meshes, keep=keep)


def _check_reach(seen: Sphere) -> None:
    reach = max(abs(float(c)) for c in seen.center) + seen.radius
    if reach > FARTHEST:
        raise ModelError(f"scene: reaches {reach:.3g} m; allowed are {FARTHEST:g} m")


def _note_what_is_ignored(document: Document, notes: Notes) -> None:
    if document.animations:
        notes.add("animations were left out")
    if any(p.targets for mesh in document.meshes for p in mesh.primitives):
        notes.add("morph targets were left out")


def _title(name: str) -> str:
    return Path(name).stem or name


def _about(document: Document, objects: Objects, notes: Notes) -> str:
    triangles = sum(len(objects.meshes[o["mesh"]].indices) for o in _things(objects.entries))
    count = len(objects.entries)
    whole = f"glTF model: {count} object{'s' * (count != 1)}, {triangles:,} triangles"
    rights = " ".join(document.asset.copyright.split())[:200]
    return "; ".join([whole, *filter(None, [rights]), *notes.lines()]) + "."


def _things(entries: Mapping[str, Data]) -> list[Data]:
    return list(entries.values())


def _lighting(lights: dict[str, Data], view: View, seen: Sphere) -> Data:
    """The file's lights with an exposure that suits them, or a studio's."""
    if lights:
        return {"lights": lights, "settings": TONE | {"exposure": _exposure(lights, seen)}}
    studio = three_lights(view.right, view.up, view.back)
    settings = TONE | STUDIO_AMBIENT
    return {"background": STUDIO_BACKGROUND, "lights": studio, "settings": settings}


def _exposure(lights: dict[str, Data], seen: Sphere) -> float:
    """Stops, 10 at most, that bring a white surface amid the model, lit by all, to radiance 1."""
    total = sum(_illuminance(light, seen) for light in lights.values())
    if total <= 0:
        return 0.0
    return round(min(max(math.log2(math.pi / total), -10.0), 10.0), 1)


def _illuminance(light: Data, seen: Sphere) -> float:
    """Lux at the model's middle, from no nearer than its surface."""
    brightness = float(max(light["color"]) * light["intensity"])
    if light["type"] == "directional":
        return brightness
    away = math.dist(light["position"], seen.center.tolist())
    distance = max(away, seen.radius, 1e-6)
    return brightness / distance**2


def _stored(textures: Textures, meshes: dict[str, Mesh], *, keep: bool) -> Data:
    """Textures and meshes with their assets' keys, which are added here."""
    keys = [assets.add_image(png, keep=keep) for png in textures.images]
    return {
        "textures": {
            name: entry | {"image": keys[entry["image"]]}
            for name, entry in textures.entries.items()
        },
        "meshes": {name: _asset(mesh, keep=keep) for name, mesh in meshes.items()},
    }


def _asset(mesh: Mesh, *, keep: bool) -> Data:
    return {
        "mesh": assets.add_mesh(mesh, keep=keep),
        "low": [float(c) for c in mesh.positions.min(axis=0)],
        "high": [float(c) for c in mesh.positions.max(axis=0)],
        "colors": mesh.colors is not None,
        "uv1": mesh.uvs1 is not None,
    }
