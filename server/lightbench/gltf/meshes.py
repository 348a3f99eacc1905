"""From a primitive's geometry to a mesh: placed if need be, with normals, tangents and colours."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import ModelError
from lightbench.gltf import mikktspace
from lightbench.gltf.geometry import Geometry
from lightbench.gltf.limits import Budget
from lightbench.gltf.normals import face_normals, frames, orthogonal, repaired
from lightbench.mesh import Mesh

__all__ = ["FARTHEST", "Use", "mesh_of"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Largest coordinate in metres: the scene's own limit.
FARTHEST = 1e6


@dataclass(frozen=True)
class Use:
    """What a material reads of a mesh: the texture set of its normal map, and whether set 1."""

    tangent_uv: int = 0
    second_uv: bool = False


def mesh_of(geometry: Geometry, use: Use, budget: Budget, matrices: Floats | None = None) -> Mesh:
    """The mesh of a geometry, in its own space or under `matrices`.

    `matrices` is one affine matrix (4, 4) for all vertices or one for each (V, 4, 4), each placing
    it in the world; what mirrors turns the triangles around. Raises ModelError.
    """
    budget.spend("vertices", len(geometry.arrays["POSITION"]), geometry.source)
    budget.spend("triangles", len(geometry.triangles), geometry.source)
    arrays = {name: array.astype(np.float64) for name, array in geometry.arrays.items()}
    triangles = geometry.triangles
    if matrices is not None:
        arrays, triangles = _moved(arrays, triangles, matrices)
    _check_reach(arrays["POSITION"], geometry.source)
    if "NORMAL" in arrays:
        arrays["NORMAL"] = repaired(
            arrays["NORMAL"], arrays["POSITION"], triangles, f"{geometry.source}.attributes.NORMAL"
        )
    else:
        arrays, triangles = _flat(arrays, triangles, budget, geometry.source)
    arrays, triangles = _with_tangents(arrays, triangles, use)
    return _finished(arrays, triangles, use)


def _moved(
    arrays: dict[str, Floats], triangles: Ints, matrices: Floats
) -> tuple[dict[str, Floats], Ints]:
    """Positions by the matrix, normals by its inverse transpose, tangents along.

    The cofactors are the inverse transpose times the determinant, and exist without an inverse.
    """
    linear = matrices[..., :3, :3]
    moved = dict(arrays)
    with np.errstate(over="ignore", invalid="ignore"):
        moved["POSITION"] = _times(linear, arrays["POSITION"]) + matrices[..., :3, 3]
        columns = [linear[..., :, i] for i in range(3)]
        cofactors = np.stack(
            [np.cross(columns[(i + 1) % 3], columns[(i + 2) % 3]) for i in range(3)], axis=-1
        )
        mirrored = (columns[0] * cofactors[..., :, 0]).sum(axis=-1) < 0
        sign = np.where(mirrored, -1.0, 1.0)[..., None]
        if "NORMAL" in arrays:
            moved["NORMAL"] = sign * _times(cofactors, arrays["NORMAL"])
        if "TANGENT" in arrays:
            turned = _times(linear, arrays["TANGENT"][:, :3])
            moved["TANGENT"] = np.column_stack([turned, sign[..., 0] * arrays["TANGENT"][:, 3]])
    turned_over = np.broadcast_to(mirrored, len(arrays["POSITION"]))[triangles[:, 0]]
    return moved, np.where(turned_over[:, None], triangles[:, ::-1], triangles)


def _times(matrices: Floats, vectors: Floats) -> Floats:
    product: Floats = np.einsum("...ij,...j->...i", matrices, vectors)
    return product


def _check_reach(positions: Floats, where: str) -> None:
    if not (np.abs(positions) <= FARTHEST).all():
        raise ModelError(f"{where}: a vertex lies beyond {FARTHEST:g} m, the farthest allowed")


def _flat(
    arrays: dict[str, Floats], triangles: Ints, budget: Budget, where: str
) -> tuple[dict[str, Floats], Ints]:
    """Three vertices of its own for each triangle, with its normal; given tangents do not count."""
    budget.spend("vertices", max(0, triangles.size - len(arrays["POSITION"])), where)
    faces = face_normals(arrays["POSITION"], triangles)
    apart = {name: array[triangles.ravel()] for name, array in arrays.items() if name != "TANGENT"}
    apart["NORMAL"] = np.where(faces.any(axis=1, keepdims=True), faces, (0, 0, 1)).repeat(3, axis=0)
    return apart, np.arange(triangles.size).reshape(-1, 3)


def _with_tangents(
    arrays: dict[str, Floats], triangles: Ints, use: Use
) -> tuple[dict[str, Floats], Ints]:
    """Given tangents made square to the normals, or else MikkTSpace's."""
    normals, uvs = arrays["NORMAL"], arrays.get(f"TEXCOORD_{use.tangent_uv}")
    if "TANGENT" in arrays:
        given = arrays["TANGENT"]
        signs = np.where(given[:, 3] < 0, -1.0, 1.0)
        tangents = np.column_stack([orthogonal(given[:, :3], normals), signs])
    elif uvs is None:
        tangents = np.column_stack([frames(normals), np.ones(len(normals))])
    else:
        made, vertices, triangles = mikktspace.tangents(arrays["POSITION"], normals, uvs, triangles)
        arrays = {name: array[vertices] for name, array in arrays.items()}
        tangents = np.column_stack([orthogonal(made[:, :3], arrays["NORMAL"]), made[:, 3]])
    return arrays | {"TANGENT": tangents}, triangles


def _finished(arrays: dict[str, Floats], triangles: Ints, use: Use) -> Mesh:
    nothing = np.zeros((len(arrays["POSITION"]), 2))
    colors = arrays.get("COLOR_0")
    second = arrays.get("TEXCOORD_1", nothing) if use.second_uv else None
    return Mesh(
        _float32(arrays["POSITION"]),
        _float32(arrays["NORMAL"]),
        _float32(arrays.get("TEXCOORD_0", nothing)),
        _float32(arrays["TANGENT"]),
        np.ascontiguousarray(triangles, dtype=np.uint32),
        None if colors is None else _float32(_with_alpha(colors)),
        None if second is None else _float32(second),
    )


def _float32(array: Floats) -> NDArray[np.float32]:
    """Contiguous float32, -0 as 0."""
    return np.ascontiguousarray(array + 0.0, dtype=np.float32)


def _with_alpha(colors: Floats) -> Floats:
    opaque = np.ones((len(colors), 1))
    return np.clip(colors if colors.shape[1] == 4 else np.column_stack([colors, opaque]), 0, 1)
