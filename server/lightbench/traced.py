"""What rays need to know of a scene: each object's equation, its kind of surface and its values."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from lightbench import matrix
from lightbench.assemble import Source
from lightbench.bounds import bounding_sphere
from lightbench.placement import corners, inverse_matrix
from lightbench.scene import Object, Scene
from lightbench.scene_surfaces import Material
from lightbench.sphere_tree import ROOM, sphere_tree
from lightbench.surface import Pattern, Surface
from lightbench.values import DRAW_NAMES, Values, float32, material_values, texture_transform

__all__ = [
    "SURFACE",
    "TRACING",
    "UNTRACED",
    "UNTRACED_LISTS",
    "Records",
    "image_arrays",
    "image_numbers",
    "object_records",
    "object_values",
    "own_values",
    "scene_defines",
    "taken",
]  # fmt: skip

Records = tuple[tuple[tuple[str, str], ...], ...]

# The file that says what a kind of surface sends to the eye, and the one that asks it.
SURFACE, TRACING = "stages/surface.glsl", "stages/shaded.glsl"
DEFAULT_IOR = 1.5
# Texels of an object before its own values.
FIRST_VALUE = 5
# Layers that WebGL2 promises for an array.
MOST_LAYERS = 256
# What functions and constants of shapes are called. A ball is a sphere of one scale.
SHAPES = ("ball", "triangle", "plane", "cube", "cone", "round", "mesh")
# Objects from which on rays ask a list. Fewer are faster by name (of balls under a lamp up to 16 or
# 20), but each takes up to 14 of the 224 uniforms that WebGL2 promises to a shader.
LONG = 16
# What a ray may find where it meets an object.
FOUND = ("position", "normal", "to_eye", "front", "tangent", "uv0", "uv1", "color")
_TEXTURE = re.compile(r"u_texture\d+(_transform)?")


def object_records(scene: Scene, surfaces: Mapping[int, Surface]) -> Records:
    """The records of OBJECTS: how each is met, and the number of its kind of surface."""
    kinds = patterns_of(scene, surfaces)
    return tuple(
        tuple(_record(scene, index, thing, kinds.index(_kind(surfaces[id(thing)]))).items())
        for index, thing in enumerate(scene.objects.values())
    )


def patterns_of(scene: Scene, surfaces: Mapping[int, Surface]) -> list[Pattern]:
    """The kinds of surface that there are."""
    return list(dict.fromkeys(_kind(surfaces[id(thing)]) for thing in scene.objects.values()))


def _kind(surface: Surface) -> Pattern:
    """Whether both sides are seen is the object's affair: it makes no kind of its own."""
    pattern = surface.pattern
    flags = tuple(flag for flag in pattern.flags if flag != "DOUBLE_SIDED")
    return replace(pattern, flags=flags)


def shape_of(thing: Object) -> str:
    """What functions and constants of an object's shape are called."""
    if thing.shape == "sphere":
        return "ball" if len(set(thing.scale)) == 1 else "round"
    return thing.shape


def is_listed(scene: Scene) -> bool:
    """Whether rays find objects in a texture, by number, rather than by name."""
    things = scene.objects.values()
    return len(things) >= LONG or any(thing.mesh is not None for thing in things)


def _has_two_sides(material: Material) -> bool:
    """Whether rays meet its back, too: that of glass they do on their way out."""
    return material.double_sided or material.transmittance > 0


def _record(scene: Scene, index: int, thing: Object, kind: int) -> dict[str, str]:
    material = scene.materials[thing.material]
    shape = shape_of(thing)
    ball, triangle = shape == "ball", shape == "triangle"
    kinds = {
        "ball": ball,
        "triangle": triangle,
        "placed": not ball and not triangle,
        "plane": thing.shape == "plane",
        "double": material.double_sided,
        "open": _has_two_sides(material),
        "solid": material.alpha_mode != "blend",
        "transmits": material.transmittance > 0,
    }
    truths = {name: str(int(holds)) for name, holds in kinds.items()}
    name = "round" if ball else shape
    return {"index": str(index), "shape": name, "kind": str(kind), **truths}


