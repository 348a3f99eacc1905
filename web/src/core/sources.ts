/**
 * The specialised sources of passes, each made once. Twin of the upper half of batches.py.
 *
 * A plan is made for every frame, so what tells two requests apart is a short text.
 */

import { assemble, type Lists, type Record_, type Source } from "./assemble";
import { type Library, parameters } from "./library";
import type { Light } from "./scene";
import type { Resolved } from "./settings";
import type { Pattern } from "./surface";
import type { Pass, Program } from "./types";
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
}

/** What all sources of a plan share; frames of the same `key` are the same. */
export interface Frame {
  readonly key: string;
  readonly choices: Readonly<Record<string, string>>;
  readonly defines: Readonly<Record<string, number>>;
  readonly lights: readonly Record_[];
}

const caches = new WeakMap<Library, Map<string, Stages>>();

/** What all sources of a plan share. */
export function frameOf(library: Library, resolved: Resolved): Frame {
  const { choices } = resolved;
  const defines = defineValues(library, resolved);
  const lights = Object.values(resolved.scene.lights).map(lightRecord);
  return { key: JSON.stringify([choices, defines, lights]), choices, defines, lights };
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
  return found;
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
  const cache = caches.get(library) ?? new Map<string, Stages>();
  caches.set(library, cache);
  const key = `${name} ${own} ${pattern.key} ${frame.key}`;
  const known = cache.get(key);
  if (known) return known;
  if (cache.size >= MAX_STAGES) cache.clear();
  const made = makeStages(library, frame, name, meta, pattern, own);
  cache.set(key, made);
  return made;
}

function makeStages(
  library: Library,
  frame: Frame,
  name: string,
  meta: Pass,
  pattern: Pattern,
  own: number | null,
): Stages {
  const request = {
    entry: `passes/${name}.glsl`,
    choices: { ...frame.choices, ...pattern.choices },
    values: { ...frame.defines, draws_objects: Number(meta.draw === "objects") },
    lists: lightLists(frame.lights, own),
    pattern,
  };
  const fragment = assemble(library, { ...request, stage: "FRAGMENT", varyings: [] });
  const { varyings } = fragment;
  const vertex = assemble(library, { ...request, stage: "VERTEX", varyings });
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
  const isShared = (uniform: string) => declared[uniform] !== "sampler2D" && !isOwn(uniform);
  const kinds = { own: names.filter(isOwn), shared: names.filter(isShared) };
  return { fragment, vertex, program, declared, ...kinds };
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
