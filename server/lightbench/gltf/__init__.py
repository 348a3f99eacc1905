"""Models in glTF 2.0 (.glb, .gltf): `read_gltf` gives the data of a scene."""

from lightbench.gltf.convert import read_gltf
from lightbench.gltf.limits import Limits

__all__ = ["Limits", "read_gltf"]
