"""What the benchmark of rays measures: scenes, and how many rays a picture of each is.

One ray goes through the middle of each pixel; from what it meets, one goes to every lamp, also to
one behind the surface: so the shaders do.
"""

import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import lightbench as lb
from lightbench import assets
from lightbench.library import read_library
from lightbench.paths import shaders_folder
from lightbench.plan import plan
from lightbench.plan_types import Plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from lightbench.settings import Setting
from lightbench.shapes import mesh
from lightbench.viewpoint import primary_rays

__all__ = ["Work", "ball", "directions", "hits", "planned", "settings", "works"]

Size = tuple[int, int]
# Of the lab's scenes, one of each arrangement of objects and lamps.
PRESETS = ("sphere-intersection", "triangle-intersection", "illumination", "texture", "shadows",
           "reflectance", "reflectance2")  # fmt: skip
LEVELS = (0, 3, 6)
# Balls along each side of a cube of them: by name, and of a list.
SIDES = (2, 4, 8)
BARE: dict[str, Setting] = {
    "technique": "whitted",
    "max_bounces": 0,
    "model": "lambert",
    "ambient": "none",
}


class Work(NamedTuple):
    """A scene, its picture's size, and its rays; `triangles` of the ball, 0 of another scene."""

    name: str
    scene: Scene
    size: Size
    primary: int
    shadow: int
    triangles: int


def works(size: Size) -> Iterator[Work]:
    """The lab's scenes, a ball of more and more triangles, and more and more balls."""
    for preset in PRESETS:
        yield _work(f"lab/{preset}", lb.load(f"lab/{preset}"), size, 0)
    for level in LEVELS:
        triangles = 20 * 4**level
        yield _work(f"{triangles} triangles", ball(level), size, triangles)
    for side in SIDES:
        yield _work(f"{side**3} balls", balls(side), size, 0)


def _work(name: str, scene: Scene, size: Size, triangles: int) -> Work:
    shadow = hits(scene, size) * len(scene.lights)
    return Work(name, scene, size, size[0] * size[1], shadow, triangles)


def ball(level: int) -> Scene:
    """An icosphere of 20 times 4 triangles for each level under a lamp, most of the picture."""
    key = assets.add_mesh(mesh(f"icosphere-{level}"), keep=True)
    return Scene.parse({
        "camera": {"eye": [0, 0, 3], "fov": 45},
        "meshes": {"ball": {"mesh": key, "low": [-1, -1, -1], "high": [1, 1, 1]}},
        "materials": {"white": {}},
        "objects": {"ball": {"shape": "mesh", "mesh": "ball", "material": "white"}},
        "lights": {"lamp": {"type": "point", "position": [2, 3, 4], "intensity": 50}},
    })  # fmt: skip


def balls(side: int) -> Scene:
    """A cube of balls under a lamp, seen from above a corner."""
    places = itertools.product([(2 * i + 1) / side - 1 for i in range(side)], repeat=3)
    return Scene.parse({
        "camera": {"eye": [2.5, 1.8, 3.4], "fov": 40},
        "materials": {"white": {}},
        "objects": {
            f"ball{i}": {
                "shape": "sphere", "position": place, "scale": 0.6 / side, "material": "white",
            }
            for i, place in enumerate(places)
        },
        "lights": {"lamp": {"type": "point", "position": [3, 4, 2], "intensity": 50}},
    })  # fmt: skip


def settings(shadows: bool) -> dict[str, Setting]:
    """One ray a pixel and Lambert's shading, with a ray to each lamp or none."""
    return {**BARE, "shadow": "ray" if shadows else "none"}


def planned(scene: Scene, size: Size, shadows: bool) -> Plan:
    """The plan of a scene's picture."""
    return plan(read_library(shaders_folder()), scene, settings(shadows), size)


def hits(scene: Scene, size: Size) -> int:
    """How many rays meet a surface: without lamps it is black, and the background is not."""
    unlit = scene.model_copy(update={"lights": {}, "background": (1.0, 1.0, 1.0)})
    made = planned(unlit, size, shadows=False)
    image = on_gl_thread(lambda: renderer().run(made))
    return int(np.count_nonzero(image.linear[..., 0] == 0))


def directions(scene: Scene, size: Size) -> NDArray[np.float32]:
    """Unit vectors (N, 3) from the eye through the pixels' middles, row 0 at the top."""
    right, up, forward = (np.array(v) for v in primary_rays(scene.camera, size).values())
    y, x = np.mgrid[: size[1], : size[0]]
    across = 2 * (x.reshape(-1, 1) + 0.5) / size[0] - 1
    above = 1 - 2 * (y.reshape(-1, 1) + 0.5) / size[1]
    made = across * right + above * up + forward
    return np.asarray(made / np.linalg.norm(made, axis=1, keepdims=True), np.float32)
