"""Cases for the two planners: random settings, random scenes with made-up assets, mistakes."""

import itertools
import random
from collections.abc import Iterator
from functools import cache
from typing import Any

import lightbench as lb
from lightbench.front_matter import Parameter
from lightbench.materials import materials
from lightbench.scene import Scene
from tests.crowds import CROWDS, crowd_scene
from tests.part_cases import flat_scenes, part_settings, random_parts
from tests.support import library, presets

# Scene, settings, size, and the attachment if it is not the picture.
Case = (
    tuple[str, dict[str, Any], tuple[int, int]] | tuple[str, dict[str, Any], tuple[int, int], str]
)
SIZE = (64, 48)
RANDOM_CASES = 200
RANDOM_SCENES = 40
# Of images, which are layers of one texture where they are alike.
SIZES = ("512x512", "512x256")
SLOTS = ("base_color", "roughness", "metalness", "normal", "emissive", "occlusion")


def number(chance: random.Random, parameter: Parameter) -> Any:
    low, high = parameter.range or (0.0, 1.0)
    return (
        chance.randint(int(low), int(high))
        if parameter.kind == "int"
        else chance.uniform(low, high)
    )


def color(chance: random.Random) -> Any:
    if chance.random() < 0.5:
        return f"#{chance.randrange(1 << 24):06x}"
    return [chance.random() for _ in range(3)]


def menu_settings(chance: random.Random) -> dict[str, Any]:
    """A choice of every folder, and a few parameters."""
    menu = library()
    chosen = {f.setting: chance.choice(menu.choices(name)) for name, f in menu.folders.items()}
    known = {k: p for file in menu.files.values() for k, p in file.meta.parameters.items()}
    for name in chance.sample(sorted(known), k=min(4, len(known))):
        parameter = known[name]
        if parameter.kind in ("float", "int"):
            chosen[name] = number(chance, parameter)
        elif parameter.kind == "bool":
            chosen[name] = chance.choice(["true", "false"])
        else:
            chosen[name] = color(chance)
    return chosen


def vector(chance: random.Random, reach: float) -> Any:
    values = [chance.uniform(-reach, reach) for _ in range(3)]
    return values if chance.random() < 0.5 else ",".join(map(repr, values))


def angles(chance: random.Random) -> list[float]:
    """Round angles too: their sines cancel."""
    return [chance.choice([0, 30, 45, 60, 90, 180, chance.uniform(-360, 360)]) for _ in range(3)]


def shape_settings(chance: random.Random, at: str) -> dict[str, Any]:
    """Another shape, with corners where it has some."""
    shape = chance.choice(["plane", "cube", "sphere", "cone", "triangle"])
    none = chance.choice([None, "auto"])
    corners = [vector(chance, 3) for _ in range(3)] if shape == "triangle" else none
    return {f"{at}.shape": shape, f"{at}.corners": corners}


def surface_settings(chance: random.Random, at: str) -> dict[str, Any]:
    """What a material is beyond its colour: how it lets light through, and its own choices."""
    menu = library()
    edits: dict[str, Any] = {
        f"{at}.alpha_mode": chance.choice(["opaque", "mask", "blend"]),
        f"{at}.alpha_cutoff": chance.random(),
        f"{at}.opacity": chance.random(),
        f"{at}.double_sided": chance.choice([True, "off"]),
        f"{at}.unlit": chance.random() < 0.2,
        f"{at}.emissive": chance.choice([[0, 0, 0], color(chance)]),
        f"{at}.normal_scale": chance.uniform(0, 4),
        f"{at}.occlusion_strength": chance.random(),
        f"{at}.ambient": chance.choice([[0, 0, 0], color(chance)]),
        f"{at}.reflectance": chance.choice([0, chance.random()]),
        f"{at}.transmittance": chance.choice([0, 0, chance.random()]),
    }
    for name, folder in menu.folders.items():
        if folder.per == "material" and chance.random() < 0.3:
            edits[f"{at}.{folder.setting}"] = chance.choice(menu.choices(name))
    return edits


