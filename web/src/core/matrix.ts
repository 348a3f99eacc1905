/** 4x4 matrices as flat column-major arrays of float64. Twin of matrix.py. */

import { glMatrix, mat4, vec3 } from "gl-matrix";

glMatrix.setMatrixArrayType(Array);

export type Vector = readonly number[];
export type Triple = readonly [number, number, number];

// Sines are rounded to steps of 1/GRID: right angles are exact, and terms that cancel leave no
// noise, in which maths libraries differ.
const GRID = 2 ** 32;

/** The product a b. */
export function multiply(a: Vector, b: Vector): Vector {
  return Array.from(mat4.multiply(mat4.create(), a as number[], b as number[]));
}

/** The unit vector along v. */
export function normalize(v: Triple): Triple {
  return made(vec3.normalize(vec3.create(), v));
}

/** a - b. */
export function subtract(a: Triple, b: Triple): Triple {
  return made(vec3.subtract(vec3.create(), a, b));
}

/** The vector product. */
export function cross(a: Triple, b: Triple): Triple {
  return made(vec3.cross(vec3.create(), a, b));
}

/** The scalar product. */
export function dot(a: Triple, b: Triple): number {
  return vec3.dot(a, b);
}

function made(v: vec3): Triple {
  return v as unknown as Triple; // an array, by setMatrixArrayType
}

/** Cosine and sine of an angle in degrees. */
export function cosSin(degrees: number): readonly [number, number] {
  const angle = (degrees * Math.PI) / 180;
  return [onGrid(Math.cos(angle)), onGrid(Math.sin(angle))];
}

function onGrid(value: number): number {
  return Math.floor(value * GRID + 0.5) / GRID;
}

/** 3x3 rotation, column-major: about x first, then y, then z, angles in degrees. */
export function rotation(degrees: Vector): Vector {
  const [cx, sx] = cosSin(degrees[0]!);
  const [cy, sy] = cosSin(degrees[1]!);
  const [cz, sz] = cosSin(degrees[2]!);
  return [
    ...[cy * cz, cy * sz, -sy],
    ...[sx * sy * cz - cx * sz, sx * sy * sz + cx * cz, sx * cy],
    ...[cx * sy * cz + sx * sz, cx * sy * sz - sx * cz, cx * cy],
  ];
}

/** Model matrix: scale, then rotate, then move. */
export function compose(position: Vector, degrees: Vector, scale: Vector): Vector {
  const r = rotation(degrees);
  const column = (i: number) => [0, 1, 2].map((j) => r[3 * i + j]! * scale[i]!);
  return [...column(0), 0, ...column(1), 0, ...column(2), 0, ...position, 1];
}

/** 3x3 inverse transpose of `compose`, column-major: rotation times 1/scale. */
export function normalMatrix(degrees: Vector, scale: Vector): Vector {
  return rotation(degrees).map((value, index) => value / scale[Math.floor(index / 3)]!);
}

/**
 * View matrix of an eye at the origin that looks along `look`: -z forward, +y up.
 *
 * Not mat4.lookAt, which takes a target nearer than 1e-6 m for none.
 */
export function lookAt(look: Triple, up: Triple): Vector {
  const z = normalize([-look[0], -look[1], -look[2]]);
  const x = normalize(cross(up, z));
  const y = cross(z, x);
  return [
    ...[x[0], y[0], z[0], 0],
    ...[x[1], y[1], z[1], 0],
    ...[x[2], y[2], z[2], 0],
    ...[0, 0, 0, 1],
  ];
}

/** OpenGL projection of a square view; `tangent` is that of half its angle. */
export function squarePerspective(tangent: number, near: number, far: number): Vector {
  const inverse = 1 / (near - far);
  const [depth, shift] = [(far + near) * inverse, 2 * far * near * inverse];
  const f = 1 / tangent;
  return [...[f, 0, 0, 0], ...[0, f, 0, 0], ...[0, 0, depth, -1], ...[0, 0, shift, 0]];
}

/** OpenGL projection of a view `height` high, without perspective. */
export function orthographic(height: number, aspect: number, near: number, far: number): Vector {
  const inverse = 1 / (near - far);
  const [depth, shift] = [2 * inverse, (far + near) * inverse];
  const [wide, high] = [2 / (height * aspect), 2 / height];
  return [...[wide, 0, 0, 0], ...[0, high, 0, 0], ...[0, 0, depth, 0], ...[0, 0, shift, 1]];
}

/** The point moved by an affine matrix. */
export function transform(m: Vector, [x, y, z]: Triple): Triple {
  return [
    m[0]! * x + m[4]! * y + m[8]! * z + m[12]!,
    m[1]! * x + m[5]! * y + m[9]! * z + m[13]!,
    m[2]! * x + m[6]! * y + m[10]! * z + m[14]!,
  ];
}

/** The matrix that moves by an offset. */
export function translation(offset: Triple): Vector {
  return [...[1, 0, 0, 0], ...[0, 1, 0, 0], ...[0, 0, 1, 0], ...offset, 1];
}
