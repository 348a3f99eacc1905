/**
 * A tree of spheres about objects, so that a ray looks closer only at those in its way. Twin of
 * sphere_tree.py, which says what a node is.
 */

import { SceneError } from "./errors";
import type { Vector } from "./matrix";

/** Centre and radius: four numbers. */
export type Sphere = Vector;

/** Bits of a number, as in shaders/stages/listed.glsl. */
const NUMBER_BITS = 17;
const MOST_OBJECTS = 2 ** (NUMBER_BITS - 1);
/** What a sphere is larger by than what is in it, for what float32 loses of both. */
export const ROOM = 1 + 1e-5;
/** Least radius: its float is a normal one, whose bits every GL keeps. */
const SMALLEST = 1e-30;
const AXES = [0, 1, 2];

const float = new Float32Array(1);
const bits = new Uint32Array(float.buffer);

/**
 * The texels of all nodes, twice as many as objects less one. Throws SceneError.
 *
 * Spheres are about the eye, in float32. A node comes before all below it, and what begins nearer
 * to the eye before the other: a ray goes on to the next node, or passes over all below.
 */
export function sphereTree(spheres: readonly Sphere[]): readonly number[] {
  if (spheres.length > MOST_OBJECTS) {
    const most = `rays find ${MOST_OBJECTS} objects at most`;
    throw new SceneError(`${most}: there are ${spheres.length}`);
  }
  return nodesOf(spheres, [...spheres.keys()]);
}

/** The node about spheres by their numbers, and all below it. */
function nodesOf(spheres: readonly Sphere[], members: readonly number[]): readonly number[] {
  if (members.length === 1) {
    const [x, y, z, radius] = spheres[members[0]!]!;
    return [x!, y!, z!, -withNumber(radius!, members[0]!)];
  }
  const [x, y, z, radius] = around(members.map((i) => spheres[i]!));
  const [first, second] = partsOf(spheres, members, radius).map((part) => nodesOf(spheres, part));
  const below =
    begins(second!) < begins(first!) ? [...second!, ...first!] : [...first!, ...second!];
  return [x, y, z, withNumber(radius, 1 + below.length / 4), ...below];
}

/**
 * Those above half of a radius, and the others: a floor is not among what stands on it. Where there
 * are not both, halves along the widest axis.
 */
function partsOf(
  spheres: readonly Sphere[],
  members: readonly number[],
  radius: number,
): readonly (readonly number[])[] {
  const large = members.filter((i) => spheres[i]![3]! > radius / 2);
  if (large.length > 0 && large.length < members.length) {
    return [large, members.filter((i) => spheres[i]![3]! <= radius / 2)];
  }
  const widths = AXES.map((axis) => {
    const [low, high] = ends(members, (i) => spheres[i]![axis]!);
    return high - low;
  });
  const widest = widths.indexOf(Math.max(...widths));
  const along = [...members].sort((a, b) => spheres[a]![widest]! - spheres[b]![widest]!);
  const half = Math.ceil(along.length / 2);
  return [along.slice(0, half), along.slice(half)];
}

/** A sphere about spheres, its centre in float32: from the middle of their box. */
function around(spheres: readonly Sphere[]): readonly [number, number, number, number] {
  const middle = (axis: number) => {
    const [low] = ends(spheres, (sphere) => sphere[axis]! - sphere[3]!);
    const [, high] = ends(spheres, (sphere) => sphere[axis]! + sphere[3]!);
    return Math.fround((low + high) / 2) + 0;
  };
  const [x, y, z] = [middle(0), middle(1), middle(2)];
  const [, radius] = ends(spheres, (s) => length(s[0]! - x, s[1]! - y, s[2]! - z) + s[3]!);
  return [x, y, z, ROOM * radius];
}

/** The least and the greatest value of items. */
function ends<T>(items: readonly T[], of: (item: T) => number): readonly [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const item of items) {
    const value = of(item);
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return [low, high];
}

/** How far from the eye the sphere of the first node begins. */
function begins([x, y, z, w]: readonly number[]): number {
  return length(x!, y!, z!) - Math.abs(w!);
}

function length(x: number, y: number, z: number): number {
  return Math.sqrt(x * x + y * y + z * z);
}

/** A radius that is no less, with a number in its last bits. */
function withNumber(radius: number, number: number): number {
  const mask = (1 << NUMBER_BITS) - 1;
  float[0] = Math.max(radius, SMALLEST);
  bits[0] = ((bits[0]! + mask) & ~mask) | number;
  return float[0];
}
