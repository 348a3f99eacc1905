"""How a material's values vary over an object: which maps, which transparency, which choices.

A `Pattern` is what specialises a program; what it leaves out (which texture, how far moved) are
values of a draw.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from lightbench.front_matter import MATERIAL_FIELDS
from lightbench.library import Library
from lightbench.scene import Object, Scene
from lightbench.scene_surfaces import Map, Material

__all__ = ["NO_PATTERN", "Pattern", "Surface", "pattern_lists", "surface"]

Records = tuple[Mapping[str, str], ...]

# What each field of a material follows from.
SOURCES = {
    "base_color": ("base_color",),
    "metalness": ("metalness",),
    "roughness": ("roughness",),
    "f0": ("base_color", "metalness"),
    "kd": ("base_color", "metalness"),
    "ks": ("base_color", "metalness", "roughness"),
    "shininess": ("roughness",),
    "ambient": (),
    "eta": ("base_color", "metalness"),
    "k": ("base_color", "metalness"),
}
# Fields that a scene's material may give, which then follow from no map.
FIXED = ("ks", "shininess", "eta", "k")
FLAGS = ("BLEND", "DOUBLE_SIDED", "EMITS", "GIVEN_KD", "MASK", "UNLIT", "VERTEX_COLORS")
SLOTS = ("base_color", "roughness", "metalness", "normal", "emissive", "occlusion")
SCALARS = ("roughness", "metalness", "occlusion")


class Texel(NamedTuple):
    """How a texture is read: by which coordinates, transformed or not, mirrored or not."""

    uv: int
    transformed: bool
    mirror_u: bool
    mirror_v: bool


@dataclass(frozen=True)
class Pattern:
    """`maps`: (slot, index of its texel, channels)."""

    choices: tuple[tuple[str, str], ...] = ()
    texels: tuple[Texel, ...] = ()
    maps: tuple[tuple[str, int, str], ...] = ()
    given: tuple[str, ...] = ()
    flags: tuple[str, ...] = ()


NO_PATTERN = Pattern()


@dataclass(frozen=True)
class Surface:
    """A pattern with the maps that its texels are read through."""

    pattern: Pattern
    texels: tuple[Map, ...] = field(default=())


def surface(library: Library, scene: Scene, thing: Object) -> Surface:
    """The surface of an object: its material on its mesh."""
    material = scene.materials[thing.material]
    colors = thing.mesh is not None and scene.meshes[thing.mesh].colors
    texels: dict[tuple[object, ...], tuple[int, Map]] = {}
    maps = []
    for slot in SLOTS:
        if slot in material.maps:
            used = material.maps[slot]
            key = (used.texture, used.uv, used.offset, used.rotation, used.scale)
            index = texels.setdefault(key, (len(texels), used))[0]
            maps.append((slot, index, used.channels))
    bound = tuple(used for _, used in texels.values())
    pattern = Pattern(
        choices=_own_choices(library, material),
        texels=tuple(_texel(scene, used) for used in bound),
        maps=tuple(maps),
        given=tuple(name for name in FIXED if getattr(material, name) is not None),
        flags=tuple(_flags(material, colors=colors)),
    )
    return Surface(pattern, bound)


def _own_choices(library: Library, material: Material) -> tuple[tuple[str, str], ...]:
    own = material.__pydantic_extra__ or {}
    settings = [f.setting for f in library.folders.values() if f.per == "material"]
    return tuple((name, own[name]) for name in sorted(settings) if name in own)


def _texel(scene: Scene, used: Map) -> Texel:
    u, v = scene.textures[used.texture].wrap
    transformed = (*used.offset, used.rotation, *used.scale) != (0, 0, 0, 1, 1)
    return Texel(used.uv, transformed, u == "mirror", v == "mirror")


def _flags(material: Material, *, colors: bool) -> list[str]:
    emits = material.unlit or max(material.emissive) > 0
    found = {
        "BLEND": material.alpha_mode == "blend",
        "DOUBLE_SIDED": material.double_sided,
        "EMITS": emits,
        "GIVEN_KD": material.kd is not None,
        "MASK": material.alpha_mode == "mask",
        "UNLIT": material.unlit,
        "VERTEX_COLORS": colors,
    }
    return [name for name in FLAGS if found[name]]


def pattern_lists(
    pattern: Pattern, fields: Iterable[str], parts: Iterable[str]
) -> tuple[dict[str, Records], dict[str, float]]:
    """The lists and defines that shaders see of a pattern.

    Only of what the files in use read: the material's `fields` and the surface's `parts`.
    """
    varies = _varying(pattern, set(fields))
    slots = _live_slots(pattern, varies, set(parts))
    live = [(slot, texel, channels) for slot, texel, channels in pattern.maps if slot in slots]
    used = {texel for _, texel, _ in live}
    lists: dict[str, Records] = {
        "TEXTURES": tuple(
            {"index": str(i)} | {name: str(int(value)) for name, value in texel._asdict().items()}
            for i, texel in enumerate(pattern.texels)
            if i in used
        ),
        "CONSTANT_FIELDS": tuple({"name": n} for n in MATERIAL_FIELDS if n in set(fields) - varies),
        "UNIFORM_FIELDS": tuple({"type": t, "name": n} for n, t in MATERIAL_FIELDS.items()),
    }
    for slot in SLOTS:
        lists[f"{slot.upper()}_MAPS"] = tuple(
            {"texel": f"texel{texel}", "channel": _channel(slot, channels)}
            for found, texel, channels in live
            if found == slot
        )
    flags = set(pattern.flags) - (set() if "base_color" in slots else {"VERTEX_COLORS"})
    defines = {name: float(name in flags) for name in FLAGS}
    defines |= {f"VARIES_{name.upper()}": float(name in varies) for name in MATERIAL_FIELDS}
    mirrored = any(pattern.texels[i].mirror_u or pattern.texels[i].mirror_v for i in used)
    return lists, defines | {"VARYING": float(bool(varies)), "MIRRORED": float(mirrored)}


def _channel(slot: str, channels: str) -> str:
    return channels[0] if slot in SCALARS else channels


def _varying(pattern: Pattern, fields: set[str]) -> set[str]:
    """The fields that are not the same all over the surface."""
    sources = {slot for slot, _, _ in pattern.maps}
    if "VERTEX_COLORS" in pattern.flags:
        sources.add("base_color")
    return {n for n in fields - set(pattern.given) if sources & set(SOURCES[n])}


def _live_slots(pattern: Pattern, varies: set[str], parts: set[str]) -> set[str]:
    """The slots that something in use follows from."""
    slots = {source for name in varies for source in SOURCES[name]}
    transparent = {"BLEND", "MASK"} & set(pattern.flags)
    if (transparent and "opacity" in parts) or ("UNLIT" in pattern.flags and "emission" in parts):
        slots.add("base_color")
    if "EMITS" in pattern.flags and "UNLIT" not in pattern.flags and "emission" in parts:
        slots.add("emissive")
    return slots | (parts & {"normal", "occlusion"})
