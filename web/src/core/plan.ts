/**
 * From a scene and settings to the ordered passes, as plain data; no GL in it.
 *
 * Twin of plan.py: same scene and settings, same plan.
 */

import { Batches } from "./batches";
import { LightbenchError, ShaderError } from "./errors";
import { evaluate, type Value } from "./expression";
import { type Library, passes, perLight } from "./library";
import { type Resolved, resolve, type Settings } from "./settings";
import type { Draw, Manifest, Pass, Plan, PlannedPass, Scene, Target } from "./types";
import { float32 } from "./values";
import { type LightMap, lightMap } from "./viewpoint";

export type Size = readonly [width: number, height: number];
type Named = readonly [name: string, meta: Pass];

const MAX_SIDE = 16384;
/** Texture units that WebGL2 promises to a fragment shader. */
const MAX_UNITS = 16;

/**
 * The plan of a picture of `size` (width, height) pixels.
 *
 * `attachment` is what to hand out as the linear picture: any texture that a pass writes. Throws
 * SettingError, SceneError or ShaderError with what is wrong and what is allowed.
 */
export function plan(
  manifest: Manifest,
  scene: Scene,
  settings: Settings,
  size: Size,
  attachment = "linear",
): Plan {
  const fits = size.every((side) => Number.isInteger(side) && side >= 1 && side <= MAX_SIDE);
  if (!fits) {
    const [width, height] = size;
    throw new LightbenchError(`size ${width}x${height}: each side is 1 to ${MAX_SIDE} pixels`);
  }
  return new Planner(manifest, resolve(manifest, scene, settings), size).plan(attachment);
}

/** Walks back from the outputs: a pass runs because something reads what it writes. */
class Planner {
  private readonly scene: Scene;
  private readonly names: Readonly<Record<string, Value>>;
  private readonly metas: ReadonlyMap<string, Pass>;
  private readonly maps = new Map<number, LightMap>();
  private readonly textureOf = new Map<string, string>();
  /** The textures there are of what each light has its own of, as in `shadow_map.1`. */
  private readonly lightMaps = new Set<string>();
  private readonly underWay: string[] = [];
  private readonly inspects: boolean;
  private readonly result: Plan;
  private readonly batches: Batches;

  constructor(
    private readonly library: Library,
    resolved: Resolved,
    private readonly size: Size,
  ) {
    this.scene = resolved.scene;
    const numbers = Object.entries(resolved.values).filter(
      (entry): entry is [string, number] => typeof entry[1] === "number",
    );
    const parts = Object.keys(this.scene.parts).length;
    this.names = { ...Object.fromEntries(numbers), ...resolved.choices, parts };
    this.metas = passes(library);
    const view = library.files[`views/${resolved.choices.view}.glsl`]!;
    this.inspects = Object.keys(view.functions).length > 1;
    this.result = {
      ...{ size: [...size], targets: {}, textures: {}, arrays: {}, tables: {} },
      ...{
        programs: [],
        passes: [],
        outputs: {},
        signed: view.meta.signed,
        settings: [],
        files: [],
      },
    };
    this.batches = new Batches(library, resolved, this.result);
  }

  plan(attachment: string): Plan {
    this.result.outputs.linear = this.only(attachment);
    this.result.outputs.display = this.only("display");
    return this.result;
  }

  /** The one texture of a resource, or that of one of its lights as in `shadow_map.1`. */
  private only(resource: string): string {
    const [name = "", light = ""] = resource.split(/\.(.*)/s);
    const known = new Set([...this.metas.values()].flatMap((meta) => Object.keys(meta.writes)));
    if (!known.has(name)) {
      const listed = [...known].sort().join(", ");
      throw new LightbenchError(`no attachment '${name}'; there is: ${listed}`);
    }
    const several = perLight(this.library, name);
    if (!several && !light) return this.produce(name);
    const casting = Object.values(this.scene.lights).flatMap(({ casts }, index) =>
      casts ? [`${index}`] : [],
    );
    if (several && casting.includes(light)) return this.map(name, light);
    const there = several ? casting.map((key) => `${name}.${key}`) : [name];
    throw new LightbenchError(`no attachment '${resource}'; there is: ${there.join(", ")}`);
  }

