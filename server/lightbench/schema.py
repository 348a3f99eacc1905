"""What crosses to the browser, as types: the manifest, a scene, a plan.

`python -m lightbench.schema` prints their JSON schema, which web/src/core/types.ts is made of.
"""

import json
from typing import Annotated, Any, Literal

from pydantic import Field, JsonValue, TypeAdapter
from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue
from pydantic_core import core_schema
from typing_extensions import TypedDict

from lightbench.library import Library
from lightbench.materials import LibraryMaterial
from lightbench.plan_types import Plan
from lightbench.scene import Scene

__all__ = ["schema"]

SchemaNode = TypedDict(
    "SchemaNode",
    {
        "$ref": str,
        "$defs": dict[str, "SchemaNode"],
        "type": str,
        "title": str,
        "description": str,
        "default": JsonValue,
        "minimum": float,
        "maximum": float,
        "const": str,
        "enum": list[str],
        "pattern": str,
        "prefixItems": list["SchemaNode"],
        "anyOf": list["SchemaNode"],
        "oneOf": list["SchemaNode"],
        "discriminator": dict[str, JsonValue],
        "properties": dict[str, "SchemaNode"],
        "patternProperties": dict[str, "SchemaNode"],
        "additionalProperties": "bool | SchemaNode",
        "required": list[str],
        "kind": str,
        "unit": str,
        "slider": tuple[float, float],
        "scale": str,
    },
    total=False,
)
"""One node of the scene's JSON schema: what the browser checks an edit against."""


class SceneSummary(TypedDict):
    """A preset in the list of scenes."""

    title: str
    about: str


class Manifest(Library):
    """The shader library, the presets, the material library and the JSON schema of a scene."""

    scenes: dict[str, SceneSummary]
    materials: dict[str, LibraryMaterial]
    scene_schema: Annotated[SchemaNode, Field(alias="schema")]


AnyField = core_schema.ModelField | core_schema.DataclassField | core_schema.TypedDictField


class _Generator(GenerateJsonSchema):
    """Every field present, tuples in the form that json-schema-to-typescript reads."""

    def field_title_should_be_set(self, schema: object) -> bool:
        return False

    def field_is_required(self, field: AnyField, total: bool) -> bool:
        return field["type"] != "typed-dict-field" or super().field_is_required(field, total)

    def tuple_schema(self, schema: core_schema.TupleSchema) -> JsonSchemaValue:
        made = super().tuple_schema(schema)
        if "prefixItems" in made:
            made["items"] = made.pop("prefixItems")
        return made

    def dict_schema(self, schema: core_schema.DictSchema) -> JsonSchemaValue:
        made = super().dict_schema(schema)
        for values in made.pop("patternProperties", {}).values():
            made["additionalProperties"] = values
        return made


def schema() -> JsonSchemaValue:
    """The JSON schema of `Manifest`, `Scene` and `Plan`."""
    kinds: dict[str, Any] = {"manifest": Manifest, "scene": Scene, "plan": Plan}
    adapters: list[tuple[str, Literal["serialization"], TypeAdapter[Any]]] = [
        (name, "serialization", TypeAdapter(kind)) for name, kind in kinds.items()
    ]
    found, shared = TypeAdapter.json_schemas(adapters, schema_generator=_Generator)
    shared["$defs"]["Object"]["title"] = "SceneObject"  # TypeScript has an Object of its own
    return {
        **shared,
        "title": "Contracts",
        "description": "All that the browser loads or makes.",
        "type": "object",
        "properties": {name: found[name, "serialization"] for name in kinds},
        "required": list(kinds),
        "additionalProperties": False,
    }


if __name__ == "__main__":
    print(json.dumps(schema(), indent=2))
