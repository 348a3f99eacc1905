/**
 * Edits of a scene, checked against the JSON schema that the manifest carries.
 *
 * A preset arrives as scene.py wrote it, every default filled in, so only what is edited is checked
 * here: one camera, light, material or object at a time. Messages are those of scene.py.
 */

import { general, SceneError } from "./errors";
import { completed } from "./materials";
import { checkParents, checkPart } from "./scene_parts";
import { color, factors, isNumber, numbers, Problem, pair, parseNumber } from "./scene_types";
import type {
  Camera,
  Manifest,
  Material,
  Part,
  Scene,
  SceneObject,
  SchemaNode,
  SpotLight,
} from "./types";

export type Light = Scene["lights"][string];
type Data = Record<string, unknown>;

/** Groups of a scene that settings may edit, in the order in which they are checked. */
const GROUPS = ["materials", "objects", "lights", "parts"] as const;
const TRUE: readonly unknown[] = [1, "1", "t", "true", "y", "yes", "on"];
const FALSE: readonly unknown[] = [0, "0", "f", "false", "n", "no", "off"];
const INTEGER = /^\s*[+-]?\d+(?:\.0*)?\s*$/;
// Shortest vector with a direction: far above where the square of its length would vanish.
const SHORTEST = 1e-9;

/** The parts of a scene that edits may replace, by path: `camera`, `lights.key`. */
export type Drafts = ReadonlyMap<string, Data>;

/** What a scene is checked against. */
export type Rules = Pick<Manifest, "schema" | "materials">;

/** `scene` with the drafts in place. Throws SceneError with the path of the offending field. */
export function withDrafts(scene: Scene, drafts: Drafts, rules: Rules): Scene {
  try {
    const edited = replaced(scene, drafts, rules);
    checkNames(edited);
    return edited;
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    const where = error.path ? `${error.path}: ` : "";
    throw new SceneError(`settings: ${where}${error.message}`);
  }
}

function replaced(scene: Scene, drafts: Drafts, { schema, materials }: Rules): Scene {
  const node = (name: string) => schema.$defs![name]!;
  const edited: Scene = { ...scene };
  const camera = drafts.get("camera");
  if (camera) edited.camera = validate(node("Camera"), camera, "camera") as unknown as Camera;
  for (const group of GROUPS) {
    const checked = Object.keys(scene[group]).flatMap((name): [string, Data][] => {
      const path = `${group}.${name}`;
      const given = drafts.get(path);
      if (!given) return [];
      const draft = group === "materials" ? completed(given, materials) : given;
      const kind = node(definition(group, draft, path));
      return [[name, validate(kind, draft, path, (data) => checkLibrary(data, path, materials))]];
    });
    if (checked.length) Object.assign(edited, { [group]: merged(scene[group], checked) });
  }
  return edited;
}

function merged(group: object, checked: readonly [string, Data][]): object {
  return { ...group, ...Object.fromEntries(checked) };
}

const LIGHTS = { point: "PointLight", directional: "DirectionalLight", spot: "SpotLight" };

function definition(group: (typeof GROUPS)[number], draft: Data, path: string): string {
  if (group !== "lights") return { materials: "Material", objects: "Object", parts: "Part" }[group];
  const found = Object.entries(LIGHTS).find(([type]) => type === draft.type);
  if (found) return found[1];
  const tags = Object.keys(LIGHTS).map((type) => `'${type}'`);
  throw new Problem(
    path,
    `Input tag '${draft.type}' found using 'type' does not match any of the expected tags: ${tags.join(", ")}`,
  );
}

/** Every field of an object checked, then `names`; defaults filled in, in the schema's order. */
function validate(node: SchemaNode, data: Data, path: string, names = (_: Data) => {}): Data {
  const fields = node.properties ?? {};
  const result: Data = {};
  for (const [name, field] of Object.entries(fields)) {
    const at = `${path}.${name}`;
    if (Object.hasOwn(data, name)) result[name] = validateField(field, data[name], at);
    else if (node.required?.includes(name)) throw new Problem(at, "Field required");
    else result[name] = field.default;
  }
  for (const name of Object.keys(data).filter((key) => !Object.hasOwn(fields, key))) {
    const at = `${path}.${name}`;
    if (typeof node.additionalProperties !== "object") {
      throw new Problem(at, "no such field", [data[name]]);
    }
    result[name] = validateField(node.additionalProperties, data[name], at);
  }
  names(result);
  CHECKS[node.title ?? ""]?.(result, path);
  return result;
}

