"""The numbers of a plan: what a scene gives to uniforms, rounded to float32.

Positions are relative to the eye, so a scene far from the origin loses nothing. Rounding to
float32 here makes the two plans equal where libraries differ in the last bit of float64.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np

from lightbench import matrix
from lightbench.library import Library
from lightbench.scene import (
    Camera,
    DirectionalLight,
    Material,
    Object,
    PointLight,
    Scene,
    SpotLight,
)
from lightbench.settings import Resolved

__all__ = ["draw_values", "float32", "frame_values", "front_to_back", "mesh_key"]

Values = dict[str, list[float]]

# Radius of each shape about its own origin.
BOUND = {"plane": math.sqrt(0.5), "cube": math.sqrt(0.75), "sphere": 1.0, "cone": 1.0}
# Nearest depth kept, as a share of the farthest: 24 bits then resolve 6e-5 of the far distance.
NEAREST = 1e-3
DIELECTRIC_F0 = 0.04
MIN_ALPHA = 1e-3
MAX_SHININESS = 1e6
# Brightest light, that of a scene's limit: a flux through no more than a ray would be infinite.
MAX_CANDELA = 1e30


def float32(values: Iterable[float]) -> list[float]:
    """Each value rounded to float32, -0 as 0."""
    return [float(v) + 0.0 for v in np.asarray(list(values), dtype=np.float32)]


def frame_values(resolved: Resolved, library: Library, size: Sequence[int]) -> Values:
    """Uniforms that all draws of a pass share: camera, lights, parameters."""
    scene = resolved.scene
    values: Values = {"u_view_projection": float32(_view_projection(scene, size))}
    for name, value in resolved.values.items():
        values[f"u_{name}"] = float32(value if isinstance(value, tuple) else [value])
    per_light = {
        name
        for file in library.files.values()
        for name, parameter in file.meta.parameters.items()
        if parameter.per == "light" and name in resolved.values
    }
    for index, light in enumerate(scene.lights.values()):
        own = _light(light, scene.camera.eye)
        for name in per_light:
            extra = (light.__pydantic_extra__ or {}).get(name, resolved.values[name])
            own[name] = [float(str(extra))]
        values.update({f"u_light{index}_{name}": float32(value) for name, value in own.items()})
    return values


def draw_values(scene: Scene, thing: Object | None) -> Values:
    """Uniforms of one object (of none: their names)."""
    if thing is None:
        names = ("model", "normal_matrix", *_material(Material()))
        return {f"u_{name}": [] for name in names}
    position = matrix.subtract(thing.position, scene.camera.eye)
    own: dict[str, Sequence[float]] = {
        "model": matrix.compose(position, thing.rotation, thing.scale),
        "normal_matrix": matrix.normal_matrix(thing.rotation, thing.scale),
        **_material(scene.materials[thing.material]),
    }
    return {f"u_{name}": float32(value) for name, value in own.items()}


def front_to_back(scene: Scene) -> list[Object]:
    """Objects by distance, so that the depth test saves the shading of what is hidden."""
    return sorted(scene.objects.values(), key=lambda thing: _distance(thing, scene.camera))


def mesh_key(resolved: Resolved, library: Library, thing: Object, size: Sequence[int]) -> str:
    """The mesh of an object; a sphere gets the coarsest level whose silhouette is good enough."""
    if thing.shape == "cone":
        return f"cone-{thing.stacks}x{thing.sectors}"
    if thing.shape != "sphere":
        return thing.shape
    level = float(str(resolved.values["subdivision"]))
    if level < 0:
        level = _level(resolved, library, thing, size)
    return f"icosphere-{level:.0f}"


def _level(resolved: Resolved, library: Library, thing: Object, size: Sequence[int]) -> int:
    camera, errors = resolved.scene.camera, library.icosphere_errors
    radius, distance = _radius(thing), _distance(thing, camera)
    if distance <= radius:
        return len(errors) - 1
    focal = size[1] / (2 * math.tan(camera.fov * math.pi / 180 / 2))
    pixels = focal * radius / math.sqrt(distance * distance - radius * radius)
    allowed = float(str(resolved.values["sphere_error"]))
    good = (level for level, error in enumerate(errors) if error * pixels <= allowed)
    return next(good, len(errors) - 1)


def _radius(thing: Object) -> float:
    return BOUND[thing.shape] * max(thing.scale)


def _distance(thing: Object, camera: Camera) -> float:
    offset = matrix.subtract(thing.position, camera.eye)
    return math.sqrt(matrix.dot(offset, offset))


def _view_projection(scene: Scene, size: Sequence[int]) -> list[float]:
    """World directions about the eye to clip space; depth spans what there is to see."""
    camera, aspect = scene.camera, size[0] / size[1]
    spans = [(_distance(o, camera), _radius(o)) for o in scene.objects.values()]
    far = max((d + r for d, r in spans), default=1.0) * 1.01
    tangent = math.tan(camera.fov * math.pi / 180 / 2)
    corner = math.sqrt(1 + tangent * tangent * (1 + aspect * aspect))
    near = max(min((d - r for d, r in spans), default=0.0) / corner * 0.99, far * NEAREST)
    view = matrix.look_at(matrix.subtract(camera.target, camera.eye), camera.up)
    return matrix.multiply(matrix.perspective(camera.fov, aspect, near, far), view)


def _light(light: PointLight | DirectionalLight | SpotLight, eye: Sequence[float]) -> Values:
    if isinstance(light, DirectionalLight):
        to_light = [-c for c in matrix.normalize(light.direction)]
        return {"intensity": [c * light.intensity for c in light.color], "direction": to_light}
    candela = light.intensity
    values = {"position": list(matrix.subtract(light.position, eye))}
    solid_angle = 4 * math.pi
    if isinstance(light, SpotLight):
        inner, outer = (math.cos(a * math.pi / 180) for a in (light.inner, light.outer))
        # The square of a ramp from outer to inner integrates to a third of their difference.
        full, edge = (_versine(a) for a in (light.inner, light.outer))
        solid_angle = 2 * math.pi * (full + (edge - full) / 3)
        values |= {"axis": list(matrix.normalize(light.direction))}
        values |= {"cos_inner": [inner], "cos_outer": [outer]}
    if light.unit == "lumen":
        candela = min(candela / solid_angle, MAX_CANDELA) if solid_angle > 0 else 0.0
    return values | {"intensity": [c * candela for c in light.color]}


def _versine(degrees: float) -> float:
    """1 - cos without the digits that this loses for a narrow cone."""
    sine = math.sin(degrees * math.pi / 180 / 2)
    return 2 * sine * sine


def _material(material: Material) -> Values:
    """GLSL's material fields; classic ones follow from the physical ones unless given.

    kd and ks are reflectances in a scene and 1/sr in a shader, hence the division by pi. The
    derived lobe has the exponent of the Blinn-Phong distribution of the same width and its height
    for a far viewer (Real-Time Rendering, 4th ed., sec. 9.8.1): f0 (s + 2) / (8 pi).
    """
    base, metalness = material.base_color, material.metalness
    ior = material.ior
    plain = DIELECTRIC_F0 if ior is None else ((ior - 1) / (ior + 1)) * ((ior - 1) / (ior + 1))
    given = material.f0 or (plain, plain, plain)
    f0 = [g * (1 - metalness) + b * metalness for g, b in zip(given, base, strict=True)]
    alpha = max(material.roughness * material.roughness, MIN_ALPHA)
    shininess = material.shininess
    if shininess is None:
        shininess = min(2 / (alpha * alpha) - 2, MAX_SHININESS)
    kd = material.kd or [b * (1 - metalness) for b in base]
    ks = material.ks or [f * (shininess + 2) / 8 for f in f0]
    return {
        "base_color": list(base),
        "metalness": [metalness],
        "roughness": [material.roughness],
        "f0": f0,
        "kd": [k / math.pi for k in kd],
        "ks": [k / math.pi for k in ks],
        "shininess": [shininess],
    }