def scene_defines(scene: Scene, bounces: float) -> tuple[tuple[str, float], ...]:
    """Which kinds of object there are; whether rays are sent on, up to `bounces` times, and how."""
    things = scene.objects.values()
    used = [scene.materials[thing.material] for thing in things]
    shapes = {shape_of(thing) for thing in things}
    blended = any(material.alpha_mode != "opaque" for material in used)
    transmits = any(material.transmittance > 0 for material in used)
    refracts = transmits and bounces > 0
    return (
        *((f"any_{shape}", float(shape in shapes)) for shape in SHAPES),
        ("any_placed", float(bool(shapes - {"ball", "triangle", "mesh"}))),
        ("listed", float(is_listed(scene))),
        ("any_double", float(any(material.double_sided for material in used))),
        ("reflects", float(bounces > 0 and any(material.reflectance > 0 for material in used))),
        ("transmits", float(transmits)),
        ("refracts", float(refracts)),
        ("blended", float(blended)),
        ("branches", float(refracts or blended)),
    )


def taken(parts: Iterable[Source]) -> tuple[tuple[str, float], ...]:
    """Defines: what the surfaces ask of a point that a ray met."""
    names = {name for part in parts for name in re.findall(r"\bv_(\w+)", part.text)}
    takes = [(f"takes_{name}", float(name in names)) for name in FOUND]
    steps = any(name.endswith("_steps") for name in names)
    return (
        *takes,
        ("takes_steps", float(steps)),
        ("takes_own", float(bool(names & {"uv0", "tangent"}))),
    )


def own_values(defines: Mapping[str, float], parts: Iterable[Source]) -> Records:
    """The records of OBJECT_VALUES: what each object has its own value of, and its type."""
    found = {
        name: kind
        for part in parts
        for name, kind in part.uniforms.items()
        if name in DRAW_NAMES or _TEXTURE.fullmatch(name)
    }
    if defines["reflects"]:
        found["u_reflectance"] = "float"
    if defines["refracts"]:
        found |= {"u_transmittance": "float", "u_refraction": "float"}
    texel, records = FIRST_VALUE, []
    for name in sorted(found):
        matrix = found[name] == "mat3"
        swizzle = "x" if found[name] == "float" else "xyz"
        record = {"type": found[name], "name": name.removeprefix("u_"), "texel": str(texel)}
        records.append({**record, "matrix": str(int(matrix)), "parts": swizzle})
        texel += 3 if matrix else 1
    return tuple(tuple(record.items()) for record in records)


# What a source is assembled with where no ray asks it for a surface.
UNTRACED = {"draws_objects": 0.0, "traced": 0.0, "record": 0.0, **dict(taken(()))}
UNTRACED_LISTS: Mapping[str, Records] = dict.fromkeys(
    ("OBJECTS", "OBJECT_VALUES", "SURFACES", "IMAGE_ARRAYS"), ()
)


def texels_of(values: Records) -> int:
    """How many texels an object takes in the list with these values of its own."""
    return FIRST_VALUE + sum(3 if dict(record)["matrix"] == "1" else 1 for record in values)


