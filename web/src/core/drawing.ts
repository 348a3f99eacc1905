/** One pass of a plan on WebGL2: targets, state, programs, textures, meshes. */

import type { Geometry } from "./geometry";
import type { CompiledProgram } from "./program";
import { same } from "./same";
import type { Tables } from "./tables";
import type { Framebuffer } from "./targets";
import type { Textures } from "./textures";
import type { Batch, Draw, Plan, PlannedPass, PlannedTarget } from "./types";

/** What a plan is drawn with. A target that is in no framebuffer is the canvas. */
export interface Equipment {
  readonly plan: Plan;
  readonly programs: readonly CompiledProgram[];
  readonly framebuffers: ReadonlyMap<string, Framebuffer>;
}

/** All that decides what a pass draws. */
interface Content {
  readonly planned: PlannedPass;
  readonly read: Read;
  readonly programs: readonly CompiledProgram[];
}

/** What draws read beside their meshes, by name. */
type Read = Pick<Plan, "textures" | "arrays" | "tables">;

/** Draws passes, those to keep only when they have changed. */
export class Drawing {
  /** How often each pass has run, by its name. */
  readonly runs: Record<string, number> = {};
  /** What the kept passes have drawn: nothing else has drawn to these framebuffers since. */
  private readonly drawn = new WeakMap<Framebuffer, Content>();

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly geometry: Geometry,
    private readonly textures: Textures,
    private readonly tables: Tables,
  ) {}

  /** Run a pass, unless it is to be kept and its target holds what it would draw. */
  pass(planned: PlannedPass, equipment: Equipment): void {
    const framebuffer = equipment.framebuffers.get(planned.target);
    if (!framebuffer) {
      this.draw(planned, equipment, null);
      return;
    }
    const content = planned.keep ? contentOf(planned, equipment) : null;
    if (content && holds(this.drawn.get(framebuffer), content)) return;
    this.drawn.delete(framebuffer);
    this.draw(planned, equipment, framebuffer);
    if (content) this.drawn.set(framebuffer, content);
  }

  private draw(
    planned: PlannedPass,
    { plan, programs, framebuffers }: Equipment,
    framebuffer: Framebuffer | null,
  ): void {
    const { gl } = this;
    const target = plan.targets[planned.target]!;
    this.runs[planned.name] = (this.runs[planned.name] ?? 0) + 1;
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer?.handle ?? null);
    gl.depthMask(true);
    if (planned.clear) {
      gl.clearBufferfv(gl.COLOR, 0, planned.clear);
      if (target.depth) gl.clearBufferfv(gl.DEPTH, 0, [1]);
    }
    const samplers = Object.entries(planned.samplers);
    for (const [unit, [, name]] of samplers.entries()) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, framebuffers.get(name)!.texture);
      gl.bindSampler(unit, null); // a target is read as its texture says
    }
    for (const batch of planned.batches) {
      const program = programs[batch.program]!;
      program.use();
      for (const [unit, [name]] of samplers.entries()) program.set(name, [unit]);
      this.setState(batch, target);
      this.batch(batch, program, plan, samplers.length);
    }
  }

  /** Depth test, culling, blending and the part of the target of a batch. */
  private setState({ draws, cull, blend, tile }: Batch, { size, depth }: PlannedTarget): void {
    const { gl } = this;
    const objects = draws.some((draw) => draw.mesh !== null);
    const enable = (feature: GLenum, on: boolean) =>
      on ? gl.enable(feature) : gl.disable(feature);
    enable(gl.DEPTH_TEST, depth);
    enable(gl.CULL_FACE, objects && cull);
    enable(gl.BLEND, blend !== null);
    if (blend === "over") gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    else if (blend === "add") gl.blendFunc(gl.ONE, gl.ONE);
    gl.depthMask(blend === null);
    const [x = 0, y = 0, side = 0] = tile ?? [];
    if (tile) gl.viewport(x, y, side, side);
    else gl.viewport(0, 0, size[0]!, size[1]!);
  }

  private batch(
    { uniforms, draws }: Batch,
    program: CompiledProgram,
    read: Read,
    firstUnit: number,
  ): void {
    for (const [name, value] of Object.entries(uniforms)) program.set(name, value);
    for (const draw of draws) {
      for (const [name, value] of Object.entries(draw.uniforms)) program.set(name, value);
      this.bind(draw, program, read, firstUnit);
      this.geometry.draw(program, draw.mesh);
    }
  }

  /** Tables first, on the same units for every draw: they go without the images' samplers. */
  private bind(draw: Draw, program: CompiledProgram, read: Read, firstUnit: number): void {
    let unit = firstUnit;
    for (const [sampler, name] of Object.entries(draw.tables)) {
      this.tables.bind(unit, name, read.tables[name]!);
      program.set(sampler, [unit++]);
    }
    for (const kind of ["textures", "arrays"] as const) {
      for (const [sampler, name] of Object.entries(draw[kind])) {
        this.textures.bind(unit, read[kind][name]!);
        program.set(sampler, [unit++]);
      }
    }
  }
}

function contentOf(planned: PlannedPass, { plan, programs }: Equipment): Content {
  const used = planned.batches.map((batch) => programs[batch.program]!);
  return { planned, read: readBy(planned, plan), programs: used };
}

/** What the draws of a pass name: a table that others read may change with every frame. */
function readBy({ batches }: PlannedPass, { textures, arrays, tables }: Plan): Read {
  const draws = batches.flatMap((batch) => batch.draws);
  const named = <Planned>(kind: keyof Read, all: Readonly<Record<string, Planned>>) => {
    const names = new Set(draws.flatMap((draw) => Object.values(draw[kind])));
    return Object.fromEntries([...names].map((name) => [name, all[name]!]));
  };
  return {
    textures: named("textures", textures),
    arrays: named("arrays", arrays),
    tables: named("tables", tables),
  };
}

function holds(drawn: Content | undefined, { planned, read, programs }: Content): boolean {
  if (drawn?.programs.length !== programs.length) return false;
  const compiled = programs.every((program, index) => program === drawn.programs[index]);
  return compiled && same(drawn.planned, planned) && same(drawn.read, read);
}
