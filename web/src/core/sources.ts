/**
 * The specialised sources of passes, each made once. Twin of the upper half of batches.py.
 *
 * A plan is made for every frame, so what tells two requests apart is a short text.
 */

import { assemble, type Lists, type Record_, type Source } from "./assemble";
import { type Library, parameters } from "./library";
import { link } from "./link";
import { partRecords } from "./parts";
import type { Light } from "./scene";
import type { Resolved } from "./settings";
import { NO_PATTERN, type Pattern, type Surface } from "./surface";
import {
  imageArrays,
  objectRecords,
  ownValues,
  patternsOf,
  SURFACE,
  sceneDefines,
  TRACING,
  taken,
  texelsOf,
  UNTRACED,
  UNTRACED_LISTS,
} from "./traced";
import type { Pass, Program, SceneObject } from "./types";
import { DRAW_NAMES } from "./values";
import { WIDEST_SPOT } from "./viewpoint";

const MAX_STAGES = 512;

/** Both stages of a pass for surfaces of a pattern. */
export interface Stages {
  readonly fragment: Source;
  readonly vertex: Source;
  readonly program: Program;
  /** Uniforms of the program, with their types. */
  readonly declared: Readonly<Record<string, string>>;
  /** Those that each draw has its own value of, sorted, and those that all draws share. */
  readonly own: readonly string[];
  readonly shared: readonly string[];
  /** What rays ask the surfaces for; null where there are none that do. */
  readonly asked: Asked | null;
}

/** What rays ask the surfaces for. */
export interface Asked {
  /** Of each kind of surface, what it says of what it reads. */
  readonly parts: readonly Source[];
  /** The records of OBJECT_VALUES. */
  readonly values: readonly Record_[];
}

/** What all sources of a plan share; frames of the same `key` are the same. */
export interface Frame {
  readonly key: string;
  readonly choices: Readonly<Record<string, string>>;
  readonly defines: Readonly<Record<string, number>>;
  readonly lights: readonly Record_[];
  readonly objects: readonly Record_[];
  /** The kinds of surface that rays may meet. */
  readonly kinds: readonly Pattern[];
  /** Names of the textures that these parts read, array by array. */
  readonly images: (parts: readonly Source[]) => readonly (readonly string[])[];
  /** The records of IMAGE_ARRAYS. */
  readonly arrays: (parts: readonly Source[]) => readonly Record_[];
  readonly parts: readonly Record_[];
}

const caches = new WeakMap<Library, Map<string, Stages>>();

/** What all sources of a plan share. */
export function frameOf(
  library: Library,
  resolved: Resolved,
  surfaces: ReadonlyMap<SceneObject, Surface>,
): Frame {
  const { choices, scene } = resolved;
  const defines = defineValues(library, resolved);
  const lights = Object.values(scene.lights).map(lightRecord);
  const objects = objectRecords(scene, surfaces);
  const kinds = patternsOf(scene, surfaces);
  const parts = partRecords(scene);
  const patterns = kinds.map((pattern) => pattern.key);
  const key = JSON.stringify([choices, defines, lights, objects, parts, patterns]);
  const images = (read: readonly Source[]) => imageArrays(scene, surfaces, read);
  const arrays = (read: readonly Source[]) =>
    images(read).map(([first], index) => {
      const nearest = Number(scene.textures[first!]!.filter === "nearest");
      return { index: `${index}`, nearest: `${nearest}` };
    });
  return { key, choices, defines, lights, objects, parts, kinds, images, arrays };
}

/** A record of LIGHTS: which light, of which kind; the kinds are 0 or 1 for `#if`. */
function lightRecord(light: Light, index: number): Record_ {
  const { type } = light;
  const truth = (holds: boolean) => `${Number(holds)}`;
  return {
    index: `${index}`,
    point: truth(type === "point"),
    directional: truth(type === "directional"),
    spot: truth(type === "spot"),
    positional: truth(type !== "directional"),
    casts: truth(light.casts),
    cube: truth(type === "point" || (type === "spot" && light.outer > WIDEST_SPOT)),
  };
}

/** The parameters that become defines: whole numbers and truths; and what the frame is. */
function defineValues(library: Library, resolved: Resolved): Record<string, number> {
  const found: Record<string, number> = {};
  for (const [name, { kind }] of parameters(library)) {
    const value = resolved.values[name];
    if ((kind === "int" || kind === "bool") && value !== undefined) found[name] = Number(value);
  }
  found.orthographic = Number(resolved.scene.camera.projection === "orthographic");
  found.signed = Number(library.files[`views/${resolved.choices.view}.glsl`]!.meta.signed);
  const bounces = Number(resolved.values.max_bounces ?? 0);
  return { ...found, ...sceneDefines(resolved.scene, bounces) };
}

/** The sources of a pass for surfaces of a pattern; `own` is the light that it is run for. */
export function stagesOf(
  library: Library,
  frame: Frame,
  name: string,
  meta: Pass,
  pattern: Pattern,
  own: number | null,
): Stages {
  const key = `${name} ${own} ${pattern.key} ${frame.key}`;
  const bench: Bench = { library, frame, entry: `passes/${name}.glsl`, pattern, own };
  const found = kept(library, key, () => makeStages(bench, Number(meta.draw === "objects")));
  if (!found.asked) return found;
  const { asked } = found;
  const arrays = frame.arrays(asked.parts);
  const made = () => tracingStages(bench, asked, arrays);
  return kept(library, `${JSON.stringify(arrays)} ${key}`, made);
}

function kept(library: Library, key: string, make: () => Stages): Stages {
  const cache = caches.get(library) ?? new Map<string, Stages>();
  caches.set(library, cache);
  const known = cache.get(key);
  if (known) return known;
  if (cache.size >= MAX_STAGES) cache.clear();
  const made = make();
  cache.set(key, made);
  return made;
}