def object_list(
    scene: Scene, surfaces: Mapping[int, Surface], given: Values, values: Records,
    meshes: Sequence[str],
) -> list[float]:  # fmt: skip
    """The texels of every object (shaders/stages/list.glsl), as `given` in `object_values`, and of
    the tree about them. Raises SceneError.
    """
    kinds, eye, texels = patterns_of(scene, surfaces), scene.camera.eye, list[float]()
    for index, thing in enumerate(scene.objects.values()):
        material, shape = scene.materials[thing.material], shape_of(thing)
        center, radius = bounding_sphere(scene, thing)
        size = meshes.index(scene.meshes[thing.mesh].mesh) if thing.mesh else thing.scale[0]
        stopped = 0.0 if material.alpha_mode == "blend" else 1.0 - material.transmittance
        stops = -1.0 - stopped if _has_two_sides(material) else 1.0 + stopped
        kind = 2 * kinds.index(_kind(surfaces[id(thing)])) + material.double_sided
        texels += [*matrix.subtract(center, eye), radius * ROOM]
        texels += [SHAPES.index(shape), kind, size, stops]
        texels += _rows(thing, eye)
        for record in map(dict, values):
            value = given.get(f"u_object{index}_{record['name']}", [])
            wide = 9 if record["matrix"] == "1" else 3
            padded = [*value, *([0.0] * (wide - len(value)))]
            for at in range(0, wide, 3):
                texels += [*padded[at : at + 3], 0.0]
    made, wide = float32(texels), 4 * texels_of(values)
    return made + sphere_tree([made[at : at + 4] for at in range(0, len(made), wide)])


def _rows(thing: Object, eye: Sequence[float]) -> list[float]:
    """Three texels: where an object is."""
    if thing.shape == "triangle":
        a, b, c = corners(thing, eye)
        return [*a, 0.0, *matrix.subtract(b, a), 0.0, *matrix.subtract(c, a), 0.0]
    inverse = inverse_matrix(thing, eye)
    return [inverse[4 * column + row] for row in range(3) for column in range(4)]


def image_arrays(
    scene: Scene, surfaces: Mapping[int, Surface], parts: Mapping[Pattern, Source]
) -> list[list[str]]:
    """Names of the textures that the surfaces read: those of one array are alike, but the image."""
    arrays: dict[tuple[object, ...], dict[str, None]] = {}
    for thing in scene.objects.values():
        surface = surfaces[id(thing)]
        for i, used in enumerate(surface.texels):
            if f"u_texture{i}" in parts[_kind(surface)].uniforms:
                texture = scene.textures[used.texture]
                size = texture.image.split("-")[1]
                alike = (size, texture.encoding, texture.wrap, texture.filter)
                arrays.setdefault(alike, {})[used.texture] = None
    return [
        list(names)[first : first + MOST_LAYERS]
        for names in arrays.values()
        for first in range(0, len(names), MOST_LAYERS)
    ]


def image_numbers(arrays: Sequence[Sequence[str]]) -> dict[str, int]:
    """What shaders know textures by: 256 times the array, and the layer in it."""
    return {
        name: MOST_LAYERS * index + layer
        for index, names in enumerate(arrays)
        for layer, name in enumerate(names)
    }


def object_values(
    scene: Scene, surfaces: Mapping[int, Surface], numbers: Mapping[str, int], eye: Sequence[float]
) -> Values:
    """Uniforms of every object, positions about the eye; `numbers` are those of the images."""
    found: Values = {}
    for index, thing in enumerate(scene.objects.values()):
        texels = surfaces[id(thing)].texels
        own = {
            **_place(thing, eye),
            **_sent_on(scene.materials[thing.material]),
            **{f"texture{i}": [numbers.get(used.texture, 0)] for i, used in enumerate(texels)},
            **{f"texture{i}_transform": texture_transform(u) for i, u in enumerate(texels)},
            "object": [index],
            "gap": [0],
        }
        found |= {f"u_object{index}_{name}": float32(value) for name, value in own.items()}
    return found


def _sent_on(material: Material) -> dict[str, Sequence[float]]:
    return {
        **material_values(material),
        "reflectance": [material.reflectance],
        "transmittance": [material.transmittance],
        "refraction": [material.ior or DEFAULT_IOR],
    }


def _place(thing: Object, eye: Sequence[float]) -> dict[str, Sequence[float]]:
    if thing.shape == "triangle":
        a, b, c = corners(thing, eye)
        return {"v0": a, "e1": matrix.subtract(b, a), "e2": matrix.subtract(c, a)}
    return {
        "ball": [*matrix.subtract(thing.position, eye), thing.scale[0]],
        "inverse": inverse_matrix(thing, eye),
    }
