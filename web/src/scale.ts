// How a slider maps its length to values: evenly, or by factors.
import { clamp, decimals, shorten, snap } from "./number";

/** What a slider shows; `low` to `high` is its reach, `min` to `max` what may be typed. */
export interface Scale {
  label: string;
  unit: string;
  low: number;
  high: number;
  min: number;
  max: number;
  step: number;
  log: boolean;
}

// Positions of the native slider, and those of an arrow key on a logarithmic one.
export const POSITIONS = 1000;
const LOG_STEP = 10;

/** Value at a position 0..1; a logarithmic scale that begins at 0 keeps 0 as its first position. */
export function fromPosition(scale: Scale, position: number): number {
  const { low, high, step, log } = scale;
  if (!log) return snap(low + position * (high - low), step);
  if (position <= 0) return low;
  const start = low > 0 ? low : Math.min(step, high / 100);
  return shorten(start * (high / start) ** position, 3);
}

/** Position 0..1 of a value. */
export function toPosition(scale: Scale, value: number): number {
  const { low, high, step, log } = scale;
  if (!log) return clamp((value - low) / (high - low), 0, 1);
  const start = low > 0 ? low : Math.min(step, high / 100);
  return value <= start ? 0 : clamp(Math.log(value / start) / Math.log(high / start), 0, 1);
}

/** The value one key press away: a step, ten with shift. */
export function stepped(scale: Scale, value: number, steps: number): number {
  const { low, high, step, log } = scale;
  if (!log) return clamp(snap(value + steps * step, step), low, high);
  const position = toPosition(scale, value) + (steps * LOG_STEP) / POSITIONS;
  return fromPosition(scale, clamp(position, 0, 1));
}

/** The number as its field shows it. */
export function display(scale: Scale, value: number): string {
  if (scale.log) return `${shorten(value, 4)}`;
  const size = Math.abs(value);
  const fraction = size !== 0 && size < scale.step ? 6 : size < 10 ? 3 : size < 100 ? 2 : 1;
  return `${Number(value.toFixed(Math.max(decimals(scale.step), fraction)))}`;
}

/** `cd/m^2` with its raised 2; degrees by their sign. */
export function pretty(unit: string): string {
  return unit.replace(/\^2/g, "²").replace(/\^3/g, "³").replace(/^deg$/, "°");
}
