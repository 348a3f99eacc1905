"""The lab's texture: its mappings, and a checker in the place of one that is not printed."""

from __future__ import annotations

from typing import Literal

import numpy as np

from lightbench.exact.directions import Array

SIZE = 400  # texels a side
CELLS = 8  # cells a side
DARK = 64 / 255  # what eight bits hold of a quarter


def checker() -> Array:
    """(SIZE, SIZE), row 0 at v = 0: cells of 50 texels, the first of them 1, the next DARK."""
    cell = np.arange(SIZE) * CELLS // SIZE
    return np.where((cell[:, None] + cell[None, :]) % 2 == 0, 1.0, DARK)


def coordinates(n: Array, mapping: Literal["lab", "sphere"] = "lab") -> tuple[Array, Array]:
    """(u, v) in [0, 1] of unit normals: (1.49), (1.50), or with the longitude in u."""
    nx, ny = np.clip(n[..., 0], -1.0, 1.0), np.clip(n[..., 1], -1.0, 1.0)
    across = np.arcsin(nx) if mapping == "lab" else np.arctan2(nx, n[..., 2]) / 2.0
    return 0.5 + across / np.pi, 0.5 - np.arcsin(ny) / np.pi


def look_up(n: Array, mapping: Literal["lab", "sphere"] = "lab") -> Array:
    """The checker's texel (N,) for each normal, with no filter."""
    texels = checker()
    last = SIZE - 1
    u, v = coordinates(n, mapping)
    column = np.minimum((u * SIZE).astype(np.int64), last)
    row = np.minimum((v * SIZE).astype(np.int64), last)
    return texels[row, column]
