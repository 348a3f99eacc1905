/**
 * The draws of a pass: which programs its objects need, in which state, with which numbers. Twin of
 * batches.py.
 */

import { CONSTANTS, withConstants } from "./constants";
import { ShaderError } from "./errors";
import type { Library } from "./library";
import { partValues } from "./parts";
import type { Resolved } from "./settings";
import { type Asked, type Frame, frameOf, type Stages, samePrograms, stagesOf } from "./sources";
import { NO_PATTERN, type Pattern, type Surface, surface } from "./surface";
import { imageNumbers, objectList, objectValues } from "./traced";
import type { Batch, Draw, Pass, Plan, PlannedTexture, Scene, SceneObject, Texture } from "./types";
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

/** Uniforms, some of which are only made if a program asks for them. */
type Source = () => Values;

/** Makes the batches of passes, and notes the programs and textures they need in the plan. */
export class Batches {
  private readonly scene: Scene;
  private readonly frame: Frame;
  private readonly parameters: Values;
  private readonly surfaces: ReadonlyMap<SceneObject, Surface>;
  /** The number of each object. */
  private readonly indices: ReadonlyMap<SceneObject, number>;
  /** What rays ask for, and the textures that they read, array by array. */
  private asked: Asked | null = null;
  private images: readonly (readonly string[])[] = [];
  private everyObject: Values | undefined;

  constructor(
    private readonly library: Library,
    private readonly resolved: Resolved,
    private readonly result: Plan,
  ) {
    this.scene = resolved.scene;
    this.parameters = parameterValues(resolved);
    const things = Object.values(this.scene.objects);
    this.indices = new Map(things.map((thing, index) => [thing, index]));
    this.surfaces = new Map(things.map((thing) => [thing, surface(library, this.scene, thing)]));
    this.frame = frameOf(library, resolved, this.surfaces);
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
    const lights = lightValues(this.resolved, this.library, maps, this.scene.camera.eye);
    const frame = frameValues(viewpoint, this.scene, size);
    const parts = partValues(this.scene);
    const shared = [
      ...[() => lights, () => frame, () => this.parameters, () => this.ofObjects(), () => parts],
    ];
    if (meta.draw === "screen") {
      const stages = this.stages(name, meta, NO_PATTERN, null);
      const read = { textures: {}, arrays: this.arraysOf(stages), tables: this.tablesOf(stages) };
      const draws = [{ mesh: null, uniforms: {}, ...read }];
      const state = { tile: null, cull: true, blend: null };
      const { uniforms } = filled(name, stages, shared);
      if (!stages.asked || !this.resolved.values[CONSTANTS]) {
        return [{ program: this.program(stages), ...state, uniforms, draws }];
      }
      const fragment = withConstants(stages.program.fragment, uniforms);
      const program = this.program({ ...stages, program: { ...stages.program, fragment } });
      return [{ program, ...state, uniforms: {}, draws }];
    }
    const things = frontToBack(this.scene, viewpoint.origin);
    return this.objects(name, meta, things, viewpoint, shared, null);
  }

  /** The batches of a pass that draws a light's map, face after face. */
  ofMap(name: string, meta: Pass, index: number, light: LightMap): Batch[] {
    return light.faces.flatMap((face) => {
      const near = frontToBack(this.scene, face.origin);
      const things = near.filter((thing) => inSight(this.scene, face, thing));
      const own = mapValues(face, light);
      const shared = [() => own, () => this.parameters];
      return this.objects(name, meta, things, face, shared, index);
    });
  }

