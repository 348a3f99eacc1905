"""A glTF document parsed and checked: every reference in range, every node in one tree."""

import re
from collections.abc import Iterator, Sequence

from pydantic import ValidationError
from pydantic.alias_generators import to_camel

from lightbench.errors import ModelError
from lightbench.gltf import schema
from lightbench.gltf.limits import Budget

__all__ = ["SUPPORTED", "parse"]

# Extensions that a file may require.
SUPPORTED = frozenset({
    "EXT_meshopt_compression", "EXT_texture_webp", "KHR_draco_mesh_compression",
    "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_meshopt_compression",
    "KHR_texture_transform",
})  # fmt: skip

# Objects and values in the JSON text: several times what the largest allowed scene has.
MOST_OBJECTS, MOST_VALUES = 500_000, 4_000_000

Reference = tuple[str, int | None, str]


def parse(text: bytes, budget: Budget) -> schema.Document:
    """The document of a JSON text. Raises ModelError for the first thing that is wrong."""
    _check_size(text)
    try:
        document = schema.Document.model_validate_json(text)
    except ValidationError as error:
        raise ModelError(_problem(error)) from None
    _check_version(document)
    _check_extensions(document)
    _check_counts(document, budget)
    _check_references(document)
    _check_tree(document)
    return document


def _check_size(text: bytes) -> None:
    """Refuse a flood of values before any is made; data URIs count for no more than their file."""
    for sign, what, allowed in ((b"{", "objects", MOST_OBJECTS), (b",", "values", MOST_VALUES)):
        if (found := text.count(sign)) > allowed:
            raise ModelError(f"JSON: {found} {what}; allowed are {allowed}")


def _problem(error: ValidationError) -> str:
    """`accessors[3].byteOffset: what is wrong (given what)`."""
    first = error.errors(include_url=False)[0]
    if first["type"] == "json_invalid":
        reason = first["msg"].removeprefix("Invalid JSON: ")
        return f"JSON: {reason}; allowed are glTF 2.0 (.gltf) and binary glTF (.glb)"
    path = "".join(f"[{k}]" if isinstance(k, int) else f".{_printable(k)}" for k in first["loc"])
    given = "" if isinstance(first["input"], dict | list) else f" (given {_cut(first['input'])})"
    message = "is missing" if first["type"] == "missing" else first["msg"] + given
    return f"{path.lstrip('.') or 'JSON'}: {message}"


def _printable(key: str) -> str:
    return re.sub(r"[^!-~]", "?", key)[:64]


def _cut(value: object) -> str:
    text = ascii(value)
    return text if len(text) <= 40 else f"{text[:37]}..."


def _check_version(document: schema.Document) -> None:
    asset = document.asset
    if not re.fullmatch(r"2\.\d+", asset.version, re.ASCII):
        raise ModelError(f"asset.version: glTF {_cut(asset.version)}; allowed is '2.0'")
    if asset.min_version not in (None, "2.0"):
        raise ModelError(f"asset.minVersion: glTF {_cut(asset.min_version)}; allowed is '2.0'")


def _check_extensions(document: schema.Document) -> None:
    for index, name in enumerate(document.extensions_required):
        if name not in SUPPORTED:
            known = ", ".join(sorted(SUPPORTED))
            raise ModelError(
                f"extensionsRequired[{index}]: no support for {_cut(name)}; there is for: {known}"
            )


def _check_counts(document: schema.Document, budget: Budget) -> None:
    limits = budget.limits
    for name, parts, allowed in (
        ("nodes", document.nodes, limits.nodes),
        ("meshes", document.meshes, limits.nodes),
        ("materials", document.materials, limits.materials),
    ):
        if len(parts) > allowed:
            raise ModelError(f"{name}: there are {len(parts)}; allowed are {allowed}")


def _check_references(document: schema.Document) -> None:
    sizes = {
        name: len(getattr(document, name))
        for name in (
            "accessors", "buffer_views", "buffers", "cameras", "images", "lights", "materials",
            "meshes", "nodes", "samplers", "scenes", "skins", "textures",
        )
    }  # fmt: skip
    for where, index, target in _references(document):
        if index is not None and index >= sizes[target]:
            raise ModelError(
                f"{where}: there is no {to_camel(target)}[{index}]; there are {sizes[target]}"
            )


def _references(document: schema.Document) -> Iterator[Reference]:
    """(path, index, list that it points into) of every reference."""
    yield "scene", document.scene, "scenes"
    for i, scene in enumerate(document.scenes):
        yield from _each(f"scenes[{i}].nodes", scene.nodes, "nodes")
    for i, node in enumerate(document.nodes):
        yield from _of_node(f"nodes[{i}]", node)
    for i, mesh in enumerate(document.meshes):
        for j, primitive in enumerate(mesh.primitives):
            yield from _of_primitive(f"meshes[{i}].primitives[{j}]", primitive)
    for i, skin in enumerate(document.skins):
        yield f"skins[{i}].inverseBindMatrices", skin.inverse_bind_matrices, "accessors"
        yield from _each(f"skins[{i}].joints", skin.joints, "nodes")
    for i, material in enumerate(document.materials):
        yield from _of_material(f"materials[{i}]", material)
    yield from _of_data(document)


