import { expect, test } from "vitest";
import { extent, farthest, spanOf } from "../src/core/bounds";
import { missingFor } from "../src/core/context";
import type { Camera, Plan, PointLight, Scene, SceneObject } from "../src/core/types";
import { casters, inSight, lightCamera, lightMap } from "../src/core/viewpoint";
import { scene } from "./bench";

const lamp = scene.lights.lamp!;
const bulb: PointLight = {
  ...{ type: "point", color: [1, 1, 1], intensity: 1, casts: true, far: null },
  ...{ unit: "candela", position: [0, 3, 0] },
};
const empty: Scene = { ...scene, objects: {} };
const ball = scene.objects.ball!;

test("a scene of nothing still has extents", () => {
  expect(spanOf(empty, [], [1, 0, 0])).toEqual([-1, 1]);
  expect(farthest(empty, [], [0, 0, 0])).toBe(1);
  expect(lightMap(empty, bulb, 64).far).toBeCloseTo(1.01, 12);
});

test("a mesh's box counts, turned and scaled", () => {
  const key = `mesh-${"0".repeat(32)}`;
  const meshes = {
    beam: { mesh: key, low: [0, 0, 0], high: [4, 2, 1], colors: false, uv1: false },
  } as Scene["meshes"];
  const thing: SceneObject = { ...ball, shape: "mesh", mesh: "beam", rotation: [0, 0, 90] };
  const built = { ...scene, meshes, objects: { thing } };
  expect(extent(built, thing, [0, 1, 0])).toEqual([0, 4]);
  expect(extent(built, { ...thing, scale: [2, 1, 1] }, [0, 1, 0])).toEqual([0, 8]);
  expect(farthest(built, [thing], [0, 0, 0])).toBeCloseTo(Math.hypot(4, 2, 1), 12);
});

test("what is blended casts no shadow", () => {
  const wall = { ...scene.materials.wall!, alpha_mode: "blend" as const };
  expect(casters(scene)).toEqual([ball]);
  expect(casters({ ...scene, materials: { wall } })).toEqual([]);
});

test("a point light has the six tiles of a cube, a wide spot too, others one", () => {
  const tiles = (map: ReturnType<typeof lightMap>) => map.faces.map((face) => face.tile?.join());
  const cube = ["0,0,8", "8,0,8", "16,0,8", "0,8,8", "8,8,8", "16,8,8"];
  expect(tiles(lightMap(scene, bulb, 8))).toEqual(cube);
  expect(tiles(lightMap(scene, { ...lamp, outer: 75.5 } as typeof lamp, 8))).toEqual(cube);
  expect(tiles(lightMap(scene, lamp, 8))).toEqual(["0,0,8"]);
});

test("a face of a cube leaves out what it cannot show", () => {
  const faces = lightMap(scene, bulb, 8).faces;
  const seen = faces.map((face) => inSight(scene, face, ball));
  expect(seen).toEqual([false, false, false, true, false, false]); // only below
  expect(inSight(scene, faces[2]!, { ...ball, position: [0, 2.5, 0] })).toBe(true);
});

test("a point light looks where the camera looks, straight down from there", () => {
  expect(lightCamera(scene, bulb)).toMatchObject({ eye: [0, 3, 0], target: [0, 2, 0], fov: 90 });
  const camera: Camera = { ...scene.camera, target: [0, 3, 0] };
  expect(lightCamera({ ...scene, camera }, bulb).target).toEqual([0, 2, 0]);
});

test("blending into float32 is asked for where a plan needs it", () => {
  const lacking = { getExtension: () => null } as unknown as WebGL2RenderingContext;
  const plan = (format: string, blend: string | null) =>
    ({
      targets: { t: { format } },
      passes: [{ target: "t", batches: [{ blend }] }],
    }) as unknown as Plan;
  expect(missingFor(lacking, plan("rgba32f", "over"))).toContain("EXT_float_blend is missing");
  expect(missingFor(lacking, plan("rgba32f", null))).toBeNull();
  expect(missingFor(lacking, plan("rgba8", "over"))).toBeNull();
});
