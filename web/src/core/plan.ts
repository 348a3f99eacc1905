/**
 * From a scene and settings to the ordered passes, as plain data; no GL in it.
 *
 * Twin of plan.py: same scene and settings, same plan.
 */

import { assemble, type Lists, type Request, type Source } from "./assemble";
import { LightbenchError, ShaderError } from "./errors";
import { evaluate, type Value } from "./expression";
import { type Library, parameters, passes } from "./library";
import { type Resolved, resolve, type Settings } from "./settings";
import type { Batch, Draw, Manifest, Pass, Plan, Program, Scene, Target } from "./types";
import { DRAW_NAMES, drawValues, float32, frameValues, frontToBack, meshKey } from "./values";

export type Size = readonly [width: number, height: number];

const MAX_SIDE = 16384;
/** What a plan is made for: the linear picture and its display code. */
const OUTPUTS = ["linear", "display"] as const;
const STAGES = ["VERTEX", "FRAGMENT"] as const;
const MAX_SOURCES = 512;

/**
 * The plan of a picture of `size` (width, height) pixels.
 *
 * Throws SettingError, SceneError or ShaderError with what is wrong and what is allowed.
 */
export function plan(manifest: Manifest, scene: Scene, settings: Settings, size: Size): Plan {
  const fits = size.every((side) => Number.isInteger(side) && side >= 1 && side <= MAX_SIDE);
  if (!fits) {
    const [width, height] = size;
    throw new LightbenchError(`size ${width}x${height}: each side is 1 to ${MAX_SIDE} pixels`);
  }
  return new Planner(manifest, resolve(manifest, scene, settings), size).plan();
}

const sources = new WeakMap<Library, Map<string, Source>>();

/** `assemble`, made once for each request to a library. */
function assembled(library: Library, request: Request): Source {
  let known = sources.get(library);
  if (!known) {
    known = new Map();
    sources.set(library, known);
  }
  const key = JSON.stringify(request);
  let source = known.get(key);
  if (!source) {
    source = assemble(library, request);
    if (known.size >= MAX_SOURCES) known.clear();
    known.set(key, source);
  }
  return source;
}

/** The lists of `#for`: which light, of which kind; the kinds are 0 or 1 for `#if`. */
function lightLists(scene: Scene): Lists {
  const every = Object.values(scene.lights).map((light, index) => ({
    index: `${index}`,
    point: `${Number(light.type === "point")}`,
    directional: `${Number(light.type === "directional")}`,
    spot: `${Number(light.type === "spot")}`,
    positional: `${Number(light.type !== "directional")}`,
  }));
  return {
    LIGHTS: every,
    POSITIONAL_LIGHTS: every.filter((record) => record.positional === "1"),
    SPOT_LIGHTS: every.filter((record) => record.spot === "1"),
  };
}

/** The parameters that become defines: whole numbers and truths. */
function defineValues(library: Library, resolved: Resolved): Record<string, number> {
  const found: Record<string, number> = {};
  for (const [name, { kind }] of parameters(library)) {
    const value = resolved.values[name];
    if ((kind === "int" || kind === "bool") && value !== undefined) found[name] = Number(value);
  }
  return found;
}

/** Walks back from the outputs: a pass runs because something reads what it writes. */
class Planner {
  private readonly scene: Scene;
  private readonly names: Record<string, Value>;
  private readonly defines: Readonly<Record<string, number>>;
  private readonly lists: Lists;
  private readonly metas: ReadonlyMap<string, Pass>;
  private readonly textureOf = new Map<string, string>();
  private readonly underWay: string[] = [];
  private readonly result: Plan;

  constructor(
    private readonly library: Library,
    private readonly resolved: Resolved,
    private readonly size: Size,
  ) {
    this.scene = resolved.scene;
    const numbers = Object.entries(resolved.values).filter(
      (entry): entry is [string, number] => typeof entry[1] === "number",
    );
    this.names = { ...Object.fromEntries(numbers), ...resolved.choices };
    this.defines = defineValues(library, resolved);
    this.lists = lightLists(this.scene);
    this.metas = passes(library);
    this.result = {
      size: [...size],
      targets: {},
      programs: [],
      passes: [],
      outputs: {},
      settings: [],
      files: [],
    };
  }

  plan(): Plan {
    for (const output of OUTPUTS) this.result.outputs[output] = this.produce(output);
    return this.result;
  }

  private runs(meta: Pass): boolean {
    return Boolean(evaluate(meta.when, this.names));
  }

  /** The texture that holds `resource` once its writer and all that refine it have run. */
  private produce(resource: string): string {
    const known = this.textureOf.get(resource);
    if (known !== undefined) return known;
    if (this.underWay.includes(resource)) {
      const chain = [...this.underWay, resource].join(" -> ");
      throw new ShaderError(`passes: '${resource}' is read before it is written: ${chain}`);
    }
    this.underWay.push(resource);
    const writers = [...this.metas].filter(([, meta]) => Object.hasOwn(meta.writes, resource));
    const refines = ([, meta]: [string, Pass]) => meta.reads.includes(resource);
    let texture = this.create(
      resource,
      writers.filter((writer) => !refines(writer)),
    );
    for (const [name, meta] of writers.filter(refines)) {
      if (!this.runs(meta)) continue;
      const target = `${resource}~${name}`;
      this.add(name, meta, target, meta.writes[resource]!, { [resource]: texture });
      texture = target;
    }
    this.underWay.pop();
    this.textureOf.set(resource, texture);
    return texture;
  }

