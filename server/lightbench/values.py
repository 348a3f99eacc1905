"""The numbers of a plan: what a scene gives to uniforms, rounded to float32.

Positions are relative to the viewpoint, so a scene far from the origin loses nothing. Rounding to
float32 here makes the two plans equal where libraries differ in the last bit of float64.
"""

import math
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from lightbench import matrix
from lightbench.bounds import bounding_sphere, distance
from lightbench.library import Library
from lightbench.placement import model_matrix, normal_matrix
from lightbench.scene import Object, Scene
from lightbench.scene_lights import DirectionalLight, PointLight, SpotLight
from lightbench.scene_surfaces import Map, Material
from lightbench.settings import Resolved
from lightbench.viewpoint import LightMap, Viewpoint, primary_rays

__all__ = [
    "DRAW_NAMES",
    "Values",
    "draw_values",
    "float32",
    "frame_values",
    "front_to_back",
    "light_values",
    "map_values",
    "material_values",
    "mesh_key",
    "parameter_values",
    "texture_transform",
]  # fmt: skip

Values = dict[str, list[float]]

DIELECTRIC_F0 = 0.04
# Greatest reflectance at normal incidence that is given an index: a perfect mirror has none.
F0_MAX = 0.999
MIN_ALPHA = 1e-3
MAX_SHININESS = 1e6
# Brightest light, that of a scene's limit: a flux through no more than a ray would be infinite.
MAX_CANDELA = 1e30


def float32(values: Iterable[float]) -> list[float]:
    """Each value rounded to float32, -0 as 0."""
    return [float(v) + 0.0 for v in np.asarray(list(values), dtype=np.float32)]


def _uniforms(values: dict[str, Sequence[float]]) -> Values:
    return {f"u_{name}": float32(value) for name, value in values.items()}


def parameter_values(resolved: Resolved) -> Values:
    """Uniforms of the menu's parameters."""
    return _uniforms({n: v if isinstance(v, tuple) else [v] for n, v in resolved.values.items()})


def frame_values(viewpoint: Viewpoint, scene: Scene, size: Sequence[int]) -> Values:
    """Uniforms of the camera and of the target's size."""
    camera = scene.camera
    back = matrix.normalize(matrix.subtract(camera.eye, camera.target))
    return _uniforms({
        "view_projection": viewpoint.matrix,
        "to_eye": back,
        "resolution": size,
        "background": scene.background,
        **primary_rays(camera, size),
    })  # fmt: skip


def map_values(viewpoint: Viewpoint, light: LightMap) -> Values:
    """Uniforms of a face of a light's map, while it is drawn."""
    return _uniforms(
        {"view_projection": viewpoint.matrix, "map_far": [light.far], "map_axis": light.axis}
    )


def light_values(
    resolved: Resolved, library: Library, maps: Mapping[int, LightMap], eye: Sequence[float]
) -> Values:
    """Uniforms of the lights, and of the maps of those that cast shadows."""
    per_light = {
        name
        for file in library.files.values()
        for name, parameter in file.meta.parameters.items()
        if parameter.per == "light" and name in resolved.values
    }
    values: Values = {"u_lights_total": float32(_total(resolved.scene))}
    for index, light in enumerate(resolved.scene.lights.values()):
        own = _light(light, eye)
        for name in per_light:
            extra = (light.__pydantic_extra__ or {}).get(name, resolved.values[name])
            own[name] = [float(str(extra))]
        if index in maps:
            own |= _map_of(maps[index], eye)
        values.update({f"u_light{index}_{name}": float32(value) for name, value in own.items()})
    return values


def _total(scene: Scene) -> list[float]:
    """What all lights have together, per channel."""
    total = [0.0, 0.0, 0.0]
    for light in scene.lights.values():
        total = [t + c * light.intensity for t, c in zip(total, light.color, strict=True)]
    return total


def _map_of(light: LightMap, eye: Sequence[float]) -> Values:
    values = {"far": [light.far], "texel": [light.texel]}
    if light.to_clip is not None:
        moved = matrix.translation(matrix.subtract(eye, light.origin))
        values["map"] = matrix.multiply(light.to_clip, moved)
    return values


MATERIAL_NAMES = (
    "base_color", "metalness", "roughness", "f0", "eta", "k", "kd", "ks", "shininess", "ambient",
    "dielectric_f0",
    "emissive", "opacity", "alpha_cutoff", "normal_scale", "occlusion_strength",
)  # fmt: skip
# Names of the uniforms that each object has its own value of.
DRAW_NAMES = {f"u_{name}" for name in ("model", "normal_matrix", "gap", "object", *MATERIAL_NAMES)}


