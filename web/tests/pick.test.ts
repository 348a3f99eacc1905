import { expect, test } from "vitest";
import type { Mesh } from "../src/core/mesh";
import type { Material, MeshAsset, Scene, SceneObject } from "../src/core/types";
import { pick } from "../src/pick";
import { isBroad, middleOf } from "../src/solid";
import { scene } from "./bench";

/** A mesh of positions and triangles. */
function mesh(positions: number[], indices: number[]): Mesh {
  const none = new Float32Array();
  return {
    ...{ positions: new Float32Array(positions), indices: new Uint32Array(indices) },
    ...{ normals: none, uvs: none, tangents: none, colors: null, uvs1: null },
  };
}

// A triangle across z = 0 that faces +z, and one behind it, smaller, at z = -1.
const TWO = mesh([-1, -1, 0, 1, -1, 0, -1, 1, 0, 0, 0, -1, 1, 0, -1, 0, 1, -1], [0, 1, 2, 3, 4, 5]);
const BOX: MeshAsset = {
  ...{ mesh: "mesh-0", low: [-1, -1, -1], high: [1, 1, 0] },
  ...{ colors: false, uv1: false },
};

function world(surface: Partial<Material> = {}, placed: Partial<SceneObject> = {}): Scene {
  const thing = { ...scene.objects.ball!, shape: "mesh", mesh: "part", ...placed } as SceneObject;
  const wall = { ...scene.materials.wall!, ...surface } as Material;
  return { ...scene, meshes: { part: BOX }, objects: { thing }, materials: { wall } };
}

function along(described: Scene, from: number[], to: number[], found: Mesh | undefined = TWO) {
  return pick(described, from, to, () => found)?.distance ?? null;
}

const [AHEAD, BACK] = [
  [0, 0, -1],
  [0, 0, 1],
];

test("a mesh is met by its triangles, not by its box", () => {
  expect(along(world(), [-0.5, -0.5, 5], AHEAD)).toBeCloseTo(5, 9);
  expect(along(world(), [0.3, 0.3, 5], AHEAD)).toBeCloseTo(6, 9); // past the first, to the second
  expect(along(world(), [0.9, 0.9, 5], AHEAD)).toBeNull();
  expect(along(world(), [0.85, -0.9, 5], [0, 0.001, -1])).toBeCloseTo(5, 6);
});

test("a back is met where both sides are drawn", () => {
  expect(along(world(), [-0.5, -0.5, -5], BACK)).toBeNull();
  expect(along(world({ double_sided: true }), [-0.5, -0.5, -5], BACK)).toBeCloseTo(5, 9);
});

test("a placed mesh is met where it stands", () => {
  const placed = world({}, { position: [3, 0, 0], rotation: [0, 90, 0], scale: [2, 2, 4] });
  // Its front looks along +x now; the second triangle stands 4 m behind the first.
  expect(along(placed, [10, -1, 1], [-1, 0, 0])).toBeCloseTo(7, 6);
  expect(along(placed, [10, 0.5, -0.5], [-1, 0, 0])).toBeCloseTo(11, 6);
  expect(along(placed, [10, 0, 0], [1, 0, 0])).toBeNull();
});

test("what lets all light through is not in the way", () => {
  const blend = (opacity: number) => world({ alpha_mode: "blend", opacity });
  expect(along(blend(0.2), [-0.5, -0.5, 5], AHEAD)).toBeCloseTo(5, 9);
  expect(along(blend(0), [-0.5, -0.5, 5], AHEAD)).toBeNull();
  expect(along(world({ alpha_mode: "mask", opacity: 0.3 }), [-0.5, -0.5, 5], AHEAD)).toBeNull();
});

test("a mesh that is not there yet is met by its box, unless from inside", () => {
  const none = (from: number[]) => pick(world(), from, AHEAD, () => undefined)?.distance ?? null;
  expect(none([0.9, 0.9, 5])).toBeCloseTo(5, 9);
  expect(none([0.9, 0.9, -0.5])).toBeNull();
  expect(none([0.9, 1.1, 5])).toBeNull();
});

test("a hundred thousand triangles are searched at once", () => {
  const side = 224; // squares, of two triangles
  const positions = Array.from({ length: (side + 1) ** 2 }, (_, i) => [
    (2 * (i % (side + 1))) / side - 1,
    (2 * Math.floor(i / (side + 1))) / side - 1,
    0,
  ]).flat();
  const indices = Array.from({ length: side * side }, (_, i) => {
    const corner = Math.floor(i / side) * (side + 1) + (i % side);
    const above = corner + side + 1;
    return [corner, corner + 1, above, corner + 1, above + 1, above];
  }).flat();
  const grid = mesh(positions, indices);
  const times = Array.from({ length: 5 }, () => {
    const start = performance.now();
    expect(along(world(), [0.123, 0.456, 5], AHEAD, grid)).toBeCloseTo(5, 9);
    return performance.now() - start;
  });
  expect(Math.min(...times)).toBeLessThan(30);
});

test("a camera goes to the middle of a solid, to the point of a surface or of a room", () => {
  const placed = world({}, { position: [3, 0, 0], scale: [2, 2, 4] });
  const { thing } = placed.objects;
  expect(middleOf(placed, thing!).middle).toEqual([3, 0, -2]);
  expect(isBroad(placed, thing!)).toBe(false);
  const within = { ...placed, camera: { ...placed.camera, eye: [3, 0, -1] as never } };
  expect(isBroad(within, thing!)).toBe(true);
  const thin = world({}, { scale: [1, 1, 0.01] });
  expect(isBroad(thin, thin.objects.thing!)).toBe(true);
});
