"""Millions of rays a second against the size of the scene, beside Mitsuba 3 on the same triangles.

Ours is the whole frame: rays, Lambert's shading, the display's code. Mitsuba's is `ray_intersect`
and `ray_test` alone, of the same rays: what it needs to shade is not counted.
"""

import importlib.util
import os
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import lightbench as lb
from bench.offline import ROUNDS, times
from lightbench import assets
from lightbench.library import read_library
from lightbench.paths import shaders_folder
from lightbench.placement import corners
from lightbench.plan import plan
from lightbench.render import on_gl_thread, renderer
from lightbench.scene import Scene
from lightbench.scene_lights import PointLight
from lightbench.settings import Setting
from lightbench.shapes import mesh
from lightbench.viewpoint import primary_rays

__all__ = ["report"]

SIZE = (512, 512)
# Triangles of an icosphere: 20 times 4 for each level.
LEVELS = (0, 3, 6)
VARIANTS = ("scalar_rgb", "llvm_ad_rgb")
BARE: dict[str, Setting] = {
    "technique": "whitted",
    "max_bounces": 0,
    "model": "lambert",
    "ambient": "none",
}
Measure = Callable[[], float]


class Work(NamedTuple):
    """A scene, and what of it is measured: primary rays alone, or shadow rays too."""

    name: str
    scene: Scene
    shadows: bool


def works() -> Iterator[Work]:
    """The lab's scenes with all that they have, and balls of more and more triangles."""
    for name in ("sphere-intersection", "triangle-intersection", "shadows", "reflectance2"):
        scene = lb.load(f"lab/{name}")
        yield Work(f"lab/{name}", scene, shadows=bool(scene.lights))
    for level in LEVELS:
        for shadows in (False, True):
            yield Work(f"{20 * 4**level} triangles", ball(level), shadows)


def ball(level: int) -> Scene:
    """An icosphere under a lamp, filling most of the picture."""
    key = assets.add_mesh(mesh(f"icosphere-{level}"), keep=True)
    return Scene.parse({
        "camera": {"eye": [0, 0, 3], "fov": 45},
        "meshes": {"ball": {"mesh": key, "low": [-1, -1, -1], "high": [1, 1, 1]}},
        "materials": {"white": {}},
        "objects": {"ball": {"shape": "mesh", "mesh": "ball", "material": "white"}},
        "lights": {"lamp": {"type": "point", "position": [2, 3, 4], "intensity": 50}},
    })  # fmt: skip


def ours(work: Work) -> Measure:
    """Milliseconds of one frame."""
    made = work.scene if work.shadows else work.scene.model_copy(update={"lights": {}})
    settings: dict[str, Setting] = {**BARE, "shadow": "ray" if work.shadows else "none"}
    planned = plan(read_library(shaders_folder()), made, settings, SIZE)
    return lambda: statistics.median(times(planned, 1))


def rays_of(scene: Scene) -> NDArray[np.float32]:
    """Directions (N, 3) through the middles of the pixels."""
    right, up, forward = (np.array(v) for v in primary_rays(scene.camera, SIZE).values())
    y, x = np.mgrid[: SIZE[1], : SIZE[0]]
    across = 2 * (x.reshape(-1, 1) + 0.5) / SIZE[0] - 1
    down = 1 - 2 * (y.reshape(-1, 1) + 0.5) / SIZE[1]
    made = across * right + down * up + forward
    return np.asarray(made / np.linalg.norm(made, axis=1, keepdims=True), np.float32)


def peer(work: Work, variant: str) -> tuple[Measure, int]:
    """Milliseconds of the same rays in Mitsuba, and how many they are."""
    import drjit as dr
    import mitsuba as mi

    if found := newest_llvm():
        os.environ.setdefault("DRJIT_LIBLLVM_PATH", found)
    mi.set_variant(variant)
    scene = mi.load_dict(translated(work.scene, mi))
    directions = rays_of(work.scene)
    lamps = [lamp for lamp in work.scene.lights.values() if isinstance(lamp, PointLight)]
    if variant.startswith("scalar"):
        return scalar(mi, scene, work, directions, lamps)
    origin = mi.Point3f(*map(float, work.scene.camera.eye))
    ray = mi.Ray3f(origin, mi.Vector3f(directions.T))
    places = [mi.Point3f(*lamp.position) for lamp in lamps]
    dr.eval(ray)
    first = scene.ray_intersect(ray)
    lit = int(np.count_nonzero(np.array(first.is_valid()))) * len(lamps) * work.shadows

    def run() -> float:
        start = time.perf_counter()
        si = scene.ray_intersect(ray)
        dr.eval(si)
        if work.shadows:
            found = [scene.ray_test(si.spawn_ray_to(p), si.is_valid()) for p in places]
            dr.eval(*found)
        dr.sync_thread()
        return (time.perf_counter() - start) * 1e3

    return run, len(directions) + lit


