/** Where an object's own coordinates lie in the world, as matrices about a point. Twin of placement.py. */

import * as matrix from "./matrix";
import type { SceneObject } from "./types";

type Triple = matrix.Triple;
export type Corners = readonly [Triple, Triple, Triple];

const HERE: Triple = [0, 0, 0];

/** The three corners of a triangle in the world about `origin`. */
export function cornersOf({ corners, ...thing }: SceneObject, origin: Triple): Corners {
  const position = matrix.subtract(thing.position, origin);
  const whole = matrix.compose(position, thing.rotation, thing.scale);
  const [a, b, c] = corners!;
  return [matrix.transform(whole, a), matrix.transform(whole, b), matrix.transform(whole, c)];
}

/** A corner, the two edges from it, and the unit normal: none where there is no area. */
function triangle(thing: SceneObject, origin: Triple): readonly [...Corners, normal: Triple] {
  const [a, b, c] = cornersOf(thing, origin);
  const [first, second] = [matrix.subtract(b, a), matrix.subtract(c, a)];
  const across = matrix.cross(first, second);
  const length = Math.sqrt(matrix.dot(across, across));
  const [x, y, z] = across;
  return [a, first, second, length > 0 ? [x / length, y / length, z / length] : HERE];
}

/** 4x4: from the object's mesh to the world about `origin`. */
export function modelMatrix(thing: SceneObject, origin: Triple): matrix.Vector {
  if (thing.shape === "triangle") {
    const [a, first, second, normal] = triangle(thing, origin);
    return [...first, 0, ...second, 0, ...normal, 0, ...a, 1];
  }
  const position = matrix.subtract(thing.position, origin);
  return matrix.compose(position, thing.rotation, thing.scale);
}

/** 3x3: from normals of the object's mesh to ones in the world, not unit. */
export function normalMatrix(thing: SceneObject): matrix.Vector {
  if (thing.shape === "triangle") return [...HERE, ...HERE, ...triangle(thing, HERE)[3]];
  return matrix.normalMatrix(thing.rotation, thing.scale);
}

/** 4x4: from the world about `origin` to the object's own coordinates. */
export function inverseMatrix(thing: SceneObject, origin: Triple): matrix.Vector {
  const position = matrix.subtract(thing.position, origin);
  const r = matrix.rotation(thing.rotation);
  const row = (i: 0 | 1 | 2): Triple => {
    const at = (j: number) => r[3 * i + j]! / thing.scale[i];
    return [at(0), at(1), at(2)];
  };
  const rows = [row(0), row(1), row(2)];
  const column = (j: 0 | 1 | 2) => [...rows.map((own) => own[j]), 0];
  const back = rows.map((own) => -matrix.dot(own, position));
  return [...column(0), ...column(1), ...column(2), ...back, 1];
}
