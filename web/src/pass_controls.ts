// Rows for what passes do: beside the choice that a pass works for, or under quality.
import { type Control, optionControl, parameterControl, words } from "./control";
import { evaluate } from "./core/expression";
import { passes } from "./core/library";
import type { Parameter } from "./core/types";
import { current, type Group, group, type Situation } from "./groups";

/** Parameters in use of what works for a choice: by their name, or by when their pass runs. */
export function workOf(now: Situation, setting: string): Control[] {
  return working(now).flatMap(([name, parameter, master]) =>
    master === setting ? [passControl(now, name, parameter)] : [],
  );
}

type Work = readonly [name: string, parameter: Parameter, master: string | undefined];

/** Parameters of passes and of what they include, with the setting of the choice they work for. */
function working(now: Situation): Work[] {
  const folders = new Set(Object.keys(now.manifest.folders));
  const paths = now.plan.files.filter((path) => !folders.has(path.split("/")[0]!));
  return paths.flatMap((path) => {
    const { meta } = now.manifest.files[path]!;
    const when = "when" in meta ? meta.when : "";
    return Object.entries(meta.parameters).map(([name, parameter]): Work => {
      const serves = (setting: string) =>
        name.startsWith(`${setting}_`) || new RegExp(`\\b${setting}\\b`).test(when);
      return [name, parameter, now.plan.settings.find(serves)];
    });
  });
}

/** A light is chosen by its name. */
function passControl(now: Situation, name: string, parameter: Parameter): Control {
  const control = parameterControl(name, parameter);
  if (name !== "depth_light") return control;
  const lights = Object.entries(now.scene.lights);
  const options = lights.flatMap(([light, { casts }], index) =>
    casts ? [{ value: index, title: words(light) }] : [],
  );
  return options.length ? optionControl(name, "Light", options) : control;
}

/** Parameters of the passes that work for no choice; a pass's own switch too while it is off. */
export function qualityGroups(now: Situation): Group[] {
  const inUse = working(now).filter(([name, , master]) => !master && matters(now, name));
  const off = [...passes(now.manifest)].flatMap(([pass, meta]) => {
    const path = `passes/${pass}.glsl`;
    if (now.plan.files.includes(path)) return [];
    return Object.entries(meta.parameters).filter(([name]) => switches(now, path, name));
  });
  const found = [...inUse, ...off].map(([name, parameter]) => parameterControl(name, parameter));
  return found.length ? [group("quality", "picture", "Quality", "", found)] : [];
}

/**
 * Spheres' own settings matter where there are spheres, and the error where it is followed; how
 * images are sampled, where there are some.
 */
function matters(now: Situation, name: string): boolean {
  if (name === "anisotropy") return Object.keys(now.plan.textures).length > 0;
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
