"""Objects of a scene out of the nodes that have meshes: shared meshes, or copies in the world."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lightbench.gltf import schema
from lightbench.gltf.accessors import Accessors
from lightbench.gltf.geometry import Geometry, GeometryReader
from lightbench.gltf.limits import Budget
from lightbench.gltf.materials import Materials
from lightbench.gltf.meshes import FARTHEST, Use, mesh_of
from lightbench.gltf.names import Names
from lightbench.gltf.nodes import Placed, decomposed
from lightbench.gltf.notes import Notes
from lightbench.gltf.schema import Document, Primitive
from lightbench.gltf.skins import skinned
from lightbench.mesh import Mesh

__all__ = ["Objects"]

Floats = NDArray[np.float64]
FIRST_OF_TRIANGLES = 4


@dataclass(frozen=True)
class Wanted:
    """How a part would be named: after the first that makes a name, with its number if several."""

    names: tuple[str, ...]
    suffix: str


class Objects:
    """Objects by name and the meshes that they share, which go by name too."""

    def __init__(
        self, document: Document, reader: GeometryReader, accessors: Accessors,
        materials: Materials, worlds: dict[int, Floats], budget: Budget, notes: Notes,
    ) -> None:  # fmt: skip
        self.entries: dict[str, dict[str, object]] = {}
        self.meshes: dict[str, Mesh] = {}
        self._document = document
        self._reader = reader
        self._accessors = accessors
        self._materials = materials
        self._worlds = worlds
        self._budget = budget
        self._notes = notes
        self._names, self._mesh_names = Names(), Names()
        self._shared: dict[tuple[Geometry, Use], str] = {}

    def add(self, place: Placed) -> None:
        """Add what a node with a mesh shows. Raises ModelError."""
        assert place.node.mesh is not None
        mesh = self._document.meshes[place.node.mesh]
        for i, primitive in enumerate(mesh.primitives):
            where = f"meshes[{place.node.mesh}].primitives[{i}]"
            if primitive.mode < FIRST_OF_TRIANGLES:
                self._notes.add("points and lines were left out")
                continue
            geometry = self._reader.read(primitive, where)
            if geometry is None:
                self._notes.add(f"{where} has no triangle with an area and was left out")
                continue
            self._check_sets(geometry, primitive, where)
            self._add(place, geometry, primitive.material, _wanted(place, mesh, i))

    def _check_sets(self, geometry: Geometry, primitive: Primitive, where: str) -> None:
        for uv in sorted(self._materials.sets(primitive.material)):
            if f"TEXCOORD_{uv}" not in geometry.arrays:
                self._notes.add(
                    f"{where} has no TEXCOORD_{uv} for a texture, which shows one texel"
                )

    def _add(self, place: Placed, geometry: Geometry, material: int | None, wanted: Wanted) -> None:
        self._budget.spend("nodes", 1, f"nodes[{place.index}]")
        use = self._materials.use(material)
        mesh, where = self._mesh(place, geometry, use, wanted)
        self.entries[self._names.new(*wanted.names, suffix=wanted.suffix)] = {
            "shape": "mesh",
            "mesh": mesh,
            "material": self._materials.name(material),
            **where,
        }

    def _mesh(
        self, place: Placed, geometry: Geometry, use: Use, wanted: Wanted
    ) -> tuple[str, dict[str, list[float]]]:
        """The name of a mesh and where it stands: everyone's own, or one already in the world."""
        bones = self._bones(place, geometry)
        where = decomposed(place.world) if bones is None else None
        if where is None or np.abs(geometry.arrays["POSITION"]).max() > FARTHEST:
            matrices = place.world if bones is None else bones
            return self._named(mesh_of(geometry, use, self._budget, matrices), wanted), {}
        if (geometry, use) not in self._shared:
            made = mesh_of(geometry, use, self._budget)
            self._shared[geometry, use] = self._named(made, wanted)
        return self._shared[geometry, use], where

    def _bones(self, place: Placed, geometry: Geometry) -> Floats | None:
        if place.node.skin is None:
            return None
        skin, where = self._document.skins[place.node.skin], f"skins[{place.node.skin}]"
        return skinned(geometry, skin, self._worlds, self._accessors, self._budget, where)

    def _named(self, mesh: Mesh, wanted: Wanted) -> str:
        name = self._mesh_names.new(*wanted.names, suffix=wanted.suffix)
        self.meshes[name] = mesh
        return name


def _wanted(place: Placed, mesh: schema.Mesh, primitive: int) -> Wanted:
    suffix = f"_{primitive}" if len(mesh.primitives) > 1 else ""
    return Wanted((place.node.name, mesh.name, f"part_{place.index}"), suffix)
