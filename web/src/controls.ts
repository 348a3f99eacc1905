// What the panel shows: the controls that this scene, these choices and this plan use, as data.
import {
  type Control,
  direction,
  fieldControls,
  parameterControl,
  position,
  words,
} from "./control";
import { evaluate } from "./core/expression";
import { choices, passes } from "./core/library";
import type { Choice, Folder, Manifest, Plan, Scene } from "./core/types";
import { AUTO, defaultOf, fieldSchema, type Value, type Values } from "./fields";
import { niceCeiling, niceStep } from "./number";

export type Tab = "model" | "lights" | "material" | "camera" | "picture";
export const TABS: Record<Tab, string> = {
  model: "Model",
  lights: "Lights",
  material: "Material",
  camera: "Camera",
  picture: "Picture",
};

/** A fold of the panel: a choice with its formula, a light, a material. */
export interface Group {
  id: string;
  tab: Tab;
  title: string;
  about: string;
  choice: Menu | null;
  controls: Control[];
}

/** A choice setting: what may be chosen, and the front matter of what is. */
export interface Menu {
  setting: string;
  options: { value: string; title: string }[];
  chosen: string;
  meta: Choice;
}

/** All that the description depends on. */
export interface Situation {
  manifest: Manifest;
  /** The preset with the edits of the link. */
  scene: Scene;
  /** The preset as it was loaded. */
  preset: Scene;
  settings: Values;
  plan: Plan;
}

/** The panel's content. */
export function describe(now: Situation): Group[] {
  return [
    ...lightGroups(now),
    ...now.plan.settings.map((setting) => choiceGroup(now, setting)),
    ...materialGroups(now),
    cameraGroup(now),
    ...qualityGroups(now),
  ];
}

/** The value that holds now. */
export function current(now: Situation, name: string): Value {
  return now.settings[name] ?? defaultOf(now.manifest, now.preset, name, now.settings);
}

function choiceGroup(now: Situation, setting: string): Group {
  const [name, folder] = Object.entries(now.manifest.folders).find(
    ([, f]) => f.setting === setting,
  )!;
  const chosen = String(current(now, setting));
  const metaOf = (choice: string) => now.manifest.files[`${name}/${choice}.glsl`]!.meta;
  const meta = metaOf(chosen);
  return {
    id: setting,
    tab: tabOf(folder),
    title: folder.title,
    about: folder.about,
    choice: {
      setting,
      options: choices(now.manifest, name).map((value) => ({ value, title: metaOf(value).title })),
      chosen,
      meta,
    },
    controls: Object.entries(meta.parameters).map(([key, parameter]) => {
      const control = parameterControl(key, parameter);
      return parameter.per === "light" ? { ...control, label: `${control.label}, all` } : control;
    }),
  };
}

/** Where a choice belongs, by what its function is given. */
export function tabOf(folder: Folder): Tab {
  const names = /\((.*)\)/.exec(folder.function)?.[1]?.match(/\w+(?=\s*(,|$))/g) ?? [];
  if (names.some((name) => name === "radiance" || name === "linear")) return "picture";
  return names.some((name) => ["l", "v", "h", "VoH"].includes(name)) ? "model" : "lights";
}

function lightGroups(now: Situation): Group[] {
  const extra = now.plan.files.flatMap((path) =>
    Object.entries(now.manifest.files[path]!.meta.parameters).filter(([, p]) => p.per === "light"),
  );
  const reach = extent(now.preset);
  return Object.entries(now.scene.lights).map(([name, light]) => {
    const at = `lights.${name}`;
    const unit = light.type === "directional" ? "lx" : light.unit === "lumen" ? "lm" : "cd";
    const has = (field: string) => fieldSchema(now.manifest, now.scene, `${at}.${field}`) !== null;
    const controls = [
      ...fieldControls(now, `${at}.color`),
      intensity(now, `${at}.intensity`, unit),
      ...(has("unit") ? fieldControls(now, `${at}.unit`) : []),
      ...(has("position") ? position(`${at}.position`, "Position", reach) : []),
      ...(has("direction") ? direction(`${at}.direction`) : []),
      ...["inner", "outer"].flatMap((field) => fieldControls(now, `${at}.${field}`, "°")),
      ...(light.type === "directional"
        ? []
        : extra.map(([key, parameter]) => parameterControl(`${at}.${key}`, parameter))),
    ];
    return group(at, "lights", `${words(name)}`, `${words(light.type)} light`, controls);
  });
}

/** Up to about four times the preset's value, so that the slider has room on both sides. */
function intensity(now: Situation, name: string, unit: string): Control {
  const [base] = fieldControls(now, name, unit);
  const preset = Number(defaultOf(now.manifest, now.preset, name, now.settings));
  const high = preset > 0 ? niceCeiling(4 * preset) : 100;
  return { ...base!, low: 0, high, step: niceStep(high, 1000) };
}

