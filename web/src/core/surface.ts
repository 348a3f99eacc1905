/**
 * How a material's values vary over an object: which maps, which transparency, which choices. Twin
 * of surface.py.
 *
 * A `Pattern` is what specialises a program; what it leaves out (which texture, how far moved) are
 * values of a draw.
 */

import type { Lists } from "./assemble";
import { type Library, ofMaterials } from "./library";
import type { Material, Scene, SceneObject, TextureMap } from "./types";

/** What each field of a material follows from. */
const SOURCES: Readonly<Record<string, readonly string[]>> = {
  base_color: ["base_color"],
  metalness: ["metalness"],
  roughness: ["roughness"],
  f0: ["base_color", "metalness"],
  kd: ["base_color", "metalness"],
  ks: ["base_color", "metalness", "roughness"],
  shininess: ["roughness"],
  ambient: [],
  eta: ["base_color", "metalness"],
  k: ["base_color", "metalness"],
};
/** Fields that a scene's material may give, which then follow from no map. */
const FIXED = ["ks", "shininess", "eta", "k"] as const;
const FLAGS = ["BLEND", "DOUBLE_SIDED", "EMITS", "GIVEN_KD", "MASK", "UNLIT", "VERTEX_COLORS"];
const SLOTS = ["base_color", "roughness", "metalness", "normal", "emissive", "occlusion"];
const SCALARS = ["roughness", "metalness", "occlusion"];

/** How a texture is read: by which coordinates, transformed or not, mirrored or not. */
export interface Texel {
  readonly uv: number;
  readonly transformed: boolean;
  readonly mirror_u: boolean;
  readonly mirror_v: boolean;
}

type Mapped = readonly [slot: string, texel: number, channels: string];

/** Patterns of the same `key` are the same. */
export interface Pattern {
  readonly key: string;
  readonly choices: Readonly<Record<string, string>>;
  readonly texels: readonly Texel[];
  readonly maps: readonly Mapped[];
  readonly given: readonly string[];
  readonly flags: readonly string[];
}

export const NO_PATTERN: Pattern = {
  ...{ key: "", choices: {}, texels: [], maps: [], given: [], flags: [] },
};

/** A pattern with the maps that its texels are read through. */
export interface Surface {
  readonly pattern: Pattern;
  readonly texels: readonly TextureMap[];
}

/** The surface of an object: its material on its mesh. */
export function surface(library: Library, scene: Scene, thing: SceneObject): Surface {
  const material = scene.materials[thing.material]!;
  const colors = thing.mesh !== null && scene.meshes[thing.mesh]!.colors;
  const texels = new Map<string, number>();
  const bound: TextureMap[] = [];
  const maps = SLOTS.flatMap((slot): Mapped[] => {
    const used = material.maps[slot];
    if (!used) return [];
    const { texture, uv, offset, rotation, scale } = used;
    const key = [texture, uv, offset, rotation, scale].join();
    const index = texels.get(key) ?? bound.push(used) - 1;
    texels.set(key, index);
    return [[slot, index, used.channels]];
  });
  const pattern = {
    choices: ownChoices(library, material),
    texels: bound.map((used) => texelOf(scene, used)),
    maps,
    given: FIXED.filter((name) => material[name] !== null),
    flags: flagsOf(material, colors),
  };
  return { pattern: { key: JSON.stringify(pattern), ...pattern }, texels: bound };
}

/** The pattern of surfaces that are alike but for whether both their sides are seen. */
export function unsided(pattern: Pattern): Pattern {
  if (!pattern.flags.includes("DOUBLE_SIDED")) return pattern; // asked of each object in every frame
  const { key: _, ...rest } = pattern;
  const made = { ...rest, flags: rest.flags.filter((flag) => flag !== "DOUBLE_SIDED") };
  return { key: JSON.stringify(made), ...made };
}

function ownChoices(library: Library, material: Material): Record<string, string> {
  const names = [...ofMaterials(library).keys()].sort();
  const own = names.filter((name) => Object.hasOwn(material, name));
  return Object.fromEntries(own.map((name) => [name, String(material[name])]));
}

function texelOf(scene: Scene, { texture, uv, offset, rotation, scale }: TextureMap): Texel {
  const [u, v] = scene.textures[texture]!.wrap;
  const plain = offset[0] === 0 && offset[1] === 0 && scale[0] === 1 && scale[1] === 1;
  const transformed = !plain || rotation !== 0;
  return { uv, transformed, mirror_u: u === "mirror", mirror_v: v === "mirror" };
}

