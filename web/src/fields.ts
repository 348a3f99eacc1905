// Names of settings: what a name stands for, its kind, its default. No values of a session here.
import { isHex, toHex } from "./color";
import { parameters } from "./core/library";
import { LIBRARY_FIELDS } from "./core/materials";
import type { Manifest, Parameter, Scene, SchemaNode } from "./core/types";

export type Value = number | boolean | string | number[];
export type Values = Readonly<Record<string, Value>>;
/** What stands in a link, a query string or a file for "follows from the other fields". */
export const AUTO = "auto";

/** The part of the schema that describes a field of the scene, such as `lights.key.intensity`. */
export function fieldSchema(manifest: Manifest, scene: Scene, name: string): SchemaNode | null {
  const [group = "", member = "", field = ""] = name.split(".");
  const definitions = manifest.schema.$defs ?? {};
  const kinds: Record<string, string> = {
    ...{ materials: "Material", objects: "Object", parts: "Part" },
  };
  if (group === "camera") return definitions.Camera?.properties?.[member] ?? null;
  const type = group === "lights" ? scene.lights[member]?.type : undefined;
  const kind = type ? `${type[0]?.toUpperCase()}${type.slice(1)}Light` : kinds[group];
  return definitions[kind ?? ""]?.properties?.[field] ?? null;
}

/** A field's schema without the `null` that stands for "auto". */
export function given(node: SchemaNode): SchemaNode {
  return node.anyOf?.find((option) => option.type !== "null") ?? node;
}

export function isOptional(node: SchemaNode | null): boolean {
  return node?.anyOf?.some((option) => option.type === "null") ?? false;
}

/** The parameter of this name; for `lights.key.c0`, the parameter c0. */
export function parameterOf(manifest: Manifest, name: string): Parameter | null {
  const [group, , extra] = name.split(".");
  const wanted = group === "lights" ? extra : name;
  return parameters(manifest).find(([key]) => key === wanted)?.[1] ?? null;
}

/** What the scene holds at a path; undefined where it holds nothing. */
export function valueAt(scene: Scene, path: string): unknown {
  const step = (at: unknown, key: string) =>
    typeof at === "object" && at !== null ? (at as Record<string, unknown>)[key] : undefined;
  return path.split(".").reduce(step, scene as unknown);
}

/** What a setting is where nobody gave it: the scene's own, else the menu's. */
export function defaultOf(manifest: Manifest, scene: Scene, name: string, above: Values): Value {
  const own = scene.settings[name];
  if (own !== undefined) return own;
  if (name.includes(".")) {
    const value = ofLibrary(manifest, name, above) ?? valueAt(scene, name);
    if (value === null) return AUTO;
    if (value !== undefined) return value as Value;
    if (name.startsWith("materials.")) return AUTO; // a choice that is the scene's
    const extra = name.split(".")[2] ?? "";
    return above[extra] ?? defaultOf(manifest, scene, extra, above);
  }
  const folder = Object.values(manifest.folders).find((f) => f.setting === name);
  return folder?.default ?? (parameterOf(manifest, name)?.default as Value | undefined) ?? AUTO;
}

/** What a material's field is by the library material that the settings name; else undefined. */
function ofLibrary(manifest: Manifest, name: string, above: Values): unknown {
  const [group, material, field = ""] = name.split(".");
  const named = above[`${group}.${material}.library`];
  if (group !== "materials" || typeof named !== "string") return undefined;
  const found = manifest.materials[named];
  if (!found || !(field in found)) return undefined;
  return found[field as keyof typeof found] ?? AUTO;
}

/** Whether a setting is of a material, and such as a library material brings along. */
export function isLibraryField(name: string): boolean {
  const [group, , field = ""] = name.split(".");
  return group === "materials" && (LIBRARY_FIELDS as readonly string[]).includes(field);
}

/** A value from the text of a link; text that is no such value is kept for the error message. */
export function parse(manifest: Manifest, scene: Scene, name: string, text: string): Value {
  const parameter = parameterOf(manifest, name);
  const node = given(fieldSchema(manifest, scene, name) ?? {});
  const kind = parameter?.kind ?? node.kind ?? node.type;
  if ((kind === "bool" || kind === "boolean") && /^(true|1|false|0)$/i.test(text))
    return /^(true|1)$/i.test(text);
  if (kind === "color" && isHex(text)) return text.replace("#", "").toLowerCase();
  if (kind === "color" || kind === "array") return numbers(text) ?? text;
  if (kind === "factors") return factors(text, node) ?? text;
  if (kind === "float" || kind === "int" || kind === "number" || kind === "integer") {
    return number(text) ?? text;
  }
  return text;
}

function numbers(text: string): number[] | null {
  const parts = text.split(",").map(number);
  return parts.every((part) => part !== null) ? parts : null;
}

/** A lone factor stands for all. */
function factors(text: string, { prefixItems = [] }: SchemaNode): number[] | null {
  const given = numbers(text);
  return given?.length === 1 ? prefixItems.map(() => given[0]!) : given;
}

function number(text: string): number | null {
  const value = Number(text);
  return text.trim() !== "" && Number.isFinite(value) ? value : null;
}

/** Whether two values of a setting mean the same; colours by the code that a link would carry. */
export function same(a: Value, b: Value): boolean {
  if (isHex(a) || isHex(b)) return text(a) === text(b);
  return String(a) === String(b);
}

function text(value: Value): string {
  return Array.isArray(value) && value.every((c) => c <= 1)
    ? toHex(value)
    : String(value).replace("#", "").toLowerCase();
}