/** What the sources of a pass have in common. */
interface Bench {
  readonly library: Library;
  readonly frame: Frame;
  readonly entry: string;
  readonly pattern: Pattern;
  /** The light that the pass is run for. */
  readonly own: number | null;
}

/** How one source differs from others of its bench. */
interface Wanted {
  readonly stage: "FRAGMENT" | "VERTEX";
  readonly values: Readonly<Record<string, number>>;
  readonly lists?: Lists;
  readonly varyings?: readonly string[];
}

function assembled({ library, frame, entry, pattern, own }: Bench, wanted: Wanted): Source {
  const { stage, values, lists, varyings } = wanted;
  const none = frame.kinds.map((_, kind) => [`SURFACE${kind}_VALUES`, []] as const);
  return assemble(library, {
    ...{ entry, stage, pattern, varyings: varyings ?? [] },
    choices: { ...frame.choices, ...pattern.choices },
    values: { ...frame.defines, ...UNTRACED, ...values },
    lists: {
      ...{ ...lightLists(frame.lights, own), ...UNTRACED_LISTS, ...Object.fromEntries(none) },
      ...{ OBJECTS: frame.objects, PARTS: frame.parts, ...lists },
    },
  });
}

/** Both stages; of a pass whose rays ask for surfaces, the fragment stage still is without them. */
function makeStages(bench: Bench, draws_objects: number): Stages {
  const values = { draws_objects, record: texelsOf([]) };
  const fragment = assembled(bench, { stage: "FRAGMENT", values });
  const { varyings } = fragment;
  const vertex = assembled(bench, { stage: "VERTEX", values, varyings });
  const stages = stagesFrom(fragment, vertex, bench.pattern);
  return fragment.files.includes(TRACING) ? { ...stages, asked: askedOf(bench) } : stages;
}

/** What the surfaces read, which says what there must be to be read. */
function askedOf(bench: Bench): Asked {
  const parts = partsOf(bench, [], texelsOf([]));
  return { parts, values: ownValues(bench.frame.defines, parts) };
}

function partsOf(bench: Bench, arrays: readonly Record_[], record: number): readonly Source[] {
  return bench.frame.kinds.map((pattern) =>
    assembled(
      { ...bench, entry: SURFACE, pattern, own: null },
      {
        stage: "FRAGMENT",
        values: { draws_objects: 1, traced: 1, record },
        lists: { IMAGE_ARRAYS: arrays },
      },
    ),
  );
}

/** The stages of a pass whose rays may meet every kind of surface. */
function tracingStages(bench: Bench, asked: Asked, arrays: readonly Record_[]): Stages {
  const { kinds, defines } = bench.frame;
  const record = texelsOf(asked.values);
  const parts = partsOf(bench, arrays, record);
  const ofKind = (kind: number) => ownValues(defines, [parts[kind]!]);
  const byKind = kinds.map((_, kind) => [`SURFACE${kind}_VALUES`, ofKind(kind)] as const);
  const main = assembled(bench, {
    stage: "FRAGMENT",
    values: { traced: 1, record, ...taken(parts) },
    lists: {
      ...{ IMAGE_ARRAYS: arrays, OBJECT_VALUES: asked.values },
      ...{ SURFACES: numbered(kinds.length), ...Object.fromEntries(byKind) },
    },
  });
  const variables = new Set(asked.values.map(({ name }) => `u_${name}`));
  const fragment = link(parts, "surfaceLight", main, variables);
  const { varyings } = fragment;
  const vertex = assembled(bench, { stage: "VERTEX", values: { record }, varyings });
  return { ...stagesFrom(fragment, vertex, NO_PATTERN), asked };
}

function numbered(count: number): readonly Record_[] {
  return Array.from({ length: count }, (_, index) => ({ index: `${index}` }));
}

function stagesFrom(fragment: Source, vertex: Source, pattern: Pattern): Stages {
  const program = {
    vertex: vertex.text,
    fragment: fragment.text,
    vertex_lines: [...vertex.lines],
    fragment_lines: [...fragment.lines],
    attributes: Object.keys(vertex.attributes).sort(),
  };
  const declared = { ...vertex.uniforms, ...fragment.uniforms };
  const names = Object.keys(declared).sort();
  const transforms = pattern.texels.map((_, index) => `u_texture${index}_transform`);
  const isOwn = (uniform: string) => DRAW_NAMES.includes(uniform) || transforms.includes(uniform);
  const isShared = (uniform: string) => !declared[uniform]!.includes("sampler") && !isOwn(uniform);
  const kinds = { own: names.filter(isOwn), shared: names.filter(isShared) };
  return { fragment, vertex, program, declared, ...kinds, asked: null };
}

function lightLists(every: readonly Record_[], own: number | null): Lists {
  return {
    LIGHTS: every,
    POSITIONAL_LIGHTS: every.filter((record) => record.positional === "1"),
    SPOT_LIGHTS: every.filter((record) => record.spot === "1"),
    CASTERS: every.filter((record) => record.casts === "1"),
    OWN_LIGHTS: own === null ? [] : [every[own]!],
  };
}

/** Whether two programs are the same, line by line. */
export function samePrograms(a: Program, b: Program): boolean {
  if (a === b) return true;
  if (a.vertex !== b.vertex || a.fragment !== b.fragment) return false;
  return sameLines(a.vertex_lines, b.vertex_lines) && sameLines(a.fragment_lines, b.fragment_lines);
}

function sameLines(a: readonly string[], b: readonly string[]): boolean {
  return a.length === b.length && a.every((line, index) => line === b[index]);
}
