// Maps of the stability atlas, computed here: the page's own GPU against the exact values.
import { GraphicsError, LightbenchError } from "./core/errors";
import { CompiledProgram } from "./core/program";
import { createContext, missing, rendererName } from "./core/render";
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

export interface Precision {
  name: string;
  bits: number;
  tiny: number;
  negligible: number;
  half: boolean;
  /** ULP in the value itself. */
  full: number;
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

/** What a point is; the last is where the truth is infinite too. */
export const KINDS = ["finite", "nan", "inf", "negative", "unknown"] as const;
export type Kind = (typeof KINDS)[number];
const [FINITE, NAN, INF, NEGATIVE, UNKNOWN] = [0, 1, 2, 3, 4];
// From this relative error on a result is called wrong.
const WRONG = 0.01;
const LARGEST = 2 ** 128 - 2 ** 104;
const POLL_MILLISECONDS = 4;

/** One form in one precision; a row of points after the other, the lowest y first. */
export interface Panel {
  file: string;
  textbook: boolean;
  precision: Precision;
  /** Whether the truth is the exact form's; else it is this form's in float32. */
  exact: boolean;
  components: number;
  got: Float32Array;
  want: Float64Array;
  ulp: Float64Array;
  kind: Uint8Array;
  /** Share of the points with a finite truth. */
  shares: Record<Kind | "wrong", number>;
  median: number;
  largest: number;
}

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
      const single = sweep.forms.findIndex(
        (other) => other.file === form.file && !other.precision.half,
      );
      const want = form.exact
        ? spread(doubles(sweep, form.exact), form.exact.components, results[index]!.length)
        : Float64Array.from(results[single]!);
      return compare(form, results[index]!, want);
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

/** Errors in ULP and what is no valid value; of a vector's components the worst counts. */
export function compare(
  form: Pick<Form, "file" | "textbook" | "precision" | "components" | "exact">,
  got: Float32Array,
  want: Float64Array,
): Panel {
  const { precision, components, file, textbook } = form;
  const count = got.length / components;
  const ulp = new Float64Array(count);
  const kind = new Uint8Array(count);
  const shares = { finite: 0, nan: 0, inf: 0, negative: 0, unknown: 0, wrong: 0 };
  for (let point = 0; point < count; point += 1) {
    const first = point * components;
    const worst = { known: true, nan: false, inf: false, negative: false, ulp: 0, wrong: false };
    for (let i = first; i < first + components; i += 1) add(worst, got[i]!, want[i]!, precision);
    const found = !worst.known
      ? UNKNOWN
      : worst.nan
        ? NAN
        : worst.inf
          ? INF
          : worst.negative
            ? NEGATIVE
            : FINITE;
    kind[point] = found!;
    if (found === FINITE) ulp[point] = worst.ulp;
    shares[KINDS[found!]!] += 1;
    if (found !== UNKNOWN && (found !== FINITE || worst.wrong)) shares.wrong += 1;
  }
  const known = Math.max(count - shares.unknown, 1);
  for (const name of ["finite", "nan", "inf", "negative", "wrong"] as const) shares[name] /= known;
  shares.unknown /= count;
  const sorted = ulp.filter((_, point) => kind[point] === FINITE).sort();
  const half = sorted.length / 2;
  const median = sorted.length ? (sorted[Math.ceil(half) - 1]! + sorted[Math.floor(half)]!) / 2 : 0;
  const exact = form.exact !== null;
  const largest = sorted.at(-1) ?? 0;
  return {
    file,
    textbook,
    precision,
    exact,
    components,
    got,
    want,
    ulp,
    kind,
    shares,
    median,
    largest,
  };
}

interface Worst {
  known: boolean;
  nan: boolean;
  inf: boolean;
  negative: boolean;
  ulp: number;
  wrong: boolean;
}

function add(worst: Worst, got: number, want: number, precision: Precision): void {
  const known = Math.abs(want) <= LARGEST; // false for NaN
  const truth = known ? want : 0;
  worst.known &&= known;
  worst.nan ||= Number.isNaN(got);
  worst.inf ||= Math.abs(got) === Number.POSITIVE_INFINITY;
  worst.negative ||= got < 0 && truth >= 0;
  if (!Number.isFinite(got) || !known) return;
  if (Math.max(Math.abs(truth), Math.abs(got)) < precision.negligible) return;
  const off = Math.abs(got - truth);
  worst.ulp = Math.max(worst.ulp, off / step(truth, precision));
  worst.wrong ||= off > WRONG * Math.max(Math.abs(truth), precision.tiny);
}

const word = new DataView(new ArrayBuffer(8));

/** The step between neighbouring numbers of a precision at a value. */
export function step(value: number, precision: Precision): number {
  word.setFloat64(0, Math.max(Math.abs(value), precision.tiny));
  const exponent = (word.getUint32(0) >>> 20) + 1 - precision.bits;
  word.setUint32(0, exponent << 20);
  word.setUint32(4, 0);
  return word.getFloat64(0);
}
