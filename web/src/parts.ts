// Sliders that hold a part of a value: an axis of a position, all factors of a scale at once, an
// angle of a direction, the brightness of a colour.
import { fromHex, hue, isHex, level, toHex } from "./color";
import type { Value } from "./fields";
import { shorten } from "./number";

export type Part =
  | ("x" | "y" | "z")
  | "all"
  | ("red" | "green" | "blue")
  | "azimuth"
  | "elevation"
  | "hue"
  | "level";

const AXES: readonly Part[] = ["x", "y", "z"];
const CHANNELS: readonly Part[] = ["red", "green", "blue"];
const DEGREES = 180 / Math.PI;

/** Three numbers of a vector or of a colour in either spelling. */
export function triple(value: Value): number[] {
  if (isHex(value)) return fromHex(value);
  return Array.isArray(value) ? value : [0, 0, 0];
}

/** The part as a slider shows it; a hue as the hex code of a picker. */
export function readPart(value: Value, part: Part): number | string {
  const v = triple(value);
  if (part === "hue") return toHex(hue(v));
  if (part === "level") return level(v);
  if (part === "azimuth") return shorten(Math.atan2(v[0]!, v[2]!) * DEGREES, 6);
  if (part === "elevation")
    return shorten(Math.atan2(v[1]!, Math.hypot(v[0]!, v[2]!)) * DEGREES, 6);
  return v[placeOf(part)] ?? 0;
}

/** The value with one part replaced. */
export function writePart(value: Value, part: Part, next: number | string): Value {
  const v = triple(value);
  if (part === "hue") return fromHex(String(next)).map((c) => shorten(c * level(v), 6));
  const number = Number(next);
  if (part === "level") return hue(v).map((c) => shorten(c * number, 6));
  if (part === "azimuth") return direction(number, Number(readPart(v, "elevation")));
  if (part === "elevation") return direction(Number(readPart(v, "azimuth")), number);
  return v.map((c, axis) => (part === "all" || axis === placeOf(part) ? number : c));
}

function placeOf(part: Part): number {
  return Math.max(0, AXES.indexOf(part), CHANNELS.indexOf(part));
}

/** Unit vector of two angles in degrees: azimuth from z towards x, elevation from the ground up. */
function direction(azimuth: number, elevation: number): number[] {
  // Straight up and down have no azimuth to come back from: stay just beside them.
  const high = Math.min(Math.max(elevation, -89.9), 89.9) / DEGREES;
  const around = azimuth / DEGREES;
  const v = [Math.cos(high) * Math.sin(around), Math.sin(high), Math.cos(high) * Math.cos(around)];
  return v.map((c) => Number(c.toFixed(5)) + 0);
}
