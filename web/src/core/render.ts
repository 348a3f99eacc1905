/** The renderer: runs any plan on WebGL2, and knows no lighting. Twin of render.py. */

import { GraphicsError } from "./errors";
import { Geometry } from "./geometry";
import type { MeshLoader } from "./mesh";
import { CompiledProgram } from "./program";
import { type Framebuffer, Targets } from "./targets";
import type { Batch, Plan, PlannedPass, Program } from "./types";

const MAX_PROGRAMS = 256;
const POLL_MILLISECONDS = 4;

/** Columns of the canvas from `left` to `right`, as shares of its width. */
export interface Clip {
  readonly left: number;
  readonly right: number;
}

interface Drawn {
  readonly plan: Plan;
  readonly framebuffers: ReadonlyMap<string, Framebuffer>;
}

/** A context of the canvas as the renderer needs it. Throws GraphicsError where there is none. */
export function createContext(canvas: HTMLCanvasElement | OffscreenCanvas): WebGL2RenderingContext {
  const options: WebGLContextAttributes = {
    alpha: false,
    antialias: false,
    depth: false,
    powerPreference: "high-performance",
  };
  const gl = canvas.getContext("webgl2", options) as WebGL2RenderingContext | null;
  if (!gl) throw new GraphicsError("WebGL2 is missing: this browser has none, or it is turned off");
  return gl;
}

/** What this context cannot do that the renderer needs; null where nothing is missing. */
export function missing(gl: WebGL2RenderingContext): string | null {
  if (gl.isContextLost()) return "the browser took the graphics context away";
  if (gl.getExtension("EXT_color_buffer_float")) return null;
  return "EXT_color_buffer_float is missing: this device cannot draw to float32 pictures";
}

/** The name of the GL behind a context. */
export function rendererName(gl: WebGL2RenderingContext): string {
  const unmasked = gl.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL;
  return String(gl.getParameter(unmasked ?? gl.RENDERER));
}

/**
 * Owns what it makes on a context. When the context is lost, drop the renderer; when it is restored,
 * make another.
 */
export class Renderer {
  readonly name: string;
  private readonly targets: Targets;
  private readonly geometry: Geometry;
  private readonly programs = new Map<string, CompiledProgram>();
  private size = "";
  private last: Drawn | null = null;

  /** Throws GraphicsError with what the context lacks. */
  constructor(
    readonly gl: WebGL2RenderingContext,
    meshes: MeshLoader,
  ) {
    const problem = missing(gl);
    if (problem) throw new GraphicsError(problem);
    this.name = rendererName(gl);
    this.targets = new Targets(gl);
    this.geometry = new Geometry(gl, meshes);
    gl.disable(gl.DITHER);
  }

  /**
   * Compile all programs of a plan at once and load its meshes, without blocking.
   *
   * Rejects with ShaderError naming file and line, or GraphicsError.
   */
  async prepare(plan: Plan): Promise<void> {
    const programs = plan.programs.map((program) => this.program(program));
    await Promise.all([...meshKeys(plan)].map((key) => this.geometry.load(key)));
    while (!programs.every((program) => program.ready)) {
      await new Promise((resolve) => setTimeout(resolve, POLL_MILLISECONDS));
    }
    for (const program of plan.programs) this.finished(program);
  }

  /** Whether `run` would draw at once. */
  ready(plan: Plan): boolean {
    const compiled = plan.programs.every((program) => this.programs.get(keyOf(program))?.ready);
    return compiled && [...meshKeys(plan)].every((key) => this.geometry.has(key));
  }

  /**
   * Draw a plan to the canvas, which takes the plan's size; within `clip` only, if given.
   *
   * A clip that follows another run in the same task leaves the rest of the canvas as it was.
   * Throws ShaderError, or GraphicsError where a mesh was not loaded by `prepare`.
   */
  run(plan: Plan, clip: Clip | null = null): void {
    const programs = plan.programs.map((program) => this.finished(program));
    const [width, height] = [plan.size[0]!, plan.size[1]!];
    this.resize(width, height);
    const shown = plan.outputs.display!;
    const direct = drawsDirectly(plan);
    const targets = Object.entries(plan.targets).filter(([name]) => !direct || name !== shown);
    const framebuffers = this.targets.of(Object.fromEntries(targets));
    for (const planned of plan.passes) {
      if (direct && planned.target === shown) this.clip(clip, width, height);
      this.draw(planned, plan, programs, framebuffers);
    }
    if (!direct) {
      this.clip(clip, width, height);
      this.copy(framebuffers.get(shown)!, width, height);
    }
    this.gl.disable(this.gl.SCISSOR_TEST);
    this.last = { plan, framebuffers };
  }

