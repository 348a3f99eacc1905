// How far results are from the truth, in ULP: the measure of `lightbench atlas`, in the browser.

export interface Precision {
  name: string;
  bits: number;
  tiny: number;
  negligible: number;
  half: boolean;
  /** ULP in the value itself. */
  full: number;
}

/** What a point is; the last is where the truth is infinite too. */
export const KINDS = ["finite", "nan", "inf", "negative", "unknown"] as const;
export type Kind = (typeof KINDS)[number];
// From this relative error on a result is called wrong.
const WRONG = 0.01;
const LARGEST = 2 ** 128 - 2 ** 104;
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
  /** Of the points with a finite truth; `unknown` of all. */
  shares: Record<Kind | "wrong", number>;
  median: number;
  largest: number;
}

/** Compare `components` numbers a point with the truth; of a vector's components the worst counts. */
export function compare(
  form: Pick<Panel, "file" | "textbook" | "precision" | "exact" | "components">,
  got: Float32Array,
  want: Float64Array,
): Panel {
  const { precision, components } = form;
  const count = got.length / components;
  const ulp = new Float64Array(count);
  const kind = new Uint8Array(count);
  const counts = { finite: 0, nan: 0, inf: 0, negative: 0, unknown: 0, wrong: 0 };
  for (let point = 0; point < count; point += 1) {
    const worst = { known: true, nan: false, inf: false, negative: false, ulp: 0, wrong: false };
    for (let i = point * components; i < (point + 1) * components; i += 1)
      add(worst, got[i]!, want[i]!, precision);
    const found = kindOf(worst);
    kind[point] = KINDS.indexOf(found);
    if (found === "finite") ulp[point] = worst.ulp;
    counts[found] += 1;
    if (found !== "unknown" && (found !== "finite" || worst.wrong)) counts.wrong += 1;
  }
  const sorted = ulp.filter((_, point) => kind[point] === 0).sort();
  const largest = sorted.at(-1) ?? 0;
  return {
    ...form,
    got,
    want,
    ulp,
    kind,
    shares: shares(counts, count),
    median: median(sorted),
    largest,
  };
}

function kindOf(worst: Worst): Kind {
  if (!worst.known) return "unknown";
  if (worst.nan) return "nan";
  if (worst.inf) return "inf";
  return worst.negative ? "negative" : "finite";
}

function shares(counts: Panel["shares"], count: number): Panel["shares"] {
  const known = Math.max(count - counts.unknown, 1);
  const part = (name: keyof typeof counts) => [name, counts[name] / known] as const;
  const names = Object.keys(counts) as (keyof typeof counts)[];
  return { ...counts, ...Object.fromEntries(names.map(part)), unknown: counts.unknown / count };
}

function median(sorted: Float64Array): number {
  const half = sorted.length / 2;
  return sorted.length ? (sorted[Math.ceil(half) - 1]! + sorted[Math.floor(half)]!) / 2 : 0;
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
