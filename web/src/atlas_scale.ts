// How a map of the atlas is coloured, measured and put into words.
import { KINDS, type Kind, type Panel, type Precision } from "./atlas_error";
import type { Axis } from "./atlas_gl";
import { niceCeiling, spell } from "./number";

/** From exact to no digit right, lightness rising evenly, as on the sheets of `lightbench atlas`. */
export const RAMP = ["#10131c", "#1d2a52", "#2c568d", "#5d8dbd", "#a8c1d9", "#f6f7f8"];
const STOPS = RAMP.map(rgb);
/** What is no valid value, in the colours of the view `invalid`. */
export const LOUD: Record<Exclude<Kind, "finite">, [color: string, name: string]> = {
  nan: ["#ff00ff", "NaN"],
  inf: ["#ffff00", "infinite"],
  negative: ["#00ffff", "negative"],
  unknown: ["#8a8a8a", "infinite in truth"],
};

/** A place along an axis or a scale, as a share of its length, and what to write there. */
export interface Tick {
  at: number;
  text: string;
}

/** The pixels of a map, RGBA, its highest y at the top. */
export function pixels(panel: Panel, size: number): ImageData {
  const image = new ImageData(size, size);
  for (let point = 0; point < panel.ulp.length; point += 1) {
    const kind = KINDS[panel.kind[point]!]!;
    const color = kind === "finite" ? shade(panel.ulp[point]!, panel.precision) : LOUD_RGB[kind];
    const row = size - 1 - Math.floor(point / size);
    image.data.set([...color, 255], 4 * (row * size + (point % size)));
  }
  return image;
}

function shade(ulp: number, precision: Precision): number[] {
  const place = Math.min(Math.log(Math.max(ulp, 1)) / Math.log(precision.full), 1);
  const first = Math.min(Math.floor(place * (STOPS.length - 1)), STOPS.length - 2);
  const part = place * (STOPS.length - 1) - first;
  return STOPS[first]!.map((from, i) => Math.round(from + part * (STOPS[first + 1]![i]! - from)));
}

function rgb(color: string): number[] {
  return [1, 3, 5].map((at) => Number.parseInt(color.slice(at, at + 2), 16));
}

const LOUD_RGB = Object.fromEntries(
  Object.entries(LOUD).map(([kind, [color]]) => [kind, rgb(color)]),
) as Record<keyof typeof LOUD, number[]>;

/** Share of an axis that is its band of exact zeros. */
export function band(axis: Axis): number {
  return axis.zero ? axis.values.filter((value) => value === 0).length / axis.values.length : 0;
}

/** Where an axis is marked. */
export function ticks(axis: Axis): Tick[] {
  const zeros = band(axis);
  const [low, high] = axis.log
    ? [Math.log10(axis.low), Math.log10(axis.high)]
    : [axis.low, axis.high];
  const place = (value: number) => zeros + ((value - low) / (high - low)) * (1 - zeros);
  const found: Tick[] = axis.zero ? [{ at: zeros / 2, text: "0" }] : [];
  if (!axis.log) {
    const gap =
      axis.unit === "°" ? 15 * niceCeiling((high - low) / 60) : niceCeiling((high - low) / 5);
    for (let i = Math.ceil(low / gap - 1e-9); i * gap <= high + 1e-9 * gap; i += 1)
      found.push({ at: place(i * gap), text: spell(i * gap) });
    return found;
  }
  const [first, last] = [Math.ceil(low - 1e-9), Math.floor(high + 1e-9)];
  const gap = Math.max(1, Math.ceil((last - first + 1) / 5));
  for (let decade = last; decade >= first; decade -= gap)
    if (!axis.zero || place(decade) - zeros / 2 > 0.09)
      found.push({ at: place(decade), text: power(decade) });
  return found;
}

function power(decade: number): string {
  if (Math.abs(decade) <= 2) return spell(10 ** decade);
  return `10${[...`${decade}`].map((sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]).join("")}`;
}

/** Where the scale of a precision's errors is marked. */
export function scale(precision: Precision): Tick[] {
  const digits = Math.log10(precision.full);
  const decades = Array.from({ length: Math.floor(digits) + 1 }, (_, decade) => ({
    at: decade / digits,
    text: decade ? power(decade) : "≤ 1",
  }));
  return digits % 1 > 0.5 ? [...decades, { at: 1, text: "no digit" }] : decades;
}

/** Name and unit of an axis. */
export function label(axis: Pick<Axis, "label" | "unit">): string {
  return axis.unit ? `${axis.label} [${axis.unit}]` : axis.label;
}

/** A number as the page writes it. */
export function number(value: number, digits = 4): string {
  if (Number.isFinite(value)) return spell(value, digits);
  return Number.isNaN(value) ? "NaN" : value > 0 ? "∞" : "-∞";
}

function percent(share: number): string {
  return `${share < 0.0005 ? "under 0.1" : number(100 * share, 2)}\u202f%`;
}

/** What a map shows, in a sentence or two. */
export function summary(panel: Panel): string {
  const { shares } = panel;
  if (shares.unknown === 1) return "The true value is infinite everywhere.";
  const ulp = (value: number) => (value >= panel.precision.full ? "no digit" : number(value, 2));
  const spread =
    panel.largest >= panel.precision.full
      ? "and leaves no right digit at worst"
      : `and ${ulp(panel.largest)} at worst`;
  const off =
    panel.exact || panel.precision.half
      ? `Off by ${number(panel.median, 2)} ULP in the median ${spread}`
      : "No exact form to compare with";
  const invalid = (["nan", "inf", "negative"] as const).filter((kind) => shares[kind] > 0);
  if (invalid.length) {
    const parts = invalid.map((kind) => `${LOUD[kind][1]} ${percent(shares[kind])}`);
    return `${off}; not a valid value at ${percent(1 - shares.finite)} of the points: ${parts.join(", ")}.`;
  }
  const wrong =
    shares.wrong > 0 ? `, ${percent(shares.wrong)} of the points by more than 1\u202f%` : "";
  return `${off}${wrong}; every value is valid.`;
}