  /** Linear RGBA of the last run, row 0 at the top: of all of it, or of one pixel. */
  readLinear(pixel: readonly [x: number, y: number] | null = null): Float32Array<ArrayBuffer> {
    const { gl } = this;
    const { plan, framebuffers } = this.drawn();
    const output = plan.outputs.linear!;
    const [width, height] = plan.targets[output]!.size as [number, number];
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffers.get(output)!.handle);
    if (pixel) {
      const one = new Float32Array(4);
      gl.readPixels(pixel[0], height - 1 - pixel[1], 1, 1, gl.RGBA, gl.FLOAT, one);
      return one;
    }
    const data = new Float32Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, data);
    return flipped(data, width * 4);
  }

  /** Display codes (RGBA) of the last run, row 0 at the top. */
  readDisplay(): Uint8Array<ArrayBuffer> {
    const { gl } = this;
    const { plan } = this.drawn();
    this.run(plan); // the browser may have cleared the canvas since
    const [width, height] = [plan.size[0]!, plan.size[1]!];
    const data = new Uint8Array(width * height * 4);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return flipped(data, width * 4);
  }

  /** Release everything; the renderer is of no use after it. */
  dispose(): void {
    this.forgetPrograms();
    this.targets.clear();
    this.geometry.clear();
    this.last = null;
  }

  private drawn(): Drawn {
    if (!this.last) throw new GraphicsError("nothing was drawn yet");
    return this.last;
  }

  private program(source: Program): CompiledProgram {
    const key = keyOf(source);
    const known = this.programs.get(key);
    if (known) return known;
    if (this.programs.size >= MAX_PROGRAMS) this.forgetPrograms();
    const program = new CompiledProgram(this.gl, source);
    this.programs.set(key, program);
    return program;
  }

  private finished(source: Program): CompiledProgram {
    const program = this.program(source);
    try {
      program.finish();
    } catch (error) {
      this.programs.delete(keyOf(source));
      throw error;
    }
    return program;
  }

  private forgetPrograms(): void {
    this.geometry.forgetPrograms();
    for (const program of this.programs.values()) program.dispose();
    this.programs.clear();
  }

  private resize(width: number, height: number): void {
    const { canvas } = this.gl;
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    const { drawingBufferWidth, drawingBufferHeight } = this.gl;
    if (drawingBufferWidth !== width || drawingBufferHeight !== height) {
      throw new GraphicsError(`this browser has no canvas of ${width}x${height} pixels`);
    }
    if (this.size !== `${width}x${height}`) this.targets.clear();
    this.size = `${width}x${height}`;
  }

  private clip(clip: Clip | null, width: number, height: number): void {
    if (!clip) return;
    const [left, right] = [Math.round(clip.left * width), Math.round(clip.right * width)];
    this.gl.enable(this.gl.SCISSOR_TEST);
    this.gl.scissor(left, 0, Math.max(right - left, 0), height);
  }

  /** Run one pass; a target that is in no framebuffer is the canvas. */
  private draw(
    planned: PlannedPass,
    plan: Plan,
    programs: readonly CompiledProgram[],
    framebuffers: ReadonlyMap<string, Framebuffer>,
  ): void {
    const { gl } = this;
    const target = plan.targets[planned.target]!;
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffers.get(planned.target)?.handle ?? null);
    gl.viewport(0, 0, target.size[0]!, target.size[1]!);
    for (const feature of [gl.DEPTH_TEST, gl.CULL_FACE]) {
      if (target.depth) gl.enable(feature);
      else gl.disable(feature);
    }
    if (planned.clear) {
      gl.clearBufferfv(gl.COLOR, 0, planned.clear);
      if (target.depth) gl.clearBufferfv(gl.DEPTH, 0, [1]);
    }
    for (const [unit, name] of Object.values(planned.samplers).entries()) {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, framebuffers.get(name)!.texture);
    }
    for (const batch of planned.batches) {
      const program = programs[batch.program]!;
      program.use();
      for (const [unit, name] of Object.keys(planned.samplers).entries()) program.set(name, [unit]);
      this.drawBatch(batch, program);
    }
  }

  private drawBatch(batch: Batch, program: CompiledProgram): void {
    for (const [name, value] of Object.entries(batch.uniforms)) program.set(name, value);
    for (const { mesh, uniforms } of batch.draws) {
      for (const [name, value] of Object.entries(uniforms)) program.set(name, value);
      this.geometry.draw(program, mesh);
    }
  }

  private copy(source: Framebuffer, width: number, height: number): void {
    const { gl } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, source.handle);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    const all = [0, 0, width, height] as const;
    gl.blitFramebuffer(...all, ...all, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }
}

function keyOf(program: Program): string {
  return `${program.vertex}\0${program.fragment}`;
}

function meshKeys(plan: Plan): ReadonlySet<string> {
  const batches = plan.passes.flatMap((planned) => planned.batches);
  const keys = batches.flatMap((batch) => batch.draws.map((draw) => draw.mesh));
  return new Set(keys.filter((key) => key !== null));
}

/** Whether the picture needs no texture of its own on its way to the canvas. */
function drawsDirectly(plan: Plan): boolean {
  const output = plan.outputs.display!;
  const { format, depth, size } = plan.targets[output]!;
  const sampled = plan.passes.some((pass) => Object.values(pass.samplers).includes(output));
  const whole = size.every((side, axis) => side === plan.size[axis]);
  return whole && !sampled && !depth && format === "rgba8" && output !== plan.outputs.linear;
}

/** Rows from the bottom up as rows from the top down, in place. */
function flipped<Pixels extends Float32Array | Uint8Array>(data: Pixels, stride: number): Pixels {
  const rows = data.length / stride;
  const spare = data.slice(0, stride);
  for (let row = 0; row < rows >> 1; row += 1) {
    const [top, bottom] = [row * stride, (rows - 1 - row) * stride];
    spare.set(data.subarray(top, top + stride));
    data.copyWithin(top, bottom, bottom + stride);
    data.set(spare, bottom);
  }
  return data;
}
