// What the panel shows: the controls that this scene, these choices and this plan use, as data.
import { cameraGroup } from "./camera_group";
import {
  type Control,
  direction,
  fieldControls,
  parameterControl,
  position,
  words,
} from "./control";
import { choices, folderOf } from "./core/library";
import type { Folder, ShaderFile } from "./core/types";
import { extent, isSolid } from "./extent";
import { defaultOf, fieldSchema } from "./fields";
import { current, type Group, group, type Situation, type Tab } from "./groups";
import { materialGroups } from "./material_controls";
import { niceCeiling, niceStep } from "./number";
import { partGroups } from "./part_controls";
import { qualityGroups, workOf } from "./pass_controls";

/** The panel's content. */
export function describe(now: Situation): Group[] {
  return [
    ...partGroups(now),
    ...lightGroups(now),
    ...[...now.plan.settings, ...idle(now)].map((setting) => choiceGroup(now, setting)),
    ...materialGroups(now),
    ...(isSolid(now.scene) ? [cameraGroup(now)] : []),
    ...qualityGroups(now),
  ];
}

function choiceGroup(now: Situation, setting: string): Group {
  const name = folderOf(now.manifest, setting);
  const folder = now.manifest.folders[name]!;
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
      options: choices(now.manifest, name).map((value) => ({
        ...{ value, title: metaOf(value).title, hint: metaOf(value).about },
        kind: kindOf(folder, now.manifest.files[`${name}/${value}.glsl`]!),
      })),
      chosen,
      meta,
    },
    controls: [
      ...files(now, name, chosen).flatMap(({ meta: { parameters } }) =>
        Object.entries(parameters).map(([key, parameter]) => {
          const control = parameterControl(key, parameter);
          const all = parameter.per === "light" ? ", all" : "";
          return { ...control, label: `${control.label}${all}` };
        }),
      ),
      ...workOf(now, setting),
    ],
  };
}

// What a choice does beside its folder's function, by the first other function that it defines.
const KINDS: Readonly<Record<string, string>> = {
  inspect: "The surface, without lights",
  inspectNormal: "The surface, without lights",
  reflected: "Under the lights",
  term: "Under the lights",
  seen: "Under the lights",
};

function kindOf({ optional }: Folder, { functions }: ShaderFile): string {
  if (!optional.length) return "";
  const extra = optional.map((signature) => /(\w+)\(/.exec(signature)?.[1] ?? "");
  return KINDS[extra.find((name) => name in functions) ?? ""] ?? "The picture";
}

/** The file that is chosen, then those that materials have chosen for themselves. */
function files({ manifest, plan }: Situation, folder: string, chosen: string): ShaderFile[] {
  const own = plan.files.filter((path) => path.startsWith(`${folder}/`));
  const paths = new Set([`${folder}/${chosen}.glsl`, ...own]);
  return [...paths].map((path) => manifest.files[path]!);
}

/**
 * Choices of the frame that are made so that nothing comes of them: no shadow, no outline. Their
 * files say so by a function without arguments. Of those about lights, where there are lights.
 */
function idle(now: Situation): string[] {
  const { manifest, plan, scene } = now;
  const lit = Object.keys(scene.lights).length > 0;
  return Object.entries(manifest.folders).flatMap(([name, folder]) => {
    const off = folder.optional.filter((f) => f.endsWith("()")).map((f) => f.slice(5, -2));
    const known = folder.per === "material" || plan.settings.includes(folder.setting);
    if (!off.length || known || (tabOf(folder) === "lights" && !lit)) return [];
    const chosen = current(now, folder.setting);
    const { functions } = manifest.files[`${name}/${chosen}.glsl`]!;
    return off.some((f) => Object.hasOwn(functions, f)) ? [folder.setting] : [];
  });
}

/** Where a choice belongs, by what its function is given. */
export function tabOf(folder: Folder): Tab {
  const names = /\((.*)\)/.exec(folder.function)?.[1]?.match(/\w+(?=\s*(,|$))/g) ?? [];
  if (names.some((name) => ["radiance", "linear", "pixel"].includes(name))) return "picture";
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
      ...shadowControls(now, name),
    ];
    return group(at, "lights", `${words(name)}`, `${words(light.type)} light`, controls);
  });
}

/** Whether a light casts shadows, and how far, where any are drawn. */
function shadowControls(now: Situation, light: string): Control[] {
  if (!now.plan.settings.includes("shadow")) return [];
  const casts = fieldControls(now, `lights.${light}.casts`);
  return now.scene.lights[light]!.casts
    ? [...casts, ...fieldControls(now, `lights.${light}.far`)]
    : casts;
}

/** Up to about four times the preset's value, so that the slider has room on both sides. */
function intensity(now: Situation, name: string, unit: string): Control {
  const [base] = fieldControls(now, name, unit);
  const preset = Number(defaultOf(now.manifest, now.preset, name, now.settings));
  const high = preset > 0 ? niceCeiling(4 * preset) : 100;
  return { ...base!, low: 0, high, step: niceStep(high, 1000) };
}
