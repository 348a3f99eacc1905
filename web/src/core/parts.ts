/**
 * Where flat parts lie in the picture: 3x3 matrices, flat and column-major, in float64. Twin of
 * parts.py.
 */

import type { Record_ } from "./assemble";
import { cosSin, type Vector } from "./matrix";
import type { Part, Scene } from "./types";
import { float32, type Values } from "./values";

type Parts = Readonly<Record<string, Part>>;

/** Moves by (x, y). */
function translation([x, y]: readonly [number, number]): Vector {
  return [1, 0, 0, 0, 1, 0, x, y, 1];
}

/** Stretches along x and y. */
function scaling([x, y]: readonly [number, number]): Vector {
  return [x, 0, 0, 0, y, 0, 0, 0, 1];
}

/** Turns about (0, 0), from x towards y. */
function rotation(degrees: number): Vector {
  const [c, s] = cosSin(degrees);
  return [c, s, 0, -s, c, 0, 0, 0, 1];
}

/** The product a b, which does first what b does. */
function multiply(a: Vector, b: Vector): Vector {
  return [0, 3, 6].flatMap((column) => {
    const [b0, b1, b2] = [b[column]!, b[column + 1]!, b[column + 2]!];
    return [0, 1, 2].map((r) => b0 * a[r]! + b1 * a[3 + r]! + b2 * a[6 + r]!);
  });
}

/** From each part's own coordinates to the picture's: that of its frame, times its scaling. */
export function partMatrices(parts: Parts): readonly Vector[] {
  const frames = new Map<string, Vector>();
  const frameOf = (name: string): Vector => {
    const known = frames.get(name);
    if (known) return known;
    const { parent, position, rotation: degrees } = parts[name]!;
    const own = multiply(translation(position), rotation(degrees));
    const made = parent === null ? own : multiply(frameOf(parent), own);
    frames.set(name, made);
    return made;
  };
  return Object.entries(parts).map(([name, { scale }]) => multiply(frameOf(name), scaling(scale)));
}

/** The records of PARTS: which part, of which shape. */
export function partRecords({ parts }: Scene): readonly Record_[] {
  return Object.values(parts).map(({ shape }, index) => ({
    ...{ index: `${index}`, shape, square: `${Number(shape === "square")}` },
  }));
}

/** Uniforms of every part. */
export function partValues({ parts }: Scene): Values {
  const found: Record<string, number[]> = {};
  const matrices = partMatrices(parts);
  for (const [index, { color, width }] of Object.values(parts).entries()) {
    found[`u_part${index}_matrix`] = float32(matrices[index]!);
    found[`u_part${index}_color`] = float32(color);
    found[`u_part${index}_width`] = float32([width]);
  }
  return found;
}
