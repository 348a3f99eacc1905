"""Materials of a document, as a scene has them."""

import math
from collections.abc import Iterator

from lightbench.errors import ModelError
from lightbench.gltf.meshes import Use
from lightbench.gltf.names import Names
from lightbench.gltf.notes import Notes
from lightbench.gltf.schema import Document, Material, TextureInfo
from lightbench.gltf.textures import Textures

__all__ = ["Materials"]

# The scene's own limits (lightbench.scene): of a normal map's scale, an index of refraction, a
# shift or scale of texture coordinates.
LARGEST_SCALE, LARGEST_IOR, LARGEST_SHIFT = 4.0, 5.0, 1e4
Data = dict[str, object]


class Materials:
    """The materials in use, by name; None is glTF's default material."""

    def __init__(self, document: Document, textures: Textures, notes: Notes) -> None:
        self.entries: dict[str, Data] = {}
        self._document = document
        self._textures = textures
        self._notes = notes
        self._names = Names()
        self._by_index: dict[int | None, str] = {}

    def use(self, index: int | None) -> Use:
        """What a material reads of a mesh."""
        material = self._material(index)
        normal = material.normal_texture
        return Use(normal.uv if normal else 0, 1 in self.sets(index))

    def sets(self, index: int | None) -> set[int]:
        """The sets of texture coordinates that a material's textures need."""
        return {info.uv for *_, info in _textures(self._material(index))}

    def name(self, index: int | None) -> str:
        """The name of a material in the scene, made when first asked for. Raises ModelError."""
        if index not in self._by_index:
            material = self._material(index)
            name = self._names.new(material.name, "plain" if index is None else f"material_{index}")
            self.entries[name] = self._made(material, f"materials[{index}]")
            self._by_index[index] = name
        return self._by_index[index]

    def _material(self, index: int | None) -> Material:
        return Material() if index is None else self._document.materials[index]

    def _made(self, material: Material, where: str) -> Data:
        metallic, more, within = (
            material.pbr_metallic_roughness,
            material.extensions,
            self._notes.within,
        )
        *base_color, opacity = metallic.base_color_factor
        made: Data = {
            "base_color": base_color,
            "metalness": metallic.metallic_factor,
            "roughness": metallic.roughness_factor,
            "emissive": [c * more.strength.emissive_strength for c in material.emissive_factor],
            "opacity": opacity,
            "alpha_mode": material.alpha_mode.lower(),
            "alpha_cutoff": within(material.alpha_cutoff, 0, 1, f"{where}.alphaCutoff"),
            "double_sided": material.double_sided,
            "unlit": more.unlit is not None,
        }
        if more.ior:
            made |= self._ior(more.ior.ior, f"{where}.extensions.KHR_materials_ior.ior")
        if normal := material.normal_texture:
            place = f"{where}.normalTexture.scale"
            made["normal_scale"] = within(normal.scale, 0, LARGEST_SCALE, place)
        if material.occlusion_texture:
            made["occlusion_strength"] = material.occlusion_texture.strength
        return made | {"maps": dict(self._maps(material, where))}

    def _ior(self, ior: float, where: str) -> Data:
        """KHR_materials_ior: 0 stands for a surface that reflects all light at every angle."""
        if ior == 0:
            return {"f0": [1.0, 1.0, 1.0]}
        if ior < 1:
            raise ModelError(f"{where}: {ior:g} is not allowed; allowed are 0, and 1 and more")
        return {"ior": self._notes.within(ior, 1, LARGEST_IOR, where)}

    def _maps(self, material: Material, where: str) -> Iterator[tuple[str, Data]]:
        for slots, encoding, path, info in _textures(material):
            texture = self._textures.name(info.index, encoding)
            if texture is None:
                self._notes.add(f"{where}.{path}: the texture has no image that can be read")
                continue
            moved = self._moved(info, f"{where}.{path}.extensions.KHR_texture_transform")
            for slot, channels in slots.items():
                own = {"texture": texture, "channels": channels, "uv": info.uv}
                yield slot, own | moved

    def _moved(self, info: TextureInfo, where: str) -> Data:
        """KHR_texture_transform as a scene has it: the angle in degrees, -180 to 180."""
        transform = info.transform

        def bounded(pair: tuple[float, float], name: str) -> list[float]:
            shift = LARGEST_SHIFT
            return [self._notes.within(c, -shift, shift, f"{where}.{name}") for c in pair]

        return {
            "offset": bounded(transform.offset, "offset"),
            "rotation": math.degrees(math.remainder(transform.rotation, math.tau)),
            "scale": bounded(transform.scale, "scale"),
        }


def _textures(
    material: Material,
) -> Iterator[tuple[dict[str, str], str, str, TextureInfo]]:
    """(channels by the slot they fill, encoding, path, use) of a material's textures."""
    metallic = material.pbr_metallic_roughness
    for slots, encoding, path, info in (
        ({"base_color": "rgba"}, "srgb", "pbrMetallicRoughness.baseColorTexture",
         metallic.base_color_texture),
        ({"roughness": "g", "metalness": "b"}, "linear",
         "pbrMetallicRoughness.metallicRoughnessTexture", metallic.metallic_roughness_texture),
        ({"normal": "rgba"}, "linear", "normalTexture", material.normal_texture),
        ({"occlusion": "r"}, "linear", "occlusionTexture", material.occlusion_texture),
        ({"emissive": "rgba"}, "srgb", "emissiveTexture", material.emissive_texture),
    ):  # fmt: skip
        if info is not None:
            yield slots, encoding, path, info
