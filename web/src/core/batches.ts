/**
 * The draws of a pass: which programs its objects need, in which state, with which numbers. Twin of
 * batches.py.
 */

import { ShaderError } from "./errors";
import type { Library } from "./library";
import type { Resolved } from "./settings";
import { type Frame, frameOf, type Stages, samePrograms, stagesOf } from "./sources";
import { NO_PATTERN, type Pattern, type Surface, surface } from "./surface";
import type { Batch, Draw, Pass, Plan, Scene, SceneObject } from "./types";
import {
  DRAW_NAMES,
  drawValue,
  float32,
  frameValues,
  frontToBack,
  lightValues,
  mapValues,
  meshKey,
  parameterValues,
  textureTransform,
  type Values,
} from "./values";
import { cameraViewpoint, inSight, type LightMap, type Viewpoint } from "./viewpoint";

/** Objects of one pattern that are drawn one after the other in one state. */
interface Run {
  readonly pattern: Pattern;
  readonly things: SceneObject[];
  readonly blend: string | null;
}

/** Makes the batches of passes, and notes the programs and textures they need in the plan. */
export class Batches {
  private readonly scene: Scene;
  private readonly frame: Frame;
  private readonly parameters: Values;
  private readonly surfaces: ReadonlyMap<SceneObject, Surface>;
  private readonly everyPattern: readonly Pattern[];

  constructor(
    private readonly library: Library,
    private readonly resolved: Resolved,
    private readonly result: Plan,
  ) {
    this.scene = resolved.scene;
    this.frame = frameOf(library, resolved);
    this.parameters = parameterValues(resolved);
    const things = Object.values(this.scene.objects);
    this.surfaces = new Map(things.map((thing) => [thing, surface(library, this.scene, thing)]));
    const patterns = things.map((thing) => this.patternOf(thing));
    this.everyPattern = [...new Map(patterns.map((pattern) => [pattern.key, pattern])).values()];
  }

  /** What the files of a pass read and its code names: the lights of each, "" for none. */
  reads(name: string, meta: Pass): ReadonlyMap<string, readonly string[]> {
    const indices = ["", ...this.frame.lights.map(({ index }) => index!)];
    const found = new Map<string, Set<string>>();
    for (const pattern of this.patterns(meta)) {
      const { fragment, vertex } = this.stages(name, meta, pattern, null);
      for (const { files, uniforms } of [fragment, vertex]) {
        for (const read of files.flatMap((path) => this.library.files[path]!.meta.reads)) {
          const live = indices.filter((index) => Object.hasOwn(uniforms, `u_${read}${index}`));
          if (live.length) found.set(read, new Set([...(found.get(read) ?? []), ...live]));
        }
      }
    }
    return new Map([...found].map(([read, lights]) => [read, [...lights]]));
  }

  /** The batches of a pass that draws the camera's picture, or the screen. */
  ofFrame(
    name: string,
    meta: Pass,
    size: readonly number[],
    maps: ReadonlyMap<number, LightMap>,
  ): Batch[] {
    const viewpoint = cameraViewpoint(this.scene, size);
    const shared = [
      lightValues(this.resolved, this.library, maps, this.scene.camera.eye),
      frameValues(viewpoint, this.scene, size),
      this.parameters,
    ];
    if (meta.draw === "screen") {
      const stages = this.stages(name, meta, NO_PATTERN, null);
      const draws = [{ mesh: null, uniforms: {}, textures: {} }];
      const state = { tile: null, cull: true, blend: null };
      return [{ program: this.program(stages), ...state, ...filled(name, stages, shared), draws }];
    }
    const things = frontToBack(this.scene, viewpoint.origin);
    return this.objects(name, meta, things, viewpoint, shared, null);
  }

  /** The batches of a pass that draws a light's map, face after face. */
  ofMap(name: string, meta: Pass, index: number, light: LightMap): Batch[] {
    return light.faces.flatMap((face) => {
      const near = frontToBack(this.scene, face.origin);
      const things = near.filter((thing) => inSight(this.scene, face, thing));
      const shared = [mapValues(face, light), this.parameters];
      return this.objects(name, meta, things, face, shared, index);
    });
  }

  private objects(
    name: string,
    meta: Pass,
    things: readonly SceneObject[],
    viewpoint: Viewpoint,
    shared: readonly Values[],
    own: number | null,
  ): Batch[] {
    return this.runs(meta, things).map(({ pattern, things: group, blend }) => {
      const stages = this.stages(name, meta, pattern, own);
      return {
        program: this.program(stages),
        tile: viewpoint.tile ? [...viewpoint.tile] : null,
        cull: !pattern.flags.includes("DOUBLE_SIDED"),
        blend,
        ...filled(name, stages, shared),
        draws: group.map((thing) => this.draw(stages, thing, viewpoint)),
      };
    });
  }

