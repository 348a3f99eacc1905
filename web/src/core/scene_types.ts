/** How the values of a scene may be written. Twin of scene_types.py. */

import { shown } from "./errors";

const HEX = /^#?([0-9a-fA-F]{6})$/;
const NUMBER = /^\s*[+-]?(?:(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|(inf(?:inity)?|nan))\s*$/i;

/** A problem at a path below the scene; `given` where the message does not show the value itself. */
export class Problem extends Error {
  constructor(
    readonly path: string,
    message: string,
    given: readonly [unknown] | null = null,
  ) {
    super(given ? `${message} (given ${shown(given[0])})` : message);
  }
}

/** The number that `text` is in Python's notation; NaN where it is none. */
export function parseNumber(text: string): number {
  const plain = text.replace(/(?<=\d)_(?=\d)/g, "");
  const match = NUMBER.exec(plain);
  if (!match) return Number.NaN;
  if (!match[1]) return Number(plain);
  if (match[1].toLowerCase() === "nan") return Number.NaN;
  return plain.includes("-") ? -Infinity : Infinity;
}

/** Whether `text` is a number in Python's notation. */
export function isNumber(text: string): boolean {
  return NUMBER.test(text.replace(/(?<=\d)_(?=\d)/g, ""));
}

/** A linear RGB triple from one, or from an sRGB `#rrggbb` (also bare, or `r,g,b`). */
export function color(value: unknown): unknown {
  if (typeof value !== "string") return value;
  const code = HEX.exec(value.trim())?.[1];
  if (!code) return numbers(value, "write #rrggbb (sRGB) or r,g,b (linear)");
  return [0, 2, 4].map((at) => decodeSrgb(Number.parseInt(code.slice(at, at + 2), 16) / 255));
}

/** IEC 61966-2-1. */
function decodeSrgb(code: number): number {
  return code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
}

/** Three numbers or two, or their text. */
export function numbers(value: unknown, allowed = "write x,y,z", count = 3): unknown {
  if (typeof value !== "string") return value;
  const parts = value.split(",");
  if (parts.length !== count || !parts.every(isNumber)) {
    throw new Problem("", `${shown(value)} does not parse: ${allowed}`);
  }
  return parts.map(parseNumber);
}

/** Two numbers, or their text. */
export function pair(value: unknown): unknown {
  return numbers(value, "write x,y", 2);
}

/** Scale factors along x, y and z, or along x and y; a lone number stands for all. */
export function factors(value: unknown, count: number): unknown {
  const alone = typeof value === "number" || (typeof value === "string" && !value.includes(","));
  if (alone) return Array(count).fill(value);
  return count === 2 ? pair(value) : numbers(value);
}
