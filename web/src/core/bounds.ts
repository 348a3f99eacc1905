/**
 * Where objects are: bounding spheres for what is in sight, extents for fitting a light's map. Twin
 * of bounds.py.
 */

import * as matrix from "./matrix";
import { type Corners, cornersOf, modelMatrix } from "./placement";
import type { Scene, SceneObject } from "./types";

type Triple = matrix.Triple;
type Span = readonly [low: number, high: number];

/** A shape that fills a box of its own axes, always the same. */
type Solid = Exclude<SceneObject["shape"], "mesh" | "triangle">;

/** Centre and half size of a box. */
type Box = readonly [center: Triple, half: Triple];

/** The box about each shape, in its own axes. */
const BOXES: Readonly<Record<Solid, Box>> = {
  plane: [
    [0, 0, 0],
    [0.5, 0, 0.5],
  ],
  cube: [
    [0, 0, 0],
    [0.5, 0.5, 0.5],
  ],
  sphere: [
    [0, 0, 0],
    [1, 1, 1],
  ],
  cone: [
    [0, 0.5, 0],
    [1, 0.5, 1],
  ],
};
/** Radius of the sphere about the origin of each shape that contains it. */
const RADII = { plane: Math.sqrt(0.5), cube: Math.sqrt(0.75), sphere: 1, cone: 1 };
const SIGNS = [-1, 1] as const;
const HERE: Triple = [0, 0, 0];

function boxOf(scene: Scene, thing: SceneObject): Box {
  if (thing.shape !== "mesh") return BOXES[thing.shape as Solid];
  const { low, high } = scene.meshes[thing.mesh!]!;
  const middle = (axis: 0 | 1 | 2) => (low[axis] + high[axis]) / 2;
  const half = (axis: 0 | 1 | 2) => (high[axis] - low[axis]) / 2;
  return [
    [middle(0), middle(1), middle(2)],
    [half(0), half(1), half(2)],
  ];
}

/** Centre and radius of a sphere that contains the object, in metres. */
export function boundingSphere(
  scene: Scene,
  thing: SceneObject,
): readonly [center: Triple, radius: number] {
  const largest = Math.max(...thing.scale);
  if (thing.shape === "triangle") return sphereAbout(cornersOf(thing, HERE));
  if (thing.shape !== "mesh") return [thing.position, RADII[thing.shape] * largest];
  const [center, half] = boxOf(scene, thing);
  const model = modelMatrix(thing, HERE);
  return [matrix.transform(model, center), Math.sqrt(matrix.dot(half, half)) * largest];
}

function sphereAbout([a, b, c]: Corners): readonly [center: Triple, radius: number] {
  const middle = (i: 0 | 1 | 2) => (a[i] + b[i] + c[i]) / 3;
  const center: Triple = [middle(0), middle(1), middle(2)];
  const offsets = [a, b, c].map((corner) => matrix.subtract(corner, center));
  return [center, Math.max(...offsets.map(lengthOf))];
}

function lengthOf(v: Triple): number {
  return Math.sqrt(matrix.dot(v, v));
}

/** From a point to the middle of an object. */
export function distance(scene: Scene, thing: SceneObject, point: Triple): number {
  return lengthOf(matrix.subtract(boundingSphere(scene, thing)[0], point));
}

/** The centre of an object's box and its three half axes, in the world. */
function armsOf(
  scene: Scene,
  thing: SceneObject,
): readonly [center: Triple, arms: readonly [Triple, Triple, Triple]] {
  const [center, half] = boxOf(scene, thing);
  const model = matrix.compose(thing.position, thing.rotation, thing.scale);
  const arm = (axis: 0 | 1 | 2): Triple => {
    const at = (row: number) => model[4 * axis + row]! * half[axis];
    return [at(0), at(1), at(2)];
  };
  return [matrix.transform(model, center), [arm(0), arm(1), arm(2)]];
}

/** The lowest and the highest coordinate of an object along a unit axis. */
export function extent(scene: Scene, thing: SceneObject, axis: Triple): Span {
  if (thing.shape === "triangle") {
    const along = cornersOf(thing, HERE).map((corner) => matrix.dot(corner, axis));
    return [Math.min(...along), Math.max(...along)];
  }
  const [center, arms] = armsOf(scene, thing);
  const [a, b, c] = [
    matrix.dot(arms[0], axis),
    matrix.dot(arms[1], axis),
    matrix.dot(arms[2], axis),
  ];
  const half =
    thing.shape === "sphere"
      ? Math.sqrt(a * a + b * b + c * c)
      : Math.abs(a) + Math.abs(b) + Math.abs(c);
  const middle = matrix.dot(center, axis);
  return [middle - half, middle + half];
}

/** The extent of several objects together; of none, from -1 to 1. */
export function spanOf(scene: Scene, things: readonly SceneObject[], axis: Triple): Span {
  if (!things.length) return [-1, 1];
  const spans = things.map((thing) => extent(scene, thing, axis));
  return [Math.min(...spans.map((span) => span[0])), Math.max(...spans.map((span) => span[1]))];
}

/** The distance from a point that no part of these objects exceeds; of none, 1. */
export function farthest(scene: Scene, things: readonly SceneObject[], point: Triple): number {
  return things.length ? Math.max(...things.map((thing) => reach(scene, thing, point))) : 1;
}

function reach(scene: Scene, thing: SceneObject, point: Triple): number {
  if (thing.shape === "sphere") return distance(scene, thing, point) + Math.max(...thing.scale);
  if (thing.shape === "triangle") return Math.max(...cornersOf(thing, point).map(lengthOf));
  const [center, [a, b, c]] = armsOf(scene, thing);
  const offset = matrix.subtract(center, point);
  const corner = (x: number, y: number, z: number): number => {
    const at = (i: 0 | 1 | 2) => offset[i] + x * a[i] + y * b[i] + z * c[i];
    return lengthOf([at(0), at(1), at(2)]);
  };
  const ends = SIGNS.flatMap((x) => SIGNS.flatMap((y) => SIGNS.map((z) => corner(x, y, z))));
  return Math.max(...ends);
}