  private runs(meta: Pass): boolean {
    return !meta.when || Boolean(evaluate(meta.when, this.names));
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
    const refines = ([, meta]: Named) => meta.reads.includes(resource);
    const creators = writers.filter((writer) => !refines(writer));
    let texture = this.create(resource, creators);
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

  /**
   * Run the pass that makes `resource`; one left out hands on its first read instead.
   *
   * A pass that runs by its own condition stands above those that have none.
   */
  private create(resource: string, creators: readonly Named[]): string {
    let active = creators.filter(([, meta]) => this.runs(meta));
    const conditional = active.filter(([, meta]) => meta.when);
    if (active.length > 1 && conditional.length) active = conditional;
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
    const samplers: Record<string, string> = {};
    for (const [read, lights] of this.batches.reads(name, meta)) {
      if (perLight(this.library, read)) {
        for (const light of lights) samplers[`u_${read}${light}`] = this.map(read, light);
      } else samplers[`u_${read}`] = own[read] ?? this.produce(read);
    }
    const scale = Number(evaluate(spec.scale, this.names));
    const size = this.size.map((side) => Math.max(1, Math.floor(side * scale + 0.5)));
    this.target(target, spec, size);
    const planned = this.planned(name, meta, target, spec);
    planned.batches = this.batches.ofFrame(name, meta, size, this.maps);
    planned.samplers = samplers;
    checkUnits(planned);
    this.result.passes.push(planned);
  }

  /** The texture of a resource that the light of an index has its own of. */
  private map(resource: string, light: string): string {
    const target = `${resource}.${light}`;
    if (!this.lightMaps.has(target)) this.addMap(resource, target, Number(light));
    this.lightMaps.add(target);
    return target;
  }

  /** Append the pass that draws what one light sees. */
  private addMap(resource: string, target: string, index: number): void {
    const [name, meta] = [...this.metas].find(([, m]) => Object.hasOwn(m.writes, resource))!;
    const spec = meta.writes[resource]!;
    const side = Math.trunc(Number(evaluate(spec.side, this.names)));
    const made = lightMap(this.scene, Object.values(this.scene.lights)[index]!, side);
    this.maps.set(index, made);
    this.target(target, spec, [made.tiles[0] * side, made.tiles[1] * side]);
    const planned = this.planned(name, meta, target, spec);
    planned.batches = this.batches.ofMap(name, meta, index, made);
    this.result.passes.push(planned);
  }

  private target(name: string, { format, depth }: Target, size: number[]): void {
    this.result.targets[name] = { size, format, depth };
  }

  private planned(name: string, meta: Pass, target: string, { clear }: Target): PlannedPass {
    // A view of what objects are shows nothing where there is none.
    const behind = this.inspects ? [0, 0, 0] : this.scene.background;
    const color = clear === "background" ? [...behind, 1] : clear;
    return {
      ...{ name, target, clear: meta.draw === "objects" ? float32(color) : null },
      ...{ keep: meta.keep, samplers: {}, batches: [] },
    };
  }
}

function checkUnits({ name, samplers, batches }: PlannedPass): void {
  const targets = Object.keys(samplers).length;
  const draws = batches.flatMap((batch) => batch.draws);
  const read = ({ textures, arrays, tables }: Draw) => [textures, arrays, tables].map(Object.keys);
  const own = Math.max(0, ...draws.map((draw) => read(draw).flat().length));
  if (targets + own > MAX_UNITS) {
    throw new LightbenchError(
      `${name}: ${targets} shadow maps or targets and ${own} textures of a material at once; ` +
        `a shader has at most ${MAX_UNITS}: let fewer lights cast shadows`,
    );
  }
}
