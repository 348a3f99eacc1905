// What the panel shows of materials: the fields that this plan reads, and what each may choose.
import { type Control, fieldControls, optionControl, words } from "./control";
import { choices, ofMaterials } from "./core/library";
import type { Material } from "./core/types";
import { AUTO } from "./fields";
import { current, type Group, group, type Situation } from "./groups";

// What a field of the shader's material follows from where the scene does not give it.
const SOURCES: Record<string, { always: string[]; auto: string[] }> = {
  f0: { always: ["base_color", "metalness"], auto: ["ior"] },
  eta: { always: [], auto: ["f0", "metalness"] },
  k: { always: [], auto: ["f0", "metalness"] },
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

/** A fold for each material that something is made of. */
export function materialGroups(now: Situation): Group[] {
  const used = new Set(Object.values(now.scene.objects).map((thing) => thing.material));
  return [...used].map((name) => {
    const controls = [
      ...libraryControl(now, name),
      ...fields(now, name).flatMap((field) => fieldControls(now, `materials.${name}.${field}`)),
      ...ownChoices(now, name),
    ];
    const objects = Object.entries(now.scene.objects).filter(([, o]) => o.material === name);
    const names = objects.map(([object]) => words(object)).join(", ");
    const on = names === words(name) ? "" : `On: ${names}.`;
    const about = [on, mapsOf(now.scene.materials[name]!)].filter(Boolean).join(" ");
    return group(`materials.${name}`, "material", words(name), about, controls);
  });
}

/** The slots of a material that hold a map; what a slider says is multiplied with it. */
function mapsOf({ maps }: Material): string {
  const slots = Object.keys(maps);
  if (!slots.length) return "";
  const names = slots.map((slot) => words(slot).toLowerCase().replace("color", "colour"));
  return `Times its ${names.length > 1 ? "maps" : "map"}: ${names.join(", ")}.`;
}

/** The fields that change the picture, in the schema's order. */
function fields(now: Situation, name: string): string[] {
  const order = Object.keys(now.manifest.schema.$defs?.Material?.properties ?? {});
  const read = new Set(now.plan.files.flatMap((path) => now.manifest.files[path]!.meta.material));
  const isAuto = (field: string) => current(now, `materials.${name}.${field}`) === AUTO;
  const wanted = materialFields(read, isAuto);
  const parts = new Set(now.plan.files.flatMap((path) => now.manifest.files[path]!.meta.surface));
  const matters = matter(now.scene.materials[name]!, wanted, parts);
  return order.filter((field) => matters[field] ?? wanted.has(field));
}

/** What matters or not by what the material is, whatever else is read of it. */
function matter(
  { alpha_mode, unlit, maps, transmittance }: Material,
  wanted: ReadonlySet<string>,
  parts: ReadonlySet<string>,
): Partial<Record<string, boolean>> {
  const lit = (field: string) => [field, !unlit && wanted.has(field)] as const;
  return {
    ...(unlit ? Object.fromEntries([...wanted].map(lit)) : {}),
    base_color: unlit || wanted.has("base_color"),
    reflectance: parts.has("mirror"),
    transmittance: parts.has("mirror"),
    ior: wanted.has("ior") || (parts.has("mirror") && transmittance > 0),
    emissive: !unlit,
    alpha_mode: true,
    opacity: alpha_mode !== "opaque",
    alpha_cutoff: alpha_mode === "mask",
    double_sided: true,
    unlit: true,
    normal_scale: !unlit && maps.normal !== undefined,
    occlusion_strength: !unlit && maps.occlusion !== undefined,
  };
}

/** Menus of the choices that the material may make for itself alone, where they are in use. */
function ownChoices(now: Situation, name: string): Control[] {
  if (now.scene.materials[name]!.unlit) return [];
  const folders = ofMaterials(now.manifest);
  return now.plan.settings
    .filter((setting) => folders.has(setting))
    .map((setting) => {
      const folder = folders.get(setting)!;
      const titles = choices(now.manifest, folder).map((value) => ({
        ...{ value, title: now.manifest.files[`${folder}/${value}.glsl`]!.meta.title },
      }));
      // What the scene's file has chosen cannot be taken back, only replaced.
      const given = Object.hasOwn(now.preset.materials[name] ?? {}, setting);
      const options = given ? titles : [{ value: AUTO, title: "The scene's" }, ...titles];
      const { title } = now.manifest.folders[folder]!;
      return optionControl(`materials.${name}.${setting}`, `${title}, own`, options);
    });
}

/** A menu of the material library, with where the numbers come from. */
function libraryControl(now: Situation, name: string): Control[] {
  const known = Object.entries(now.manifest.materials).map(([value, { title, source }]) => ({
    ...{ value, title, hint: `Source: ${source}` },
  }));
  if (!known.length) return [];
  const options = [{ value: AUTO, title: "Its own values" }, ...known];
  return [optionControl(`materials.${name}.library`, "From the library", options)];
}