/** Half the size of what there is to light, and some room around it. */
function extent(scene: Scene): number {
  const far = Object.values(scene.objects).flatMap((thing) =>
    thing.position.map((c, axis) => Math.abs(c) + Math.min(thing.scale[axis] ?? 1, 12) / 2),
  );
  const lights = Object.values(scene.lights).flatMap((light) =>
    light.type === "directional" ? [] : light.position.map(Math.abs),
  );
  return niceCeiling(Math.max(1, ...far, ...lights));
}

// What a field of the shader's material follows from where the scene does not give it.
const SOURCES: Record<string, { always: string[]; auto: string[] }> = {
  f0: { always: ["base_color", "metalness"], auto: ["ior"] },
  kd: { always: [], auto: ["base_color", "metalness"] },
  ks: { always: [], auto: ["f0", "shininess"] },
  shininess: { always: [], auto: ["roughness"] },
};

/** The scene's material fields that these fields of the shader's material come from. */
export function materialFields(
  read: Iterable<string>,
  isAuto: (field: string) => boolean,
): Set<string> {
  const found = new Set<string>();
  const add = (field: string) => {
    if (found.has(field)) return;
    found.add(field);
    const source = SOURCES[field];
    for (const other of source?.always ?? []) add(other);
    if (isAuto(field)) for (const other of source?.auto ?? []) add(other);
  };
  for (const field of read) add(field);
  return found;
}

function materialGroups(now: Situation): Group[] {
  const read = new Set(now.plan.files.flatMap((path) => now.manifest.files[path]!.meta.material));
  const used = new Set(Object.values(now.scene.objects).map((thing) => thing.material));
  const order = Object.keys(now.manifest.schema.$defs?.Material?.properties ?? {});
  return [...used].map((name) => {
    const at = `materials.${name}`;
    const wanted = materialFields(read, (field) => current(now, `${at}.${field}`) === AUTO);
    const controls = order
      .filter((field) => wanted.has(field))
      .flatMap((field) => fieldControls(now, `${at}.${field}`));
    const objects = Object.entries(now.scene.objects).filter(([, o]) => o.material === name);
    const names = objects.map(([object]) => words(object)).join(", ");
    const about = names === words(name) ? "" : `On: ${names}`;
    return group(at, "material", words(name), about, controls);
  });
}

function cameraGroup(now: Situation): Group {
  const reach = Math.max(
    extent(now.preset),
    niceCeiling(Math.max(...now.preset.camera.eye.map(Math.abs))),
  );
  return group("camera", "camera", "Camera", "", [
    ...fieldControls(now, "camera.fov", "°"),
    ...position("camera.eye", "Eye", reach),
    ...position("camera.target", "Target", reach),
  ]);
}

/** Parameters of the passes and of what they include; a pass's own switch too while it is off. */
function qualityGroups(now: Situation): Group[] {
  const folders = new Set(Object.keys(now.manifest.folders));
  const inUse = now.plan.files.filter((path) => !folders.has(path.split("/")[0]!));
  const off = [...passes(now.manifest)]
    .filter(([name]) => !inUse.includes(`passes/${name}.glsl`))
    .map(([name]) => `passes/${name}.glsl`);
  const controls = (path: string) =>
    Object.entries(now.manifest.files[path]!.meta.parameters)
      .filter(([name]) => (inUse.includes(path) ? matters(now, name) : switches(now, path, name)))
      .map(([name, parameter]) => parameterControl(name, parameter));
  const found = [...inUse, ...off].flatMap(controls);
  return found.length ? [group("quality", "picture", "Quality", "", found)] : [];
}

/** Spheres' own settings matter where there are spheres, and the error where it is followed. */
function matters(now: Situation, name: string): boolean {
  if (name !== "sphere_error" && name !== "subdivision") return true;
  const spheres = Object.values(now.scene.objects).some((thing) => thing.shape === "sphere");
  return spheres && (name === "subdivision" || Number(current(now, "subdivision")) < 0);
}

/** Whether a pass that is off waits for this parameter. */
function switches(now: Situation, path: string, name: string): boolean {
  const meta = now.manifest.files[path]!.meta;
  if (!("when" in meta) || !new RegExp(`\\b${name}\\b`).test(meta.when)) return false;
  try {
    evaluate(meta.when, { [name]: 0 });
    return true;
  } catch {
    return false;
  }
}

function group(id: string, tab: Tab, title: string, about: string, controls: Control[]): Group {
  return { id, tab, title, about, choice: null, controls };
}
