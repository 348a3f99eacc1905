"""Numbers on the GPU that shaders read by their place."""

from functools import lru_cache

import moderngl
import numpy as np
from numpy.typing import NDArray

from lightbench import bvh
from lightbench.plan_types import PlannedTable
from lightbench.shapes import mesh

__all__ = ["Tables", "hierarchy", "packed_hierarchy"]

# Columns of a table of texels, as in shaders/stages/list.glsl.
WIDTH = 1024
# Tables kept between plans.
MOST = 16


@lru_cache(maxsize=64)
def hierarchy(key: str) -> NDArray[np.int32]:
    """What rays read of a mesh (texels, 4). Raises NotFoundError."""
    return bvh.bake(mesh(key))


def packed_hierarchy(key: str) -> bytes:
    """What rays read of a mesh as little-endian int32, four a texel. Raises NotFoundError."""
    return hierarchy(key).astype("<i4", copy=False).tobytes()


class Tables:
    """Owns the tables on the GPU."""

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self._tables: dict[tuple[tuple[float, ...], tuple[str, ...]], moderngl.Texture] = {}

    def load(self, planned: dict[str, PlannedTable]) -> dict[str, moderngl.Texture]:
        """The tables of a plan, by name."""
        keys = {n: (tuple(t["texels"]), tuple(t["meshes"])) for n, t in planned.items()}
        for old in [key for key in self._tables if key not in keys.values()][:-MOST]:
            self._tables.pop(old).release()
        for key in keys.values():
            if key not in self._tables:
                texels, meshes = key
                self._tables[key] = self.meshes(meshes) if meshes else self.texels(texels)
        return {name: self._tables[key] for name, key in keys.items()}

    def texels(self, values: tuple[float, ...]) -> moderngl.Texture:
        """Four numbers a texel, row by row."""
        rows = np.zeros((-(-len(values) // (4 * WIDTH)), WIDTH, 4), np.float32)
        rows.reshape(-1)[: len(values)] = values
        return self.texture(rows, "f4")

    def meshes(self, keys: tuple[str, ...]) -> moderngl.Texture:
        """Where each mesh begins, a texel each, and then the meshes."""
        baked = [hierarchy(key) for key in keys]
        begins = len(keys) + np.cumsum([0, *map(len, baked)])
        every = np.zeros((-(-int(begins[-1]) // bvh.WIDTH), bvh.WIDTH, 4), np.int32)
        flat = every.reshape(-1, 4)
        flat[: len(keys), 0] = begins[:-1]
        flat[len(keys) : begins[-1]] = np.concatenate(baked)
        return self.texture(every, "i4")

    def texture(
        self, rows: NDArray[np.float32] | NDArray[np.int32], dtype: str
    ) -> moderngl.Texture:
        height, width, _ = rows.shape
        made = self.context.texture((width, height), 4, rows.tobytes(), dtype=dtype)
        made.filter = (moderngl.NEAREST, moderngl.NEAREST)
        return made