def _each(where: str, indices: Sequence[int], target: str) -> Iterator[Reference]:
    yield from ((f"{where}[{i}]", index, target) for i, index in enumerate(indices))


def _of_node(where: str, node: schema.Node) -> Iterator[Reference]:
    yield from _each(f"{where}.children", node.children, "nodes")
    yield f"{where}.mesh", node.mesh, "meshes"
    yield f"{where}.skin", node.skin, "skins"
    yield f"{where}.camera", node.camera, "cameras"
    if node.extensions.punctual:
        light = node.extensions.punctual.light
        yield f"{where}.extensions.KHR_lights_punctual.light", light, "lights"


def _of_primitive(where: str, primitive: schema.Primitive) -> Iterator[Reference]:
    for name, index in primitive.attributes.items():
        yield f"{where}.attributes.{_printable(name)}", index, "accessors"
    yield f"{where}.indices", primitive.indices, "accessors"
    yield f"{where}.material", primitive.material, "materials"
    if primitive.extensions.draco:
        place = f"{where}.extensions.KHR_draco_mesh_compression.bufferView"
        yield place, primitive.extensions.draco.buffer_view, "buffer_views"


def _of_material(where: str, material: schema.Material) -> Iterator[Reference]:
    metallic = material.pbr_metallic_roughness
    for name, info in (
        ("pbrMetallicRoughness.baseColorTexture", metallic.base_color_texture),
        ("pbrMetallicRoughness.metallicRoughnessTexture", metallic.metallic_roughness_texture),
        ("normalTexture", material.normal_texture),
        ("occlusionTexture", material.occlusion_texture),
        ("emissiveTexture", material.emissive_texture),
    ):
        if info:
            yield f"{where}.{name}.index", info.index, "textures"


def _of_data(document: schema.Document) -> Iterator[Reference]:
    for i, texture in enumerate(document.textures):
        yield f"textures[{i}].source", texture.image, "images"
        yield f"textures[{i}].sampler", texture.sampler, "samplers"
    for i, image in enumerate(document.images):
        yield f"images[{i}].bufferView", image.buffer_view, "buffer_views"
    for i, accessor in enumerate(document.accessors):
        where = f"accessors[{i}]"
        yield f"{where}.bufferView", accessor.buffer_view, "buffer_views"
        if accessor.sparse:
            indices, values = accessor.sparse.indices, accessor.sparse.values
            yield f"{where}.sparse.indices.bufferView", indices.buffer_view, "buffer_views"
            yield f"{where}.sparse.values.bufferView", values.buffer_view, "buffer_views"
    for i, view in enumerate(document.buffer_views):
        yield f"bufferViews[{i}].buffer", view.buffer, "buffers"
        if view.meshopt:
            yield f"bufferViews[{i}].extensions.buffer", view.meshopt.buffer, "buffers"


def _check_tree(document: schema.Document) -> None:
    """Each node has one parent at most, is not its own ancestor, and a scene lists only roots."""
    parents: dict[int, int] = {}
    for i, node in enumerate(document.nodes):
        for j, child in enumerate(node.children):
            if child in parents:
                raise ModelError(
                    f"nodes[{i}].children[{j}]: node {child} is already a child of "
                    f"nodes[{parents[child]}]; a node has one parent"
                )
            parents[child] = i
    _check_cycles(document, parents)
    for i, scene in enumerate(document.scenes):
        listed: set[int] = set()
        for j, root in enumerate(scene.nodes):
            where = f"scenes[{i}].nodes[{j}]"
            if root in parents:
                raise ModelError(f"{where}: node {root} has a parent; a scene lists roots")
            if root in listed:
                raise ModelError(f"{where}: node {root} is listed twice")
            listed.add(root)


def _check_cycles(document: schema.Document, parents: dict[int, int]) -> None:
    reached = [i for i in range(len(document.nodes)) if i not in parents]
    for node in reached:
        reached.extend(document.nodes[node].children)
    missed = set(range(len(document.nodes))) - set(reached)
    if missed:
        raise ModelError(f"nodes[{_on_cycle(min(missed), parents)}]: is its own ancestor")


def _on_cycle(node: int, parents: dict[int, int]) -> int:
    """The least node of the cycle that `node` hangs on."""
    for _ in parents:
        node = parents[node]
    cycle = {node}
    while (node := parents[node]) not in cycle:
        cycle.add(node)
    return min(cycle)
