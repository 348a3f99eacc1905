/**
 * Settings: a flat {name: value} over the menu (`model`, `L_white`) and the scene (`camera.fov`).
 * Twin of settings.py.
 */

import { general, SceneError, SettingError, shown } from "./errors";
import { choices, type Library, ofMaterials, parameters } from "./library";
import { withoutLibraryFields } from "./materials";
import { withDrafts } from "./scene";
import { color, parseNumber } from "./scene_types";
import type { Manifest, Parameter, Scene } from "./types";
import { lightCamera } from "./viewpoint";

export type Setting = number | string | boolean | null | readonly number[];
export type Settings = Readonly<Record<string, Setting>>;
export type Value = number | readonly [number, number, number];

/** A scene with its edits, one file for each choice setting, one value for each parameter. */
export interface Resolved {
  readonly scene: Scene;
  readonly choices: Readonly<Record<string, string>>;
  readonly values: Readonly<Record<string, Value>>;
}

/** How many names lead to a field of each group. */
const DEPTH: Readonly<Record<string, number>> = {
  ...{ camera: 1, lights: 2, materials: 2, objects: 2, parts: 2 },
};
/** Groups whose members may have more fields than the scene gives them. */
const OPEN = ["lights", "materials"];

/**
 * Defaults of the menu, under the scene's own settings, under `given`.
 *
 * Throws SettingError for an unknown name or a value that is not allowed, saying what is, and
 * SceneError for an edit that the scene refuses.
 */
export function resolve(manifest: Manifest, scene: Scene, given: Settings): Resolved {
  const wanted = Object.entries({ ...scene.settings, ...given });
  const edits = wanted.filter(([name]) => name.includes("."));
  const menu = new Map(wanted.filter(([name]) => !name.includes(".")));
  const changed = withEdits(scene, edits, manifest);
  const chosen: Record<string, string> = {};
  for (const [name, folder] of Object.entries(manifest.folders)) {
    const value = menu.has(folder.setting) ? menu.get(folder.setting)! : folder.default;
    chosen[folder.setting] = choose(manifest, name, value);
    menu.delete(folder.setting);
  }
  const edited = fromLight(changed);
  const active = activeParameters(manifest, everyChoice(manifest, chosen, edited));
  checkNames(manifest, menu);
  const values: Record<string, Value> = {};
  for (const [name, parameter] of active) {
    const value = menu.has(name) ? menu.get(name)! : parameter.default;
    values[name] = checkedValue(name, parameter, value);
  }
  checkLights(manifest, edited);
  return { scene: edited, choices: chosen, values };
}

function choose(library: Library, folder: string, value: Setting): string {
  const allowed = choices(library, folder);
  if (typeof value === "string" && allowed.includes(value)) return value;
  const { setting } = library.folders[folder]!;
  throw new SettingError(`${setting}: no '${bare(value)}'; allowed are: ${allowed.join(", ")}`);
}

/** A value inside quotes. */
function bare(value: Setting): string {
  return typeof value === "string" ? value : shown(value);
}

/** The scene as its camera shows it: from a light, if it says so. */
function fromLight(scene: Scene): Scene {
  const { light } = scene.camera;
  return light === null ? scene : { ...scene, camera: lightCamera(scene, scene.lights[light]!) };
}

/** The choices in use by setting: the frame's, and those that materials make for themselves. */
function everyChoice(
  manifest: Manifest,
  chosen: Readonly<Record<string, string>>,
  scene: Scene,
): ReadonlyMap<string, ReadonlySet<string>> {
  const every = new Map(
    Object.entries(chosen).map(([setting, choice]) => [setting, new Set([choice])]),
  );
  const fields = manifest.schema.$defs?.Material?.properties ?? {};
  const own = ofMaterials(manifest);
  for (const [material, values] of Object.entries(scene.materials)) {
    for (const [setting, choice] of Object.entries(values)) {
      if (Object.hasOwn(fields, setting)) continue;
      const folder = own.get(setting);
      if (folder === undefined) {
        throw new SettingError(
          `materials.${material}.${setting}: no such field; beside its own fields a ` +
            `material may have: ${[...own.keys()].join(", ")}`,
        );
      }
      every.get(setting)!.add(choose(manifest, folder, choice as Setting));
    }
  }
  return every;
}

/** The parameters of the chosen files, of passes and of lib. */
function activeParameters(
  library: Library,
  chosen: ReadonlyMap<string, ReadonlySet<string>>,
): ReadonlyMap<string, Parameter> {
  const found = new Map<string, Parameter>();
  for (const [path, file] of Object.entries(library.files)) {
    const [folder = "", name = ""] = path.split(/\/(.*)/s);
    const menu = library.folders[folder];
    if (menu && !chosen.get(menu.setting)!.has(name.replace(/\.glsl$/, ""))) continue;
    for (const [key, parameter] of Object.entries(file.meta.parameters)) found.set(key, parameter);
  }
  return found;
}

function checkNames(library: Library, menu: ReadonlyMap<string, Setting>): void {
  const known = new Set(parameters(library).map(([name]) => name));
  for (const name of menu.keys()) {
    if (known.has(name)) continue;
    const folders = Object.values(library.folders).map((folder) => folder.setting);
    const settings = [...known, ...folders].sort().join(", ");
    throw new SettingError(
      `no setting '${name}'; there is: ${settings}, and the scene's own such ` +
        "as camera.fov, lights.NAME.intensity, materials.NAME.roughness",
    );
  }
}

