/** The renderer: runs any plan on WebGL2, and knows no lighting. Twin of render.py. */

import { missing, missingFor, rendererName } from "./context";
import { Drawing } from "./drawing";
import { GraphicsError } from "./errors";
import { Geometry } from "./geometry";
import type { MeshLoader } from "./mesh";
import { Programs } from "./programs";
import { type HierarchyLoader, Tables } from "./tables";
import { type Framebuffer, Targets } from "./targets";
import { type ImageLoader, Textures } from "./textures";
import type { Plan } from "./types";

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

/** Where what plans only name comes from. */
export interface Assets {
  readonly mesh: MeshLoader;
  readonly image: ImageLoader;
  readonly hierarchy: HierarchyLoader;
}

/**
 * Owns what it makes on a context. When the context is lost, drop the renderer; when it is restored,
 * make another.
 */
export class Renderer {
  readonly name: string;
  private readonly targets: Targets;
  private readonly geometry: Geometry;
  private readonly textures: Textures;
  private readonly tables: Tables;
  private readonly programs: Programs;
  private readonly drawing: Drawing;
  private size = "";
  private last: Drawn | null = null;

  /** Throws GraphicsError with what the context lacks. */
  constructor(
    readonly gl: WebGL2RenderingContext,
    assets: Assets,
  ) {
    const problem = missing(gl);
    if (problem) throw new GraphicsError(problem);
    this.name = rendererName(gl);
    this.targets = new Targets(gl);
    this.geometry = new Geometry(gl, assets.mesh);
    this.textures = new Textures(gl, assets.image);
    this.programs = new Programs(gl, () => this.geometry.forgetPrograms());
    this.tables = new Tables(gl, assets.hierarchy);
    this.drawing = new Drawing(gl, this.geometry, this.textures, this.tables);
    gl.disable(gl.DITHER);
  }

  /** How often each pass has run, by its name: one to keep runs when it has changed. */
  get runs(): Readonly<Record<string, number>> {
    return this.drawing.runs;
  }

  /**
   * Compile all programs of a plan at once and load its meshes, images and tables, without blocking.
   *
   * Rejects with ShaderError naming file and line, or GraphicsError.
   */
  async prepare(plan: Plan): Promise<void> {
    const programs = plan.programs.map((program) => this.programs.get(program));
    await Promise.all([
      ...[...meshKeys(plan)].map((key) => this.geometry.load(key)),
      this.textures.load(plan),
      this.tables.load(plan),
    ]);
    while (!programs.every((program) => program.ready)) {
      await new Promise((resolve) => setTimeout(resolve, POLL_MILLISECONDS));
    }
    for (const program of plan.programs) this.programs.finished(program);
  }

  /** Whether `run` would draw at once. */
  ready(plan: Plan): boolean {
    return (
      plan.programs.every((program) => this.programs.ready(program)) &&
      [...meshKeys(plan)].every((key) => this.geometry.has(key)) &&
      this.textures.has(plan) &&
      this.tables.has(plan)
    );
  }

  /**
   * Draw a plan to the canvas, which takes the plan's size; within `clip` only, if given.
   *
   * A clip that follows another run in the same task leaves the rest of the canvas as it was. A pass
   * to keep that is as it was is not run again. Throws ShaderError, or GraphicsError where a mesh or
   * an image was not loaded by `prepare`.
   */
  run(plan: Plan, clip: Clip | null = null): void {
    const problem = missingFor(this.gl, plan);
    if (problem) throw new GraphicsError(problem);
    const programs = plan.programs.map((program) => this.programs.finished(program));
    const [width, height] = [plan.size[0]!, plan.size[1]!];
    const resized = this.resize(width, height);
    const shown = plan.outputs.display!;
    const direct = drawsDirectly(plan);
    const targets = Object.entries(plan.targets).filter(([name]) => !direct || name !== shown);
    const framebuffers = this.targets.of(Object.fromEntries(targets), resized);
    for (const planned of plan.passes) {
      if (direct && planned.target === shown) this.clip(clip, width, height);
      this.drawing.pass(planned, { plan, programs, framebuffers });
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
    const { plan, framebuffers } = this.drawn();
    const output = plan.outputs.linear!;
    const { size, format } = plan.targets[output]!;
    const [width, height] = size as [number, number];
    const framebuffer = framebuffers.get(output)!;
    if (pixel) return readFloats(this.gl, framebuffer, format, ...flippedRow(pixel, height), 1, 1);
    return flipped(readFloats(this.gl, framebuffer, format, 0, 0, width, height), width * 4);
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
    this.programs.clear();
    this.targets.clear();
    this.geometry.clear();
    this.textures.clear();
    this.tables.clear();
    this.last = null;
  }

  private drawn(): Drawn {
    if (!this.last) throw new GraphicsError("nothing was drawn yet");
    return this.last;
  }

  /** Whether the canvas has another size than for the last run. */
  private resize(width: number, height: number): boolean {
    const { canvas } = this.gl;
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    const { drawingBufferWidth, drawingBufferHeight } = this.gl;
    if (drawingBufferWidth !== width || drawingBufferHeight !== height) {
      throw new GraphicsError(`this browser has no canvas of ${width}x${height} pixels`);
    }
    const resized = this.size !== `${width}x${height}`;
    this.size = `${width}x${height}`;
    return resized;
  }

  private clip(clip: Clip | null, width: number, height: number): void {
    if (!clip) return;
    const [left, right] = [Math.round(clip.left * width), Math.round(clip.right * width)];
    this.gl.enable(this.gl.SCISSOR_TEST);
    this.gl.scissor(left, 0, Math.max(right - left, 0), height);
  }

  private copy(source: Framebuffer, width: number, height: number): void {
    const { gl } = this;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, source.handle);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    const all = [0, 0, width, height] as const;
    gl.blitFramebuffer(...all, ...all, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }
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

function flippedRow([x, y]: readonly [number, number], height: number): [number, number] {
  return [x, height - 1 - y];
}

/** RGBA of a rectangle, bottom up; a format of one channel is grey. */
function readFloats(
  gl: WebGL2RenderingContext,
  { handle }: Framebuffer,
  format: string,
  x: number,
  y: number,
  width: number,
  height: number,
): Float32Array<ArrayBuffer> {
  gl.bindFramebuffer(gl.FRAMEBUFFER, handle);
  if (format === "rgba8") {
    const codes = new Uint8Array(width * height * 4);
    gl.readPixels(x, y, width, height, gl.RGBA, gl.UNSIGNED_BYTE, codes);
    return Float32Array.from(codes, (code) => code / 255);
  }
  const data = new Float32Array(width * height * 4);
  gl.readPixels(x, y, width, height, gl.RGBA, gl.FLOAT, data);
  if (format === "r32f") {
    for (let at = 0; at < data.length; at += 4) data.fill(data[at]!, at, at + 3);
  }
  return data;
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