  /** Run the pass that makes `resource`; one left out hands on its first read instead. */
  private create(resource: string, creators: readonly [string, Pass][]): string {
    const active = creators.filter(([, meta]) => this.runs(meta));
    if (active.length > 1) {
      const both = active.map(([name]) => name).join(" and ");
      throw new ShaderError(`passes: '${resource}' is written by ${both}`);
    }
    if (active[0]) {
      const [name, meta] = active[0];
      this.add(name, meta, resource, meta.writes[resource]!, {});
      return resource;
    }
    for (const [, meta] of creators) {
      if (meta.reads[0] !== undefined) return this.produce(meta.reads[0]);
    }
    const known = [...this.metas.keys()].join(", ");
    throw new ShaderError(`passes: nothing writes '${resource}'; passes: ${known}`);
  }

  /** Append the pass after all that it reads; `own` says which texture it refines. */
  private add(
    name: string,
    meta: Pass,
    target: string,
    spec: Target,
    own: Readonly<Record<string, string>>,
  ): void {
    const stages = STAGES.map((stage) => this.assemble(name, stage));
    const files = new Set(stages.flatMap((source) => source.files));
    const uniforms = new Set(stages.flatMap((source) => Object.keys(source.uniforms)));
    const reads = new Set([...files].flatMap((path) => this.library.files[path]!.meta.reads));
    const samplers: Record<string, string> = {};
    for (const read of reads) {
      if (uniforms.has(`u_${read}`)) samplers[`u_${read}`] = own[read] ?? this.produce(read);
    }
    const scale = Number(evaluate(spec.scale, this.names));
    const size = this.size.map((side) => Math.max(1, Math.floor(side * scale + 0.5)));
    this.result.targets[target] = { size, format: spec.format, depth: spec.depth };
    const program = this.program(stages);
    const wanted = [...uniforms].filter((uniform) => !Object.hasOwn(samplers, uniform));
    this.result.passes.push({
      name,
      target,
      clear: meta.draw === "objects" ? float32([...this.scene.background, 1]) : null,
      samplers,
      batches: [this.batch(name, meta, program, wanted, size)],
    });
    this.note("files", files);
    this.note("settings", new Set(stages.flatMap((source) => source.settings)));
  }

  private assemble(name: string, stage: Request["stage"]): Source {
    return assembled(this.library, {
      entry: `passes/${name}.glsl`,
      stage,
      choices: this.resolved.choices,
      values: this.defines,
      lists: this.lists,
    });
  }

  private program(stages: readonly Source[]): number {
    const [vertex, fragment] = stages as [Source, Source];
    const program: Program = {
      vertex: vertex.text,
      fragment: fragment.text,
      vertex_lines: [...vertex.lines],
      fragment_lines: [...fragment.lines],
      attributes: Object.keys(vertex.attributes).sort(),
    };
    return this.result.programs.push(program) - 1;
  }

  private batch(
    name: string,
    meta: Pass,
    program: number,
    wanted: readonly string[],
    size: readonly number[],
  ): Batch {
    const shared = frameValues(this.resolved, this.library, size);
    const perDraw = meta.draw === "objects" ? DRAW_NAMES : [];
    const own = wanted.filter((uniform) => perDraw.includes(uniform)).sort();
    const rest = wanted.filter((uniform) => !perDraw.includes(uniform)).sort();
    const unknown = rest.find((uniform) => !Object.hasOwn(shared, uniform));
    if (unknown !== undefined) {
      const known = [...Object.keys(shared), ...DRAW_NAMES].sort().join(", ");
      throw new ShaderError(
        `passes/${name}.glsl:1: uniform ${unknown} has no value; known are: ${known}`,
      );
    }
    const draws = meta.draw === "objects" ? this.draws(own, size) : [{ mesh: null, uniforms: {} }];
    return { program, uniforms: only(rest, shared), draws };
  }

  private draws(own: readonly string[], size: readonly number[]): Draw[] {
    return frontToBack(this.scene).map((thing) => ({
      mesh: meshKey(this.resolved, this.library, thing, size),
      uniforms: only(own, drawValues(this.scene, thing)),
    }));
  }

  /** Record the choices and files in use: what the panel shows. */
  private note(kept: "settings" | "files", found: ReadonlySet<string>): void {
    const known = this.result[kept];
    known.push(...[...found].filter((item) => !known.includes(item)));
  }
}

function only(
  names: readonly string[],
  values: Readonly<Record<string, number[]>>,
): Record<string, number[]> {
  return Object.fromEntries(names.map((name) => [name, values[name]!]));
}