def scene_settings(chance: random.Random, there: Scene) -> dict[str, Any]:
    """Edits of the camera and of one of each kind of thing."""
    edits: dict[str, Any] = {}
    if chance.random() < 0.7:
        edits["camera.eye"] = vector(chance, 10)
        edits["camera.fov"] = chance.uniform(1, 170)
        edits["camera.projection"] = chance.choice(["perspective", "orthographic"])
        edits["camera.height"] = chance.uniform(0.01, 100)
        edits["camera.fov_of"] = chance.choice(["height", "width"])
        edits["camera.mirrored"] = chance.choice([True, "off"])
        edits["camera.light"] = chance.choice(["auto", None, *there.lights])
    for name, light in there.lights.items():
        edits[f"lights.{name}.intensity"] = chance.uniform(0, 1000)
        edits[f"lights.{name}.color"] = color(chance)
        edits[f"lights.{name}.casts"] = chance.choice([True, "yes", "false", 0])
        edits[f"lights.{name}.far"] = chance.choice([None, "auto", chance.uniform(0.1, 50)])
        if light.type == "point":
            edits[f"lights.{name}.type"] = chance.choice(["point", "spot"])
        if light.type == "spot":
            edits[f"lights.{name}.outer"] = chance.choice([light.inner, 75, 75.5, 180])
        if light.type != "directional":
            edits[f"lights.{name}.unit"] = chance.choice(["candela", "lumen"])
    if there.objects:
        edits |= object_settings(chance, there)
    if there.parts:
        edits |= part_settings(chance, there)
    return edits


def object_settings(chance: random.Random, there: Scene) -> dict[str, Any]:
    """Edits of a material and of an object."""
    edits: dict[str, Any] = {}
    name = chance.choice(sorted(there.materials))
    edits[f"materials.{name}.roughness"] = chance.random()
    edits[f"materials.{name}.metalness"] = str(chance.random())
    edits[f"materials.{name}.base_color"] = color(chance)
    edits[f"materials.{name}.shininess"] = chance.choice([None, "auto", chance.uniform(0, 1e4)])
    if chance.random() < 0.3:
        edits[f"materials.{name}.eta"] = [chance.uniform(0.1, 5) for _ in range(3)]
        edits[f"materials.{name}.k"] = chance.choice(["0,3,4.5", [3, 2, 1]])
    edits |= surface_settings(chance, f"materials.{name}")
    name = chance.choice(sorted(there.objects))
    edits[f"objects.{name}.rotation"] = angles(chance)
    edits[f"objects.{name}.scale"] = chance.choice(["2", chance.uniform(0.1, 5), "1,2,0.5"])
    if there.objects[name].mesh is None:
        edits |= shape_settings(chance, f"objects.{name}")
    return edits


def random_cases() -> Iterator[Case]:
    chance = random.Random(20240229)
    for _ in range(RANDOM_CASES):
        name = chance.choice(presets())
        there = lb.load(name)
        settings = menu_settings(chance) | scene_settings(chance, there)
        yield name, settings, (chance.randint(1, 2000), chance.randint(1, 2000))


def library_cases() -> Iterator[Case]:
    """Materials of the library, alone and under other edits in either order."""
    for name, other in itertools.product(presets(), materials()):
        material = next(iter(lb.load(name).materials), None)
        if material is None:
            continue
        at = f"materials.{material}"
        yield name, {f"{at}.library": other}, SIZE
        more = {f"{at}.f0": [0.3, 0.2, 0.1], f"{at}.shininess": "auto"}
        yield name, {f"{at}.library": other} | more, SIZE
        yield name, more | {f"{at}.library": other}, SIZE
        yield name, {f"{at}.library": None, f"{at}.ior": 1.7}, SIZE


def random_map(chance: random.Random) -> dict[str, Any]:
    """A texture over a surface; half of them not transformed."""
    some = {
        "offset": [chance.uniform(-2, 2), 0],
        "rotation": chance.choice([0, 90, chance.uniform(-360, 360)]),
        "scale": [chance.uniform(0.1, 4), 1],
    }
    return {
        "texture": chance.choice(["bricks", "cloth", "dents"]),
        "channels": chance.choice(["rgba", "r", "g", "b", "a"]),
        "uv": chance.choice([0, 1]),
        **(some if chance.random() < 0.5 else {}),
    }


