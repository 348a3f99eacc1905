"""Skins at rest: where the joints, as the file places them, put each vertex."""

import numpy as np
from numpy.typing import NDArray

from lightbench.errors import ModelError
from lightbench.gltf.accessors import Accessors
from lightbench.gltf.geometry import Geometry
from lightbench.gltf.limits import Budget
from lightbench.gltf.schema import Skin

__all__ = ["skinned"]

Floats = NDArray[np.float64]
# Bytes of what is held for a vertex meanwhile: three matrices.
BYTES = 3 * 128


def skinned(
    geometry: Geometry,
    skin: Skin,
    worlds: dict[int, Floats],
    accessors: Accessors,
    budget: Budget,
    where: str,
) -> Floats | None:
    """The matrix (V, 4, 4) to the world of each vertex; None if the geometry names no joints.

    Specification, section 3.7.3.3: the sum of weight * joint's matrix * inverse bind matrix.
    Weights are scaled to a sum of 1. Raises ModelError.
    """
    if not {"JOINTS_0", "WEIGHTS_0"} <= geometry.arrays.keys():
        return None
    named = geometry.arrays["JOINTS_0"]
    weights = geometry.arrays["WEIGHTS_0"].astype(np.float64)
    weights = np.maximum(weights, 0)
    weights[weights.sum(axis=1) <= 0] = (1, 0, 0, 0)
    weights /= weights.sum(axis=1, keepdims=True)
    named = np.where(weights > 0, named, 0)
    if named.min() < 0 or named.max() >= len(skin.joints):
        raise ModelError(
            f"{geometry.source}.attributes.JOINTS_0: joint {named.max():g} of {where}, which has "
            f"{len(skin.joints)}"
        )
    joints = named.astype(np.int64)
    budget.decode(len(joints) * BYTES, geometry.source)
    bones = _bones(skin, worlds, accessors, where)
    return sum(
        (weights[:, i, None, None] * bones[joints[:, i]] for i in range(4)),
        start=np.zeros((len(joints), 4, 4)),
    )


def _bones(skin: Skin, worlds: dict[int, Floats], accessors: Accessors, where: str) -> Floats:
    """Joint's matrix times inverse bind matrix (J, 4, 4)."""
    places = np.array([worlds[joint] for joint in skin.joints])
    if skin.inverse_bind_matrices is None:
        return places
    path = f"{where}.inverseBindMatrices"
    flat = accessors.floats(skin.inverse_bind_matrices, ("MAT4",), path)
    if len(flat) < len(places):
        raise ModelError(f"{path}: {len(flat)} matrices for {len(places)} joints")
    inverse = flat[: len(places)].astype(np.float64).reshape(-1, 4, 4).transpose(0, 2, 1)
    with np.errstate(over="ignore", invalid="ignore"):
        product: Floats = places @ inverse
    return product