  /** Opaque objects by pattern, the nearest first; then blended ones, the farthest first. */
  private runs(meta: Pass, things: readonly SceneObject[]): readonly Run[] {
    const isClear = (thing: SceneObject) => this.patternOf(thing).flags.includes("BLEND");
    const groups = new Map<string, Run>();
    const blend = meta.blend === "add" ? "add" : null;
    for (const thing of things.filter((thing) => !isClear(thing))) {
      const pattern = this.patternOf(thing);
      const group = groups.get(pattern.key) ?? { pattern, things: [], blend };
      groups.set(pattern.key, group);
      group.things.push(thing);
    }
    const runs = [...groups.values()];
    if (meta.blend === "none") return runs;
    const clear: Run[] = [];
    for (const thing of things.filter(isClear).reverse()) {
      const pattern = this.patternOf(thing);
      const last = clear.at(-1);
      if (last?.pattern.key === pattern.key) last.things.push(thing);
      else clear.push({ pattern, things: [thing], blend: meta.blend });
    }
    return [...runs, ...clear];
  }

  private draw({ declared, own }: Stages, thing: SceneObject, viewpoint: Viewpoint): Draw {
    const { texels } = this.surfaces.get(thing)!;
    const [mesh, gap] = meshKey(this.resolved, this.library, thing, viewpoint);
    const uniforms: Record<string, number[]> = {};
    const textures: Record<string, string> = {};
    const transforms: Record<string, number[]> = {};
    for (const [index, used] of texels.entries()) {
      const sampler = `u_texture${index}`;
      const transform = `${sampler}_transform`;
      if (own.includes(transform)) transforms[transform] = textureTransform(used);
      if (!Object.hasOwn(declared, sampler)) continue;
      textures[sampler] = used.texture;
      this.noteTexture(used.texture);
    }
    for (const name of own) {
      uniforms[name] =
        name === "u_gap"
          ? float32([gap])
          : (transforms[name] ?? drawValue(this.scene, thing, viewpoint.origin, name));
    }
    return { mesh, uniforms, textures };
  }

  private noteTexture(name: string): void {
    if (Object.hasOwn(this.result.textures, name)) return;
    const { image, encoding, wrap, filter } = this.scene.textures[name]!;
    const anisotropy = Math.trunc(Number(this.resolved.values.anisotropy));
    this.result.textures[name] = { image, encoding, wrap: [...wrap], filter, anisotropy };
  }

  private patternOf(thing: SceneObject): Pattern {
    return this.surfaces.get(thing)!.pattern;
  }

  /** Every pattern that the pass draws. */
  private patterns(meta: Pass): readonly Pattern[] {
    if (meta.draw === "screen") return [NO_PATTERN];
    return this.everyPattern.filter((p) => meta.blend !== "none" || !p.flags.includes("BLEND"));
  }

  private stages(name: string, meta: Pass, pattern: Pattern, own: number | null): Stages {
    return stagesOf(this.library, this.frame, name, meta, pattern, own);
  }

  /** The index in the plan of the program of these stages. */
  private program({ program, fragment, vertex }: Stages): number {
    const { programs } = this.result;
    const known = programs.findIndex((one) => samePrograms(one, program));
    if (known >= 0) return known;
    this.note("files", [...vertex.files, ...fragment.files]);
    this.note("settings", [...vertex.settings, ...fragment.settings]);
    return programs.push(program) - 1;
  }

  /** Record the choices and files in use: what the panel shows. */
  private note(kept: "settings" | "files", found: readonly string[]): void {
    const known = this.result[kept];
    known.push(...[...new Set(found)].filter((item) => !known.includes(item)));
  }
}

/** The uniforms that all draws share, each from the first of `values` that has it. */
function filled(
  name: string,
  { shared }: Stages,
  values: readonly Values[],
): Pick<Batch, "uniforms"> {
  const uniforms: Record<string, number[]> = {};
  for (const uniform of shared) {
    const found = values.find((group) => Object.hasOwn(group, uniform));
    if (!found) {
      const known = new Set([...values.flatMap((group) => Object.keys(group)), ...DRAW_NAMES]);
      throw new ShaderError(
        `passes/${name}.glsl:1: uniform ${uniform} has no value; known are: ${[...known].sort().join(", ")}`,
      );
    }
    uniforms[uniform] = found[uniform]!;
  }
  return { uniforms };
}