def newest_llvm() -> str:
    """The library that Mitsuba's LLVM variant needs, version 18 or later; "" lets it look."""
    libraries = list(Path("/usr/lib").glob("*/libLLVM.so.[0-9][0-9].*"))
    return str(max(libraries, key=lambda path: path.name, default=""))


def scalar(
    mi: Any, scene: Any, work: Work, directions: NDArray[np.float32], lamps: list[PointLight]
) -> tuple[Measure, int]:
    """A few thousand of the rays, one by one, from Python: its calls are counted too."""
    few = directions[:: len(directions) // 2000]
    origin = mi.Point3f(*map(float, work.scene.camera.eye))
    rays = [mi.Ray3f(origin, mi.Vector3f(*map(float, d))) for d in few]
    places = [mi.Point3f(*lamp.position) for lamp in lamps]
    count = [0]

    def run() -> float:
        count[0] = 0
        start = time.perf_counter()
        for ray in rays:
            si = scene.ray_intersect(ray)
            count[0] += 1
            if work.shadows and si.is_valid():
                for place in places:
                    scene.ray_test(si.spawn_ray_to(place))
                    count[0] += 1
        return (time.perf_counter() - start) * 1e3

    run()
    return run, count[0]


def translated(scene: Scene, mi: Any) -> dict[str, Any]:
    """The scene's shapes for Mitsuba."""
    made: dict[str, Any] = {"type": "scene"}
    for name, thing in scene.objects.items():
        if thing.shape == "sphere":
            center, radius = list(map(float, thing.position)), float(thing.scale[0])
            made[name] = {"type": "sphere", "center": center, "radius": radius}
            continue
        if thing.shape == "triangle":
            points, faces = np.array(corners(thing, (0, 0, 0))), np.array([[0, 1, 2]])
        else:
            triangles = mesh(scene.meshes[str(thing.mesh)].mesh)
            points, faces = triangles.positions, triangles.indices
        built = mi.Mesh(name, len(points), len(faces))
        parameters = mi.traverse(built)
        parameters["vertex_positions"] = np.asarray(points, np.float32).ravel()
        parameters["faces"] = np.asarray(faces, np.uint32).ravel()
        parameters.update()
        made[name] = built
    return made


def report(rounds: int = ROUNDS) -> str:
    """A row a scene: millions of rays a second, ours and Mitsuba's, in turn; and their ratio."""
    names = VARIANTS if importlib.util.find_spec("mitsuba") else ()
    title = f"Rays at {SIZE[0]}x{SIZE[1]}: millions a second, median (quartiles); ours / Mitsuba's"
    lines = [title, ""]
    for work in works():
        own = ours(work)
        others = {name: peer(work, name) for name in names}
        count = others[VARIANTS[1]][1] if others else SIZE[0] * SIZE[1]
        for measure in (own, *(run for run, _ in others.values())):
            measure()
        found: dict[str, list[float]] = {name: [] for name in ("ours", *others)}
        for _ in range(rounds):
            found["ours"].append(count / own() / 1e3)
            for name, (run, rays) in others.items():
                found[name].append(rays / run() / 1e3)
        rates = {name: statistics.median(values) for name, values in found.items()}
        low, _, high = statistics.quantiles(found["ours"], n=4)
        what = f"{work.name}{', with shadows' if work.shadows else ''}"
        line = f"  {what:<34} {rates['ours']:7.1f} ({low:.1f} to {high:.1f})"
        for name in others:
            line += f"  {name} {rates[name]:6.2f}, {rates['ours'] / rates[name]:5.2f} x"
        lines.append(line)
    ran_on = on_gl_thread(lambda: renderer().name)
    missing = "" if names else "; mitsuba is not installed: no ratio"
    return "\n".join([*lines, "", f"  {rounds} rounds; {ran_on}{missing}", ""])


if __name__ == "__main__":
    print(report())