  private objects(
    name: string,
    meta: Pass,
    things: readonly SceneObject[],
    viewpoint: Viewpoint,
    shared: readonly Source[],
    own: number | null,
  ): Batch[] {
    // A mirrored camera turns every triangle over.
    const mirrored = this.scene.camera.mirrored && own === null;
    return this.runs(meta, things).map(({ pattern, things: group, blend }) => {
      const stages = this.stages(name, meta, pattern, own);
      return {
        program: this.program(stages),
        tile: viewpoint.tile ? [...viewpoint.tile] : null,
        cull: !pattern.flags.includes("DOUBLE_SIDED") && !mirrored,
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

  /** Uniforms of every object, once a program asks for one. */
  private ofObjects(): Values {
    const numbers = imageNumbers(this.images);
    this.everyObject ??= objectValues(this.scene, this.surfaces, numbers, this.scene.camera.eye);
    return this.everyObject;
  }

  /** The arrays of images that a program reads, by sampler. */
  private arraysOf({ declared }: Stages): Record<string, string> {
    const samplers: Record<string, string> = {};
    for (const [index, names] of this.images.entries()) {
      if (!Object.hasOwn(declared, `u_images${index}`)) continue;
      const textures = names.map((name) => this.scene.textures[name]!);
      const images = textures.map(({ image }) => image);
      const sampling = { ...this.sampling(textures[0]!), anisotropy: 1 };
      this.result.arrays[`images${index}`] = { images, ...sampling };
      samplers[`u_images${index}`] = `images${index}`;
    }
    return samplers;
  }

  /** The tables that a program reads, by sampler. */
  private tablesOf({ declared }: Stages): Record<string, string> {
    const found = ["objects", "meshes"].filter((name) => Object.hasOwn(declared, `u_${name}`));
    const { tables } = this.result;
    for (const name of found.filter((table) => !Object.hasOwn(tables, table))) {
      const things = Object.values(this.scene.objects);
      const used = things.flatMap(({ mesh }) => (mesh ? [this.scene.meshes[mesh]!.mesh] : []));
      const meshes = [...new Set(used)];
      if (name === "meshes") tables[name] = { texels: [], meshes };
      else tables[name] = { texels: this.listOf(meshes), meshes: [] };
    }
    return Object.fromEntries(found.map((name) => [`u_${name}`, name]));
  }

  private listOf(meshes: readonly string[]): number[] {
    const values = this.asked?.values ?? [];
    return objectList(this.scene, this.surfaces, this.ofObjects(), values, meshes);
  }

  private draw(stages: Stages, thing: SceneObject, viewpoint: Viewpoint): Draw {
    const { declared, own } = stages;
    const { texels } = this.surfaces.get(thing)!;
    const [mesh, gap] = meshKey(this.resolved, this.library, thing, viewpoint);
    const uniforms: Record<string, number[]> = {};
    const textures: Record<string, string> = {};
    const made: Record<string, number[]> = {
      u_gap: float32([gap]),
      u_object: [this.indices.get(thing)!],
    };
    for (const [index, used] of texels.entries()) {
      const sampler = `u_texture${index}`;
      const transform = `${sampler}_transform`;
      if (own.includes(transform)) made[transform] = textureTransform(used);
      if (!Object.hasOwn(declared, sampler)) continue;
      textures[sampler] = used.texture;
      this.noteTexture(used.texture);
    }
    for (const name of own) {
      uniforms[name] = made[name] ?? drawValue(this.scene, thing, viewpoint.origin, name);
    }
    return { mesh, uniforms, textures, arrays: {}, tables: this.tablesOf(stages) };
  }

  private noteTexture(name: string): void {
    if (Object.hasOwn(this.result.textures, name)) return;
    const texture = this.scene.textures[name]!;
    this.result.textures[name] = { image: texture.image, ...this.sampling(texture) };
  }

  private sampling({ encoding, wrap, filter }: Texture): Omit<PlannedTexture, "image"> {
    const anisotropy = Math.trunc(Number(this.resolved.values.anisotropy));
    return { encoding, wrap: [...wrap], filter, anisotropy };
  }

  private patternOf(thing: SceneObject): Pattern {
    return this.surfaces.get(thing)!.pattern;
  }

  /** Every pattern that the pass draws. */
  private patterns(meta: Pass): readonly Pattern[] {
    if (meta.draw === "screen") return [NO_PATTERN];
    const every = [...this.surfaces.values()].map(({ pattern }) => [pattern.key, pattern] as const);
    const found = [...new Map(every).values()];
    return found.filter((p) => meta.blend !== "none" || !p.flags.includes("BLEND"));
  }

  private stages(name: string, meta: Pass, pattern: Pattern, own: number | null): Stages {
    const found = stagesOf(this.library, this.frame, name, meta, pattern, own);
    if (found.asked && found.asked !== this.asked) {
      this.asked = found.asked;
      this.images = this.frame.images(found.asked.parts);
      this.everyObject = undefined;
    }
    return found;
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

/** The uniforms that all draws share, each from the first of `sources` that has it. */
function filled(
  name: string,
  { shared }: Stages,
  sources: readonly Source[],
): Pick<Batch, "uniforms"> {
  const uniforms: Record<string, number[]> = {};
  for (const uniform of shared) {
    const found = sources.find((source) => Object.hasOwn(source(), uniform));
    if (!found) {
      const names = sources.flatMap((source) => Object.keys(source()));
      const known = new Set([...names, ...DRAW_NAMES]);
      throw new ShaderError(
        `passes/${name}.glsl:1: uniform ${uniform} has no value; known are: ${[...known].sort().join(", ")}`,
      );
    }
    uniforms[uniform] = found()[uniform]!;
  }
  return { uniforms };
}
