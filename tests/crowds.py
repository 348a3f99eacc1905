"""Many balls at once, of every size and in every place, as arrays (N, 4): centre, radius."""

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from lightbench.exact.directions import Array
from lightbench.scene import Scene

__all__ = ["COLORS", "CROWDS", "crowd_scene"]

# Of one ball after the other: what a picture shows of it, without any light.
COLORS = np.random.default_rng(5).integers(1, 16, (16, 3)) / 16


def _random(count: int, seed: int, low: float, high: float) -> Array:
    """In a cube of side 2, the radius between two powers of ten."""
    random = np.random.default_rng(seed)
    radii = 10 ** random.uniform(low, high, count)
    return np.column_stack([random.uniform(-1, 1, (count, 3)), radii])


def _dust() -> Array:
    """Radius 1e-3 beside 1e5: grains on a globe that is their floor."""
    grains = _random(300, 3, -3, -1)
    grains[:, 1] = grains[:, 3] - 0.5
    return np.concatenate([[[0, -1e5 - 0.5, 0, 1e5]], grains])


def _coincident() -> Array:
    """Ten balls in each of five places, half of them within others."""
    places = _random(5, 4, -0.5, -0.5)
    many = np.repeat(places, 10, axis=0)
    many[::2, 3] *= 0.5
    return many


def _grid() -> Array:
    """Centres alike in one or two coordinates; 125 of one radius."""
    x, y, z = np.mgrid[-2:3, -2:3, -2:3].reshape(3, -1) / 2
    return np.column_stack([x, y, z, np.full(x.shape, 0.2)])


# The camera stands three metres before the middle of all but the far one.
CROWDS: dict[str, Array] = {
    "one": np.array([[0.1, 0.2, 0.3, 0.5]]),
    "two": np.array([[0.1, 0.2, 0.3, 0.5], [-0.4, 0, 0.9, 0.2]]),
    "sizes": _random(1000, 1, -3, -0.8),
    "alike": _random(1000, 2, -1.5, -1.5),
    "dust": _dust(),
    "coincident": _coincident(),
    "grid": _grid(),
    # Each around all that follow, the smallest before the others.
    "nested": np.array([[0, 0, 1 - 0.75**i, 0.75**i] for i in range(40)]),
    "far": 50 * _random(200, 6, -2, -1) + np.array([0, 0, -1e4, 0]),
}


def crowd_scene(balls: Array, materials: Sequence[dict[str, Any]], offset: float = 0.0) -> Scene:
    """Balls under a sun, the materials one after the other, moved along x with the camera."""
    there = balls + np.array([offset, 0, 0, 0])
    kinds = itertools.cycle(f"m{i}" for i in range(len(materials)))
    far = float(balls[:, 2].mean()) < -100
    return Scene.parse({
        "camera": {
            "eye": [offset + 0.5, 0.4, 3], "target": [offset, 0, -1e4 if far else 0],
            "fov": 1 if far else 50,
        },
        "materials": {f"m{i}": given for i, given in enumerate(materials)},
        "objects": {
            f"ball{i}": {
                "shape": "sphere", "position": position, "scale": radius, "material": next(kinds),
            }
            for i, (*position, radius) in enumerate(there.tolist())
        },
        "lights": {"sun": {"type": "directional", "direction": [-0.3, -1, -0.4], "intensity": 1}},
        "settings": {
            "technique": "whitted", "max_bounces": 0, "model": "lambert", "ambient": "none",
            "shadow": "ray",
        },
    })  # fmt: skip