function validateField(node: SchemaNode, value: unknown, path: string): unknown {
  if (node.anyOf) {
    return value === null || value === "auto" ? null : validateField(node.anyOf[0]!, value, path);
  }
  if (node.prefixItems) return validateTuple(node, value, path);
  if (node.type === "object") return validateTable(value, path);
  if (node.type === "boolean") return validateTruth(value, path);
  if (node.enum ?? node.const) return validateWord(node, value, path);
  if (node.type === "string") return validateText(node, value, path);
  return validateNumber(node, value, path);
}

function validateTuple(node: SchemaNode, value: unknown, path: string): unknown {
  const items = before(node, value, path);
  if (!Array.isArray(items)) throw new Problem(path, "Input should be a valid tuple", [value]);
  const wanted = node.prefixItems!;
  if (items.length > wanted.length) {
    const message = `Tuple should have at most ${wanted.length} items after validation, not ${items.length}`;
    throw new Problem(path, message, [items]);
  }
  const checked = wanted.map((item, index) => {
    const at = `${path}.${index}`;
    if (index >= items.length) throw new Problem(at, "Field required", [items]);
    return validateField(item, items[index], at);
  });
  if (node.kind === "direction" && Math.hypot(...(checked as number[])) < SHORTEST) {
    throw new Problem(path, "a direction must not be zero");
  }
  return checked;
}

/** What a triple or a pair may be written as; several of them have no text. */
function before(node: SchemaNode, value: unknown, path: string): unknown {
  const [first, ...more] = node.prefixItems!;
  if (first!.prefixItems) return value;
  try {
    if (node.kind === "color") return color(value);
    if (node.kind === "factors") return factors(value, 1 + more.length);
    return more.length === 1 ? pair(value) : numbers(value);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    throw new Problem(path, error.message);
  }
}

function validateWord(node: SchemaNode, value: unknown, path: string): unknown {
  const words = node.enum ?? [node.const!];
  if (typeof value === "string" && words.includes(value)) return value;
  const allowed = words.map((word) => `'${word}'`);
  const last = allowed.pop();
  const listed = allowed.length ? `${allowed.join(", ")} or ${last}` : last;
  throw new Problem(path, `Input should be ${listed}`, [value]);
}

function validateText(node: SchemaNode, value: unknown, path: string): unknown {
  if (typeof value !== "string") throw new Problem(path, "Input should be a valid string", [value]);
  if (node.pattern && !new RegExp(node.pattern).test(value)) {
    throw new Problem(path, `String should match pattern '${node.pattern}'`, [value]);
  }
  return value;
}

/** A table within a field, such as a material's maps, cannot be edited: it is there already. */
function validateTable(value: unknown, path: string): unknown {
  if (typeof value === "object" && value !== null && !Array.isArray(value)) return value;
  throw new Problem(path, "Input should be a valid dictionary", [value]);
}

function validateTruth(value: unknown, path: string): boolean {
  const word = typeof value === "string" ? value.toLowerCase() : Number(value);
  const scalar = ["boolean", "string"].includes(typeof value) || Number.isInteger(value);
  if (scalar && TRUE.includes(word)) return true;
  if (scalar && FALSE.includes(word)) return false;
  const close = typeof value === "string" || (scalar && Math.abs(Number(value)) < 2 ** 63);
  const why = close ? ", unable to interpret input" : "";
  throw new Problem(path, `Input should be a valid boolean${why}`, [value]);
}

function validateNumber(node: SchemaNode, value: unknown, path: string): number {
  const number = node.type === "integer" ? toInteger(value, path) : toNumber(value, path);
  if (!Number.isFinite(number)) throw new Problem(path, "Input should be a finite number", [value]);
  const { maximum, minimum } = node;
  if (maximum !== undefined && number > maximum) {
    const message = `Input should be less than or equal to ${digits(maximum)}`;
    throw new Problem(path, message, [value]);
  }
  if (minimum !== undefined && number < minimum) {
    const message = `Input should be greater than or equal to ${digits(minimum)}`;
    throw new Problem(path, message, [value]);
  }
  return number;
}

