"""A small glTF 2.0 writer: nodes, shared models, materials with texture files, one binary."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from scenes.making.noise import Floats
from scenes.making.solids import Mesh, Point, join

__all__ = ["Matter", "Model", "Node", "Part", "write"]

Json = dict[str, Any]
# A mesh and the name of its material.
Part = tuple[str, Mesh]
FLOAT, USHORT, UINT = 5126, 5123, 5125
VERTICES, INDICES = 34962, 34963
REPEAT, CLAMP, LINEAR, TRILINEAR = 10497, 33071, 9729, 9987


@dataclass(frozen=True)
class Matter:
    """A material: a tint (linear RGB) over the maps of a texture set, or a plain one.

    `texture` names a set of `textures/`; without one, `roughness` and `metalness` hold alone.
    `emissive` is radiance per channel. `clamp` is for a picture that does not repeat.
    """

    tint: tuple[float, float, float] = (1, 1, 1)
    texture: str = ""
    roughness: float = 1.0
    metalness: float = 0.0
    emissive: tuple[float, float, float] | None = None
    double_sided: bool = False
    clamp: bool = False


@dataclass(frozen=True, eq=False)
class Model:
    """Meshes by material under one name; nodes that share it share its triangles."""

    name: str
    parts: Sequence[Part]

    def primitives(self) -> Iterator[tuple[str, Mesh]]:
        """One mesh a material, in the order of their first use."""
        for matter in dict.fromkeys(matter for matter, _ in self.parts):
            yield matter, join(mesh for name, mesh in self.parts if name == matter)


@dataclass(frozen=True, eq=False)
class Node:
    """A place in the tree: `turn` degrees about the axis `about`, then moved to `at`."""

    name: str
    model: Model | None = None
    at: Point = (0, 0, 0)
    turn: float = 0.0
    about: Point = (0, 1, 0)
    size: float = 1.0
    children: Sequence[Node] = ()


@dataclass
class _Writer:
    """The document and its binary while they grow."""

    materials: dict[str, Matter]
    document: Json
    binary: bytearray = field(default_factory=bytearray)
    models: dict[str, int] = field(default_factory=dict)

    def add(self, key: str, thing: Json) -> int:
        """Append to one of the document's lists, and return the index."""
        things: list[Json] = self.document.setdefault(key, [])
        things.append(thing)
        return len(things) - 1

    def array(self, values: NDArray[Any], kind: int, target: int, bounds: bool = False) -> int:
        """Store an array and return its accessor."""
        shape = {1: "SCALAR", 2: "VEC2", 3: "VEC3"}[values.shape[1] if values.ndim > 1 else 1]
        self.binary.extend(bytes(-len(self.binary) % 4))
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": values.nbytes}
        self.binary.extend(values.tobytes())
        found = self.add("bufferViews", view | {"target": target})
        accessor = {"bufferView": found, "componentType": kind, "count": len(values), "type": shape}
        if bounds:
            accessor |= {"min": values.min(0).tolist(), "max": values.max(0).tolist()}
        return self.add("accessors", accessor)

    def primitive(self, matter: str, mesh: Mesh) -> Json:
        """A mesh primitive with its accessors."""
        few = len(mesh.positions) <= 65535
        indices = mesh.faces.astype("<u2" if few else "<u4").ravel()
        arrays = (mesh.positions, mesh.normals, mesh.uvs)
        names = ("POSITION", "NORMAL", "TEXCOORD_0")
        stored = [
            self.array(a.astype("<f4"), FLOAT, VERTICES, name == "POSITION")
            for name, a in zip(names, arrays, strict=True)
        ]
        return {
            "attributes": dict(zip(names, stored, strict=True)),
            "indices": self.array(indices, USHORT if few else UINT, INDICES),
            "material": list(self.materials).index(matter),
        }

    def model(self, model: Model) -> int:
        """A model's mesh, written at its first use."""
        if model.name not in self.models:
            primitives = [self.primitive(*part) for part in model.primitives()]
            mesh = {"name": model.name, "primitives": primitives}
            self.models[model.name] = self.add("meshes", mesh)
        return self.models[model.name]

    def node(self, node: Node) -> int:
        """A node and all under it."""
        made: Json = {"name": node.name}
        if node.model:
            made["mesh"] = self.model(node.model)
        if any(node.at):
            made["translation"] = [float(x) for x in node.at]
        if node.turn:
            made["rotation"] = _quaternion(node.about, node.turn)
        if node.size != 1:
            made["scale"] = [node.size] * 3
        if node.children:
            made["children"] = [self.node(child) for child in node.children]
        return self.add("nodes", made)

    def texture(self, file: str, clamp: bool) -> Json:
        """A reference to a texture; each file has one texture."""
        uri = f"textures/{file}.png"
        images = self.document.setdefault("images", [])
        known = next((i for i, image in enumerate(images) if image["uri"] == uri), None)
        if known is None:
            known = self.add("images", {"uri": uri})
            self.add("textures", {"source": known, "sampler": int(clamp)})
        return {"index": known}

    def material(self, name: str, matter: Matter) -> None:
        """A material; its maps are found by the names of a texture set."""
        set_ = matter.texture
        surface: Json = {
            "baseColorFactor": [*matter.tint, 1],
            "metallicFactor": 1.0 if set_ else matter.metalness,
            "roughnessFactor": 1.0 if set_ else matter.roughness,
        }
        made: Json = {"name": name, "pbrMetallicRoughness": surface}
        if set_:
            orm = self.texture(f"{set_}_orm", matter.clamp)
            surface["baseColorTexture"] = self.texture(f"{set_}_albedo", matter.clamp)
            surface["metallicRoughnessTexture"] = orm
            made["normalTexture"] = self.texture(f"{set_}_normal", matter.clamp)
            made["occlusionTexture"] = orm
        if matter.emissive:
            strength = max(1.0, *matter.emissive)
            made["emissiveFactor"] = [e / strength for e in matter.emissive]
            made["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
        if matter.double_sided:
            made["doubleSided"] = True
        self.add("materials", made)


def _quaternion(axis: Point, degrees: float) -> list[float]:
    unit: Floats = np.asarray(axis, float) / np.linalg.norm(axis)
    half = np.radians(degrees) / 2
    return [round(float(x), 9) for x in (*(unit * np.sin(half)), np.cos(half))]


def write(path: Path, roots: Sequence[Node], materials: dict[str, Matter]) -> list[Path]:
    """Write `path` (.gltf) and the .bin beside it; textures are looked for in textures/."""
    samplers = [
        {"magFilter": LINEAR, "minFilter": TRILINEAR, "wrapS": wrap, "wrapT": wrap}
        for wrap in (REPEAT, CLAMP)
    ]
    start: Json = {
        "asset": {"version": "2.0", "generator": "Lightbench scenes.making"},
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "scene": 0,
        "samplers": samplers,
    }
    writer = _Writer(materials, start)
    for name, matter in materials.items():
        writer.material(name, matter)
    writer.document["scenes"] = [{"name": path.stem, "nodes": [writer.node(n) for n in roots]}]
    binary = path.with_suffix(".bin")
    writer.document["buffers"] = [{"uri": binary.name, "byteLength": len(writer.binary)}]
    binary.write_bytes(writer.binary)
    path.write_text(json.dumps(writer.document, separators=(",", ":")) + "\n")
    return [path, binary]