function flagsOf(material: Material, colors: boolean): string[] {
  const found: Record<string, boolean> = {
    BLEND: material.alpha_mode === "blend",
    DOUBLE_SIDED: material.double_sided,
    EMITS: material.unlit || Math.max(...material.emissive) > 0,
    GIVEN_KD: material.kd !== null,
    MASK: material.alpha_mode === "mask",
    UNLIT: material.unlit,
    VERTEX_COLORS: colors,
  };
  return FLAGS.filter((name) => found[name]);
}

/** The lists and defines that shaders see of a pattern. */
export interface Seen {
  readonly lists: Lists;
  readonly defines: Readonly<Record<string, number>>;
}

/** Only of what the files in use read: the material's `fields` and the surface's `parts`. */
export function patternLists(
  library: Library,
  pattern: Pattern,
  fields: ReadonlySet<string>,
  parts: ReadonlySet<string>,
): Seen {
  const names = Object.keys(library.material_fields);
  const varies = varying(pattern, fields);
  const slots = liveSlots(pattern, varies, parts);
  const live = pattern.maps.filter(([slot]) => slots.has(slot));
  const used = new Set(live.map(([, texel]) => texel));
  const flags = pattern.flags.filter((flag) => flag !== "VERTEX_COLORS" || slots.has("base_color"));
  const mirrored = pattern.texels.some((t, i) => used.has(i) && (t.mirror_u || t.mirror_v));
  const lists = {
    TEXTURES: pattern.texels.map(texelRecord).filter((_, index) => used.has(index)),
    CONSTANT_FIELDS: names
      .filter((name) => fields.has(name) && !varies.has(name))
      .map((name) => ({ name })),
    UNIFORM_FIELDS: Object.entries(library.material_fields).map(([name, type]) => ({ type, name })),
    ...Object.fromEntries(
      SLOTS.map((slot) => [`${slot.toUpperCase()}_MAPS`, mapRecords(slot, live)]),
    ),
  };
  const defines = {
    ...truths(FLAGS, (name) => flags.includes(name)),
    ...truths(names, (name) => varies.has(name), "VARIES_"),
    ...{ VARYING: Number(varies.size > 0), MIRRORED: Number(mirrored) },
  };
  return { lists, defines };
}

function truths(
  names: readonly string[],
  holds: (name: string) => boolean,
  prefix = "",
): Record<string, number> {
  return Object.fromEntries(
    names.map((name) => [prefix + name.toUpperCase(), Number(holds(name))]),
  );
}

function texelRecord({ uv, transformed, mirror_u, mirror_v }: Texel, index: number) {
  return {
    index: `${index}`,
    uv: `${uv}`,
    transformed: `${Number(transformed)}`,
    mirror_u: `${Number(mirror_u)}`,
    mirror_v: `${Number(mirror_v)}`,
  };
}

function mapRecords(slot: string, live: readonly Mapped[]): { texel: string; channel: string }[] {
  return live
    .filter(([found]) => found === slot)
    .map(([, texel, channels]) => ({
      texel: `texel${texel}`,
      channel: SCALARS.includes(slot) ? channels[0]! : channels,
    }));
}

/** The fields that are not the same all over the surface. */
function varying(pattern: Pattern, fields: ReadonlySet<string>): ReadonlySet<string> {
  const sources = new Set(pattern.maps.map(([slot]) => slot));
  if (pattern.flags.includes("VERTEX_COLORS")) sources.add("base_color");
  const varies = (name: string) => SOURCES[name]!.some((source) => sources.has(source));
  return new Set([...fields].filter((name) => !pattern.given.includes(name) && varies(name)));
}

/** The slots that something in use follows from. */
function liveSlots(
  { flags }: Pattern,
  varies: ReadonlySet<string>,
  parts: ReadonlySet<string>,
): ReadonlySet<string> {
  const slots = new Set([...varies].flatMap((name) => SOURCES[name]!));
  const unlit = flags.includes("UNLIT");
  const transparent = flags.includes("BLEND") || flags.includes("MASK");
  if ((transparent && parts.has("opacity")) || (unlit && parts.has("emission"))) {
    slots.add("base_color");
  }
  if (flags.includes("EMITS") && !unlit && parts.has("emission")) slots.add("emissive");
  for (const part of ["normal", "occlusion"]) if (parts.has(part)) slots.add(part);
  return slots;
}