function toNumber(value: unknown, path: string): number {
  if (typeof value === "number" || typeof value === "boolean") return Number(value);
  if (typeof value !== "string") throw new Problem(path, "Input should be a valid number", [value]);
  if (isNumber(value)) return parseNumber(value);
  const message = "Input should be a valid number, unable to parse string as a number";
  throw new Problem(path, message, [value]);
}

function toInteger(value: unknown, path: string): number {
  const what = "Input should be a valid integer";
  if (typeof value === "string" && INTEGER.test(value)) return Number(value);
  if (typeof value === "string") {
    throw new Problem(path, `${what}, unable to parse string as an integer`, [value]);
  }
  if (typeof value === "boolean") return Number(value);
  if (typeof value !== "number") throw new Problem(path, what, [value]);
  if (Number.isFinite(value) && !Number.isInteger(value)) {
    throw new Problem(path, `${what}, got a number with a fractional part`, [value]);
  }
  return value;
}

/** A limit in full: 1e30 as a one and thirty zeros. */
function digits(limit: number): string {
  const [, mantissa = "", exponent = ""] = /^(\d+)e\+(\d+)$/.exec(`${limit}`) ?? [];
  return mantissa ? mantissa.padEnd(Number(exponent) + 1, "0") : `${limit}`;
}

/** What no single field shows. */
const CHECKS: Readonly<Record<string, (data: Data, path: string) => void>> = {
  Camera: (data, path) => checkFrame(data as unknown as Camera, path),
  Material: (data, path) => checkOneSource(data as unknown as Material, path),
  Object: (data, path) => checkShape(data as unknown as SceneObject, path),
  Part: (data, path) => checkPart(data as unknown as Part, path),
  SpotLight: (data, path) => checkCone(data as unknown as SpotLight, path),
};

function checkFrame({ eye, target, up }: Camera, path: string): void {
  const [x, y, z] = [target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]];
  const cross = Math.hypot(y * up[2] - z * up[1], z * up[0] - x * up[2], x * up[1] - y * up[0]);
  const lengths = [Math.hypot(x, y, z), Math.hypot(...up)] as const;
  if (Math.min(...lengths) < SHORTEST || cross <= 1e-9 * lengths[0] * lengths[1]) {
    const message = "eye, target and up must span a plane: target is the eye or along up";
    throw new Problem(path, message);
  }
}

function checkOneSource({ f0, ior, eta, k }: Material, path: string): void {
  if (f0 !== null && ior !== null) throw new Problem(path, "give f0 or ior, not both");
  if ((eta === null) !== (k === null)) throw new Problem(path, "give both eta and k, or neither");
}

function checkLibrary({ library }: Data, path: string, materials: Manifest["materials"]): void {
  if (typeof library !== "string" || Object.hasOwn(materials, library)) return;
  const known = Object.keys(materials).join(", ");
  throw new Problem(`${path}.library`, `no material '${library}'; there is: ${known}`);
}

function checkShape({ scale, shape, mesh, corners }: SceneObject, path: string): void {
  if (scale.some((s) => s < 1e-6))
    throw new Problem(path, "scale: each factor must be at least 1e-6");
  if ((shape === "mesh") !== (mesh !== null))
    throw new Problem(path, "mesh: name one with shape mesh, and with no other");
  if ((shape === "triangle") !== (corners !== null))
    throw new Problem(path, "corners: give three with shape triangle, and with no other");
}

function checkCone({ inner, outer }: SpotLight, path: string): void {
  if (inner > outer) {
    const message = `inner (${general(inner)} deg) must not exceed outer (${general(outer)} deg)`;
    throw new Problem(path, message);
  }
}

function checkNames(scene: Scene): void {
  for (const [name, { material, mesh }] of Object.entries(scene.objects)) {
    checkKnown(`objects.${name}.material`, "material", material, scene.materials);
    if (mesh !== null) checkKnown(`objects.${name}.mesh`, "mesh", mesh, scene.meshes);
  }
  const { light } = scene.camera;
  if (light !== null) checkKnown("camera.light", "light", light, scene.lights);
  checkParents(scene.parts);
}

function checkKnown(where: string, kind: string, name: string, there: object): void {
  if (Object.hasOwn(there, name)) return;
  const known = Object.keys(there).join(", ");
  throw new Problem("", `${where}: no ${kind} '${name}'; there is: ${known}`);
}