/** The fields that scene.py gives every light of a type. */
function ownFields(manifest: Manifest, type: string): readonly string[] {
  const nodes = Object.values(manifest.schema.$defs ?? {});
  const found = nodes.find((node) => node.properties?.type?.const === type);
  return Object.keys(found?.properties ?? {});
}

function checkLights(manifest: Manifest, scene: Scene): void {
  const known = new Map(parameters(manifest).filter(([, parameter]) => parameter.per === "light"));
  for (const [name, light] of Object.entries(scene.lights)) {
    const own = ownFields(manifest, light.type);
    for (const [extra, value] of Object.entries(light)) {
      if (own.includes(extra)) continue;
      const parameter = known.get(extra);
      if (!parameter) {
        const allowed = [...own, ...[...known.keys()].sort()].join(", ");
        throw new SceneError(`lights.${name}.${extra}: no such field; allowed are: ${allowed}`);
      }
      checkedValue(`lights.${name}.${extra}`, parameter, value as Setting);
    }
  }
}

function checkedValue(name: string, parameter: Parameter, value: Setting): Value {
  if (parameter.kind === "color") return colorOf(name, value);
  if (parameter.kind === "bool") return truth(name, value);
  const [low, high] = parameter.range ?? [-Infinity, Infinity];
  const number = numberOf(value);
  const fits = low <= number && number <= high;
  if (!fits || (parameter.kind === "int" && !Number.isInteger(number))) {
    const whole = parameter.kind === "int" ? "a whole number" : "a number";
    const unit = parameter.unit ? ` ${parameter.unit}` : "";
    const range = `from ${general(low)} to ${general(high)}${unit}`;
    throw new SettingError(`${name}: ${shown(value)} is not ${whole} ${range}`);
  }
  return number + 0; // -0 becomes 0
}

function numberOf(value: unknown): number {
  if (typeof value === "string") return parseNumber(value);
  return typeof value === "number" ? value : Number.NaN;
}

function truth(name: string, value: Setting): number {
  const word = `${value}`.toLowerCase();
  if (word === "true" || word === "1") return 1;
  if (word === "false" || word === "0") return 0;
  throw new SettingError(`${name}: ${shown(value)} is not true or false`);
}

function colorOf(name: string, value: Setting): readonly [number, number, number] {
  const channels = decoded(name, value);
  if (!Array.isArray(channels) || channels.length !== 3) {
    const allowed = "write #rrggbb (sRGB) or r,g,b (linear)";
    throw new SettingError(`${name}: ${shown(value)} is no colour; ${allowed}`);
  }
  const [r, g, b] = channels.map(numberOf) as [number, number, number];
  if (![r, g, b].every((channel) => channel >= 0 && channel <= 1e30)) {
    const what = "has a channel that is negative or no number";
    throw new SettingError(`${name}: ${shown(value)} ${what}`);
  }
  return [r, g, b];
}

function decoded(name: string, value: Setting): unknown {
  try {
    return color(value);
  } catch (error) {
    throw new SettingError(`${name}: ${(error as Error).message}`);
  }
}

/** The scene with each `path.to.field` of `edits` replaced, validated anew. */
function withEdits(
  scene: Scene,
  edits: readonly (readonly [string, Setting])[],
  manifest: Manifest,
): Scene {
  const drafts = new Map<string, Record<string, unknown>>();
  const places: [key: string, last: string, value: Setting][] = [];
  for (const [path, value] of edits) {
    const parents = path.split(".");
    const last = parents.pop()!;
    const key = parents.join(".");
    const draft = drafts.get(key) ?? copyOf(scene, parents);
    if (!draft) throw new SettingError(`no setting '${path}'; ${knownPaths(scene)}`);
    if (!Object.hasOwn(draft, last) && !OPEN.includes(parents[0]!)) {
      const allowed = Object.keys(draft).join(", ");
      throw new SettingError(`no setting '${path}'; allowed here are: ${allowed}`);
    }
    drafts.set(key, draft);
    places.push([key, last, value]);
  }
  for (const [key, last, value] of places) {
    if (last === "library" && value !== null && value !== "auto") {
      drafts.set(key, withoutLibraryFields(drafts.get(key)!));
    }
  }
  for (const [key, last, value] of places) drafts.get(key)![last] = value;
  return drafts.size ? withDrafts(scene, drafts, manifest) : scene;
}

/** The part of the scene at a path, free to edit; null where there is none. */
function copyOf(scene: Scene, parents: readonly string[]): Record<string, unknown> | null {
  const [group = "", name = ""] = parents;
  if (parents.length !== DEPTH[group]) return null;
  if (group === "camera") return { ...scene.camera };
  const members = scene[group as "lights" | "materials" | "objects" | "parts"];
  return Object.hasOwn(members, name) ? { ...members[name] } : null;
}

function knownPaths(scene: Scene): string {
  const groups = (["lights", "materials", "objects", "parts"] as const).map(
    (group) => `${group}: ${Object.keys(scene[group]).join(", ")}`,
  );
  return `the scene has camera; ${groups.join("; ")}`;
}
