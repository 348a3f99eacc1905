"""The same rays at the same triangles in Mitsuba 3: `ray_intersect` and `ray_test`, no shading."""

import time
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bench.rates import Measure
from bench.works import Work, directions
from lightbench.placement import corners
from lightbench.scene import Scene
from lightbench.shapes import mesh

__all__ = ["Ball", "Triangles", "available", "peer", "shapes"]

SCALAR, VECTORISED = "scalar_rgb", "llvm_ad_rgb"
# Rays of the scalar variant: its calls are made one by one, from Python.
FEW = 2000


class Ball(NamedTuple):
    """A sphere in the world."""

    center: list[float]
    radius: float


class Triangles(NamedTuple):
    """Points (N, 3) in the world and the three of each face (M, 3)."""

    points: NDArray[np.float32]
    faces: NDArray[np.uint32]


def available() -> tuple[list[str], str]:
    """The variants that run here, and what to install for those that do not ("": all run)."""
    if not find_spec("mitsuba"):
        return [], "Mitsuba is missing: no ratio; run: pip install -e '.[bench]'"
    import drjit

    if drjit.has_backend(drjit.JitBackend.LLVM):
        return [SCALAR, VECTORISED], ""
    return [SCALAR], (
        f"Mitsuba's {VECTORISED} is missing: it needs the library of LLVM 15 or newer, which is "
        "package libllvm19 of Debian and Ubuntu, or the file that DRJIT_LIBLLVM_PATH names"
    )


def shapes(scene: Scene) -> dict[str, Ball | Triangles]:
    """The scene's spheres, triangles and meshes, of which none is moved or turned."""
    made: dict[str, Ball | Triangles] = {}
    for name, thing in scene.objects.items():
        if thing.shape == "sphere":
            made[name] = Ball([float(c) for c in thing.position], float(thing.scale[0]))
        elif thing.shape == "triangle":
            points = np.array(corners(thing, (0, 0, 0)), np.float32)
            made[name] = Triangles(points, np.array([[0, 1, 2]], np.uint32))
        else:
            found = mesh(scene.meshes[str(thing.mesh)].mesh)
            made[name] = Triangles(found.positions, np.asarray(found.indices, np.uint32))
    return made


def peer(variant: str) -> Callable[[Work], Measure]:
    """What measures a work under a variant."""

    def prepare(work: Work) -> Measure:
        import mitsuba

        mitsuba.set_variant(variant)
        made = {name: _translated(name, s, mitsuba) for name, s in shapes(work.scene).items()}
        scene = mitsuba.load_dict({"type": "scene", **made})
        measure = (_scalar if variant == SCALAR else _vectorised)(mitsuba, scene, work)
        measure()  # compiles
        return measure

    return prepare


def _translated(name: str, shape: Ball | Triangles, mitsuba: Any) -> Any:
    if isinstance(shape, Ball):
        return {"type": "sphere", "center": shape.center, "radius": shape.radius}
    made = mitsuba.Mesh(name, len(shape.points), len(shape.faces))
    parameters = mitsuba.traverse(made)
    parameters["vertex_positions"] = shape.points.ravel()
    parameters["faces"] = shape.faces.ravel()
    parameters.update()
    return made


def _ends(mitsuba: Any, work: Work) -> tuple[Any, list[Any]]:
    """Where the rays begin and where those to the lamps end."""
    places = [lamp.position for lamp in work.scene.lights.values() if lamp.type == "point"]
    eye = mitsuba.Point3f(*map(float, work.scene.camera.eye))
    return eye, [mitsuba.Point3f(*map(float, place)) for place in places]


def _vectorised(mitsuba: Any, scene: Any, work: Work) -> Measure:
    """All rays at once."""
    import drjit

    eye, places = _ends(mitsuba, work)
    ray = mitsuba.Ray3f(eye, mitsuba.Vector3f(directions(work.scene, work.size).T))
    drjit.eval(ray)

    def run() -> dict[str, float]:
        start = time.perf_counter()
        met = scene.ray_intersect(ray)
        drjit.eval(met)
        drjit.sync_thread()
        costs = {"primary": _since(start)}
        if work.shadow:
            start = time.perf_counter()
            drjit.eval([scene.ray_test(met.spawn_ray_to(p), met.is_valid()) for p in places])
            drjit.sync_thread()
            costs["shadow"] = _since(start)
            costs["both"] = costs["primary"] + costs["shadow"]
        return costs

    return run


def _scalar(mitsuba: Any, scene: Any, work: Work) -> Measure:
    """A few of the rays, one by one, and their time as all would take it; calls are counted too."""
    eye, places = _ends(mitsuba, work)
    every = directions(work.scene, work.size)
    few = every[:: max(len(every) // FEW, 1)]
    rays = [mitsuba.Ray3f(eye, mitsuba.Vector3f(*map(float, d))) for d in few]

    def run() -> dict[str, float]:
        start = time.perf_counter()
        met = [scene.ray_intersect(ray) for ray in rays]
        costs = {"primary": _since(start) * work.primary / len(rays)}
        if work.shadow:
            valid = [one for one in met if one.is_valid()]
            start = time.perf_counter()
            for one in valid:
                for place in places:
                    scene.ray_test(one.spawn_ray_to(place))
            costs["shadow"] = _since(start) * work.shadow / (len(valid) * len(places))
            costs["both"] = costs["primary"] + costs["shadow"]
        return costs

    return run


def _since(start: float) -> float:
    return (time.perf_counter() - start) * 1e3
