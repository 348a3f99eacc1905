// Which object a ray meets first, by the exact shapes and by the triangles of meshes.
import { mat4, vec3 } from "gl-matrix";
import type { Mesh } from "./core/mesh";
import { modelMatrix } from "./core/placement";
import type { Material, MeshAsset, Scene, SceneObject } from "./core/types";
import { meetBox, meetMesh } from "./triangles";

export interface Hit {
  name: string;
  object: SceneObject;
  point: number[];
  distance: number;
}

type Vector = readonly number[];

/** The mesh of a key; undefined while it is not there. */
export type Meshes = (key: string) => Mesh | undefined;

// A ray meets so many triangles within about 30 ms; a larger mesh is met by its box.
const MOST_TRIANGLES = 2e6;

/** The first visible object along a ray from `eye`; null where there is none. */
export function pick(scene: Scene, eye: Vector, direction: Vector, meshes: Meshes): Hit | null {
  let best: Hit | null = null;
  for (const [name, object] of Object.entries(scene.objects)) {
    const distance = meet(scene, object, eye, direction, meshes);
    if (distance !== null && distance < (best?.distance ?? Number.POSITIVE_INFINITY)) {
      const point = eye.map((c, axis) => c + distance * (direction[axis] ?? 0));
      best = { name, object, point, distance };
    }
  }
  return best;
}

/** Where a blended surface lets everything through there is nothing to point at. */
function isClear({ alpha_mode, opacity, alpha_cutoff }: Material): boolean {
  if (alpha_mode === "blend") return opacity === 0;
  return alpha_mode === "mask" && opacity < alpha_cutoff;
}

function meet(
  scene: Scene,
  object: SceneObject,
  eye: Vector,
  direction: Vector,
  meshes: Meshes,
): number | null {
  const material = scene.materials[object.material];
  const inverse = mat4.invert(mat4.create(), matrix(object));
  if (!inverse || !material || isClear(material)) return null;
  const from = vec3.transformMat4(vec3.create(), eye as vec3, inverse);
  const to = vec3.add(vec3.create(), eye as vec3, direction as vec3);
  vec3.transformMat4(to, to, inverse);
  const along = vec3.subtract(vec3.create(), to, from);
  const asset = scene.meshes[object.mesh ?? ""];
  if (asset) return ofMesh(asset, meshes(asset.mesh), [...from], [...along], material.double_sided);
  return first(object.shape, [...from], [...along], material.double_sided);
}

function ofMesh(
  asset: MeshAsset,
  mesh: Mesh | undefined,
  from: Vector,
  along: Vector,
  bothSides: boolean,
): number | null {
  const enters = meetBox(asset, from, along);
  if (enters === null) return null;
  if (!mesh || mesh.indices.length > 3 * MOST_TRIANGLES) return enters || null;
  return meetMesh(mesh, from, along, bothSides);
}

/** From an object's own space to the world's. */
export function matrix(object: SceneObject): mat4 {
  if (object.shape === "triangle") return [...modelMatrix(object, [0, 0, 0])] as mat4;
  const [x = 0, y = 0, z = 0] = object.rotation.map((angle) => (angle * Math.PI) / 180);
  const m = mat4.fromTranslation(mat4.create(), object.position as vec3);
  mat4.rotateZ(m, m, z);
  mat4.rotateY(m, m, y);
  mat4.rotateX(m, m, x);
  return mat4.scale(m, m, object.scale as vec3);
}

/** The smallest positive parameter of `from + t along` on the drawn sides of a unit shape. */
function first(
  shape: SceneObject["shape"],
  from: Vector,
  along: Vector,
  bothSides: boolean,
): number | null {
  const found = crossings(shape, from, along).filter(([t, normal]) => {
    const facing = normal.reduce((sum, c, axis) => sum + c * (along[axis] ?? 0), 0) < 0;
    return t > 1e-6 && (facing || bothSides);
  });
  return found.length ? Math.min(...found.map(([t]) => t)) : null;
}

type Crossing = [t: number, normal: Vector];

function crossings(shape: SceneObject["shape"], from: Vector, along: Vector): Crossing[] {
  const at = (t: number) => from.map((c, axis) => c + t * (along[axis] ?? 0));
  if (shape === "sphere") {
    return roots(from, along, [1, 1, 1], 1).map((t) => [t, at(t)]);
  }
  if (shape === "cone") {
    const shifted = [from[0] ?? 0, (from[1] ?? 0) - 1, from[2] ?? 0];
    const side = roots(shifted, along, [1, -1, 1], 0)
      .map((t): [number, number[]] => [t, at(t)])
      .filter(([, [, y = -1]]) => y >= 0 && y <= 1)
      .map(([t, [x = 0, y = 0, z = 0]]): Crossing => [t, [x, 1 - y, z]]);
    const base = flat(from, along, 1, 0, -1).filter(([t]) => {
      const [x = 0, , z = 0] = at(t);
      return x * x + z * z <= 1;
    });
    return [...side, ...base];
  }
  const inside = (t: number, skip: number) =>
    at(t).every((c, axis) => axis === skip || Math.abs(c) <= 0.5);
  if (shape === "triangle") {
    const beside = ([x = 0, y = 0]: number[]) => x >= 0 && y >= 0 && x + y <= 1;
    return flat(from, along, 2, 0, 1).filter(([t]) => beside(at(t)));
  }
  if (shape === "plane") return flat(from, along, 1, 0, 1).filter(([t]) => inside(t, 1));
  return [0, 1, 2].flatMap((axis) =>
    [-1, 1].flatMap((sign) =>
      flat(from, along, axis, sign * 0.5, sign).filter(([t]) => inside(t, axis)),
    ),
  );
}

/** Where the ray meets the plane across an axis at a height. */
function flat(from: Vector, along: Vector, axis: number, at: number, sign: number): Crossing[] {
  const step = along[axis] ?? 0;
  if (step === 0) return [];
  const normal = [0, 0, 0];
  normal[axis] = sign;
  return [[(at - (from[axis] ?? 0)) / step, normal]];
}

/** Solutions t of sum w (from + t along)^2 = radius2. */
function roots(from: Vector, along: Vector, w: Vector, radius2: number): number[] {
  const sum = (f: (axis: number) => number) =>
    [0, 1, 2].reduce((total, axis) => total + (w[axis] ?? 0) * f(axis), 0);
  const a = sum((i) => (along[i] ?? 0) ** 2);
  const b = sum((i) => (along[i] ?? 0) * (from[i] ?? 0));
  const c = sum((i) => (from[i] ?? 0) ** 2) - radius2;
  const discriminant = b * b - a * c;
  if (a === 0 || discriminant < 0) return [];
  const root = Math.sqrt(discriminant);
  return [(-b - root) / a, (-b + root) / a];
}