def random_scene(chance: random.Random) -> Scene:
    """A preset with textures on its materials and meshes for some of its objects.

    The plan needs no asset: these have none.
    """
    data: Any = lb.load(chance.choice(presets())).data()
    for name in ("bricks", "cloth", "dents"):
        data["textures"][name] = {
            "image": f"image-{chance.choice(SIZES)}-{chance.randrange(1 << 128):032x}",
            "encoding": chance.choice(["srgb", "linear"]),
            "wrap": [chance.choice(["repeat", "clamp", "mirror"]) for _ in range(2)],
            "filter": chance.choice(["linear", "nearest"]),
        }
    for name in ("statue", "table"):
        low = [chance.uniform(-2, 0) for _ in range(3)]
        data["meshes"][name] = {
            "mesh": f"mesh-{chance.randrange(1 << 128):032x}",
            "low": low,
            "high": [c + chance.random() for c in low],
            "colors": chance.random() < 0.5,
            "uv1": chance.random() < 0.5,
        }
    for material in data["materials"].values():
        slots = chance.sample(SLOTS, k=chance.randint(0, len(SLOTS)))
        material["maps"] = {slot: random_map(chance) for slot in slots}
        material["kd"] = chance.choice([None, [0.1, 0.2, 0.3]])
    data["camera"] |= {
        "fov_of": chance.choice(["height", "width"]),
        "mirrored": chance.random() < 0.5,
    }
    meshes = chance.random() < 0.5
    for thing in data["objects"].values():
        thing |= random_shape(chance, meshes=meshes)
    if chance.random() < 0.5:
        data["parts"] = random_parts(chance)
    return Scene.parse(data)


def random_shape(chance: random.Random, *, meshes: bool) -> dict[str, Any]:
    """What makes an object a mesh or a triangle; nothing for most."""
    if meshes and chance.random() < 0.3:
        return {"shape": "mesh", "mesh": chance.choice(["statue", "table"]), "corners": None}
    if chance.random() < 0.2:
        corners = [[chance.uniform(-2, 2) for _ in range(3)] for _ in range(3)]
        return {"shape": "triangle", "corners": corners, "mesh": None}
    return {}


@cache
def random_scenes() -> dict[str, Scene]:
    """Random scenes by name."""
    chance = random.Random(20250101)
    return {f"random-{n}": random_scene(chance) for n in range(RANDOM_SCENES)}


def crowd() -> Scene:
    """A scene of more lights than a shader has texture units."""
    data: Any = lb.load("box-room").data()
    lamp = data["lights"]["lamp"]
    data |= {"lights": {f"lamp{n}": lamp for n in range(17)}, "views": {}}
    return Scene.parse(data)


@cache
def crowds() -> dict[str, Scene]:
    """Scenes of many objects, of every size and in every place."""
    return {f"many-{name}": crowd_scene(balls, [{}], 0.1) for name, balls in CROWDS.items()}


@cache
def scenes() -> dict[str, Scene]:
    """Every scene of the cases: the presets, the random ones and the crowd."""
    every = {name: lb.load(name) for name in presets()}
    return {**every, **random_scenes(), **flat_scenes(), **crowds(), "crowd": crowd()}


def part_cases() -> Iterator[Case]:
    """The robot and every scene of parts alone, as they are and under settings."""
    chance = random.Random(8)
    for name, there in {"lab/robot": lb.load("lab/robot"), **flat_scenes()}.items():
        yield name, {}, (chance.randint(1, 2000), chance.randint(1, 2000))
        for _ in range(4):
            settings = menu_settings(chance) | part_settings(chance, there)
            yield name, settings, (chance.randint(1, 2000), chance.randint(1, 2000))


def random_scene_cases() -> Iterator[Case]:
    """Each random scene as it is, and under settings."""
    chance = random.Random(7)
    for name, there in random_scenes().items():
        yield name, {}, SIZE
        for _ in range(2):
            settings = menu_settings(chance)
            yield name, settings | scene_settings(chance, there), SIZE