def draw_values(scene: Scene, thing: Object, origin: Sequence[float]) -> Values:
    """Uniforms of one object, its place relative to `origin`."""
    return _uniforms({
        "model": model_matrix(thing, origin),
        "normal_matrix": normal_matrix(thing),
        **material_values(scene.materials[thing.material]),
    })  # fmt: skip


def texture_transform(used: Map) -> list[float]:
    """3x3, column-major: scale, then rotate, then move (KHR_texture_transform)."""
    (x, y), (u, v) = used.scale, used.offset
    c, s = matrix.cos_sin(used.rotation)
    return float32([c * x, -s * x, 0.0, s * y, c * y, 0.0, u, v, 1.0])


def front_to_back(scene: Scene, origin: Sequence[float]) -> list[Object]:
    """Objects by distance, so that the depth test saves the shading of what is hidden."""
    return sorted(scene.objects.values(), key=lambda thing: distance(scene, thing, origin))


def mesh_key(
    resolved: Resolved, library: Library, thing: Object, viewpoint: Viewpoint
) -> tuple[str, float]:
    """The mesh of an object, and how far it may lie inside a finer one of the same surface.

    A sphere gets the coarsest level whose silhouette is good enough, unless the level is set.
    """
    if thing.mesh is not None:
        return resolved.scene.meshes[thing.mesh].mesh, 0.0
    if thing.shape == "cone":
        return f"cone-{thing.stacks}x{thing.sectors}", 0.0
    if thing.shape != "sphere":
        return thing.shape, 0.0
    level = int(float(str(resolved.values["subdivision"])))
    if level >= 0:
        return f"icosphere-{level}", 0.0
    level = _level(resolved, library, thing, viewpoint)
    return f"icosphere-{level}", library.icosphere_errors[level] * max(thing.scale)


def _level(resolved: Resolved, library: Library, thing: Object, viewpoint: Viewpoint) -> int:
    errors, scene = library.icosphere_errors, resolved.scene
    radius, away = bounding_sphere(scene, thing)[1], distance(scene, thing, viewpoint.origin)
    if viewpoint.orthographic:
        pixels = viewpoint.focal * radius
    elif away <= radius:
        return len(errors) - 1
    else:
        pixels = viewpoint.focal * radius / math.sqrt(away * away - radius * radius)
    allowed = float(str(resolved.values["sphere_error"]))
    good = (level for level, error in enumerate(errors) if error * pixels <= allowed)
    return next(good, len(errors) - 1)


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


def material_values(material: Material) -> dict[str, Sequence[float]]:
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
    indices = [_index(f, metalness) for f in f0]
    kd = material.kd or [b * (1 - metalness) for b in base]
    ks = material.ks or [f * (shininess + 2) / 8 for f in f0]
    return {
        "base_color": base,
        "metalness": [metalness],
        "roughness": [material.roughness],
        "f0": f0,
        "eta": list(material.eta or [eta for eta, _ in indices]),
        "k": list(material.k or [k for _, k in indices]),
        "kd": [k / math.pi for k in kd],
        "ks": [k / math.pi for k in ks],
        "shininess": [shininess],
        "ambient": [k / math.pi for k in material.ambient],
        "dielectric_f0": given,
        "emissive": material.emissive,
        "opacity": [material.opacity],
        "alpha_cutoff": [material.alpha_cutoff],
        "normal_scale": [material.normal_scale],
        "occlusion_strength": [material.occlusion_strength],
    }


def _index(f0: float, metalness: float) -> tuple[float, float]:
    """The complex index (eta, k) that reflects `f0` at normal incidence.

    Gulbrandsen 2014, Artist friendly metallic Fresnel, eqs. 11 and 13, its edge tint being the
    metalness: a dielectric is clear, k = 0. As shaders/lib/conductor.glsl, which says why in
    this form.
    """
    r = min(f0, F0_MAX)
    s = math.sqrt(r)
    clear = (1 + s) * (1 + s) / (1 - r)
    eta = clear * (1 - metalness) + (1 - r) / (1 + r) * metalness
    k = 2 * s / (1 + r) * math.sqrt(metalness * (1 + (1 - metalness) * clear * clear))
    return eta, k
