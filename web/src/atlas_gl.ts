// Maps of the stability atlas, computed here: the page's own GPU against the exact values.
import { compare, type Panel, type Precision } from "./atlas_error";
import { createContext, missing, rendererName } from "./core/context";
import { GraphicsError, LightbenchError } from "./core/errors";
import { CompiledProgram } from "./core/program";
import type { Program } from "./core/types";

/** One array of a document: where it begins, counted from the end of the header, and its shape. */
interface Place {
  at: number;
  rows: number;
  components: number;
}

/** An input of a function. */
export interface Input {
  name: string;
  label: string;
  low: number;
  high: number;
  at: number;
  unit: string;
  log: boolean;
  /** The axis begins with a band of exact zeros. */
  zero: boolean;
}

export interface Axis extends Input {
  values: number[];
}

interface Form {
  file: string;
  textbook: boolean;
  precision: Precision;
  program: Program;
  uniforms: Record<string, number[]>;
  columns: (Place & { sampler: string })[];
  components: number;
  exact: Place | null;
}

interface Header {
  file: string;
  function: string;
  title: string;
  note: string;
  size: number;
  x: Axis;
  y: Axis;
  fixed: Input[];
  forms: Form[];
}

/** A sweep as `atlas_data.py` packs it. */
export interface Sweep extends Header {
  arrays: ArrayBuffer;
}

const POLL_MILLISECONDS = 4;

/** A document of `data/atlas/`. */
export function unpack(data: ArrayBuffer): Sweep {
  const length = new DataView(data).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(data, 4, length));
  return { ...(JSON.parse(text) as Header), arrays: data.slice(4 + length) };
}

let context: WebGL2RenderingContext | null = null;

function ownContext(): WebGL2RenderingContext {
  if (context?.isContextLost()) context = null;
  context ??= createContext(new OffscreenCanvas(1, 1));
  const problem = missing(context);
  if (problem) throw new GraphicsError(problem);
  return context;
}

/** Compute every form on this GPU. Throws GraphicsError, or ShaderError naming file and line. */
export async function compute(sweep: Sweep): Promise<{ panels: Panel[]; renderer: string }> {
  const gl = ownContext();
  const programs = sweep.forms.map((form) => new CompiledProgram(gl, form.program));
  try {
    while (!programs.every((program) => program.ready))
      await new Promise((resolve) => setTimeout(resolve, POLL_MILLISECONDS));
    const results = draw(gl, sweep, programs);
    const panels = sweep.forms.map((form, index) => {
      const { file, textbook, precision, components } = form;
      const single = sweep.forms.findIndex(
        (other) => other.file === form.file && !other.precision.half,
      );
      const want = form.exact
        ? spread(doubles(sweep, form.exact), form.exact.components, results[index]!.length)
        : Float64Array.from(results[single]!);
      return compare(
        { file, textbook, precision, components, exact: form.exact !== null },
        results[index]!,
        want,
      );
    });
    return { panels, renderer: rendererName(gl) };
  } finally {
    for (const program of programs) program.dispose();
  }
}

/** What the programs return, `components` numbers a point. */
function draw(
  gl: WebGL2RenderingContext,
  sweep: Sweep,
  programs: readonly CompiledProgram[],
): Float32Array[] {
  const { size } = sweep;
  const textures = new Map<string, WebGLTexture>();
  const target = texture(gl, size, size, null);
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.disable(gl.DITHER);
  gl.viewport(0, 0, size, size);
  try {
    return sweep.forms.map((form, index) => {
      const program = programs[index]!;
      program.finish();
      program.use();
      for (const [unit, column] of form.columns.entries()) {
        const key = `${column.at} ${column.rows} ${column.components}`;
        gl.activeTexture(gl.TEXTURE0 + unit);
        const found = textures.get(key) ?? upload(gl, sweep, column);
        textures.set(key, found);
        gl.bindTexture(gl.TEXTURE_2D, found);
        program.set(column.sampler, [unit]);
      }
      for (const [name, value] of Object.entries(form.uniforms)) program.set(name, value);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      const read = new Float32Array(size * size * 4);
      gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, read);
      if (gl.isContextLost()) throw new GraphicsError("the browser took the graphics context away");
      const { components } = form;
      return new Float32Array(size * size * components).map(
        (_, i) => read[Math.floor(i / components) * 4 + (i % components)]!,
      );
    });
  } finally {
    gl.deleteFramebuffer(framebuffer);
    for (const each of [target, ...textures.values()]) gl.deleteTexture(each);
  }
}

function upload(gl: WebGL2RenderingContext, sweep: Sweep, place: Place): WebGLTexture {
  const { at, rows, components } = place;
  const values = new Float32Array(sweep.arrays, at, rows * components);
  const side = rows === 1 ? 1 : sweep.size;
  if (side * side !== rows)
    throw new LightbenchError("The map's data is damaged. Reload the page to try again.");
  const texels = new Float32Array(rows * 4);
  for (let i = 0; i < values.length; i += 1)
    texels[Math.floor(i / components) * 4 + (i % components)] = values[i]!;
  return texture(gl, side, side, texels);
}

function texture(
  gl: WebGL2RenderingContext,
  width: number,
  height: number,
  texels: Float32Array | null,
): WebGLTexture {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, texels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return made;
}

function doubles(sweep: Sweep, { at, rows, components }: Place): Float64Array {
  return new Float64Array(sweep.arrays, at, rows * components);
}

/** A lone row stands for all. */
function spread(values: Float64Array, components: number, length: number): Float64Array {
  if (values.length === length) return values;
  return new Float64Array(length).map((_, i) => values[i % components]!);
}
