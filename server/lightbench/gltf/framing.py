"""The camera: the file's first one, or one that has the whole model in sight."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lightbench import matrix
from lightbench.gltf.nodes import FARTHEST, Placed
from lightbench.gltf.notes import Notes
from lightbench.gltf.schema import Camera, Document
from lightbench.mesh import Mesh

__all__ = ["Sphere", "View", "around", "camera_of", "framed"]

Floats = NDArray[np.float64]
Data = dict[str, Any]

# Vertical field of view in degrees, and how much farther than the nearest place that shows all.
FOV, MARGIN = 35.0, 1.1
# From the front (+Z, specification section 3.4), from the right of it, a little above.
FROM = (0.62, 0.42, 1.0)
SMALLEST = 1e-5


@dataclass(frozen=True)
class Sphere:
    """What encloses a model."""

    center: Floats
    radius: float


@dataclass(frozen=True)
class View:
    """A camera's data and its axes: to the right, up and back."""

    data: Data
    right: Floats
    up: Floats
    back: Floats


def around(objects: dict[str, Data], meshes: dict[str, Mesh]) -> Sphere:
    """A sphere that encloses all objects, about the middle of their boxes."""
    own = {name: _sphere(mesh) for name, mesh in meshes.items()}
    spheres = [_placed(thing, own[thing["mesh"]]) for thing in objects.values()]
    low = np.min([s.center - s.radius for s in spheres], axis=0)
    high = np.max([s.center + s.radius for s in spheres], axis=0)
    center = (low + high) / 2 if len(spheres) > 1 else spheres[0].center
    radius = max(float(np.linalg.norm(s.center - center)) + s.radius for s in spheres)
    return Sphere(center, radius)


def _sphere(mesh: Mesh) -> Sphere:
    positions = mesh.positions.astype(np.float64)
    center = (positions.min(axis=0) + positions.max(axis=0)) / 2
    return Sphere(center, float(np.linalg.norm(positions - center, axis=1).max()))


def _placed(thing: Data, sphere: Sphere) -> Sphere:
    """Of an object; without a place it stands in the world already."""
    if "position" not in thing:
        return sphere
    model = np.array(matrix.compose(thing["position"], thing["rotation"], thing["scale"]))
    center = (model.reshape(4, 4).T @ np.append(sphere.center, 1))[:3]
    return Sphere(center, sphere.radius * max(thing["scale"]))


def camera_of(document: Document, places: list[Placed], seen: Sphere, notes: Notes) -> View | None:
    """The view of the first camera in the scene; None without one."""
    for place in places:
        if place.node.camera is None:
            continue
        where = f"nodes[{place.index}]"
        axes = _axes(place.world)
        eye = place.world[:3, 3]
        if axes is None or np.abs(eye).max() > FARTHEST / 2:
            notes.add(f"{where}: its camera looks from nowhere and was left out")
            continue
        camera = document.cameras[place.node.camera]
        view = _view(eye, axes, seen)
        return View(view.data | _lens(camera, where, notes), view.right, view.up, view.back)
    return None


def _axes(world: Floats) -> tuple[Floats, Floats, Floats] | None:
    """Right, up and back, unit and square to each other; None if the matrix has lost them."""
    up, back = world[:3, 1], world[:3, 2]
    right = np.cross(up, back)
    lengths = [float(np.linalg.norm(axis)) for axis in (right, up, back)]
    if not (
        lengths[1] > 1e-12 and lengths[2] > 1e-12 and lengths[0] > 1e-6 * lengths[1] * lengths[2]
    ):
        return None
    right, back = right / lengths[0], back / lengths[2]
    return right, np.cross(back, right), back


def _lens(camera: Camera, where: str, notes: Notes) -> Data:
    if camera.type == "perspective" and camera.perspective:
        fov = math.degrees(camera.perspective.yfov)
        return {"fov": notes.within(fov, 1, 170, f"{where}: field of view")}
    if camera.type == "orthographic" and camera.orthographic:
        height = 2 * abs(camera.orthographic.ymag)
        within = notes.within(height, 1e-6, 1e6, f"{where}: view height")
        return {"projection": "orthographic", "height": within}
    notes.add(f"{where}: its camera has no lens; it got one of {FOV:g} degrees")
    return {"fov": FOV}


def framed(seen: Sphere) -> View:
    """A view from the front right and above that has the sphere in sight."""
    back = np.array(FROM) / np.linalg.norm(FROM)
    right = np.cross((0.0, 1.0, 0.0), back)
    right /= np.linalg.norm(right)
    radius = max(seen.radius, SMALLEST)
    distance = MARGIN * radius / math.sin(math.radians(FOV / 2))
    view = _view(seen.center + distance * back, (right, np.cross(back, right), back), seen)
    data = view.data | {"up": [0.0, 1.0, 0.0], "target": _numbers(seen.center), "fov": FOV}
    return View(data, view.right, view.up, view.back)


def _view(eye: Floats, axes: tuple[Floats, Floats, Floats], seen: Sphere) -> View:
    """The target lies as far away as the model's middle, so that a turn goes about it."""
    right, up, back = axes
    ahead = float(np.dot(eye - seen.center, back))
    distance = max(ahead, seen.radius / 2, SMALLEST)
    target = np.clip(eye - distance * back, -FARTHEST, FARTHEST)
    data = {"eye": _numbers(eye), "target": _numbers(target), "up": _numbers(up)}
    return View(data, right, up, back)


def _numbers(values: Floats) -> list[float]:
    return [round(float(value), 9) + 0.0 for value in values]
