import { expect, test } from "vitest";
import type { Scene, SceneObject } from "../src/core/types";
import { extent } from "../src/extent";
import { mirrored, ORBIT, walking } from "../src/modes";
import {
  aimed,
  between,
  distance,
  focus,
  orbit,
  type Pose,
  pan,
  ray,
  rounded,
  span,
  zoom,
} from "../src/orbit";
import { pick } from "../src/pick";
import { isBroad, middleOf } from "../src/solid";
import { scene } from "./bench";

const pose: Pose = { eye: [0, 0, 5], target: [0, 0, 0], up: [0, 1, 0], fov: 90 };
const close = (found: readonly number[], wanted: number[]) => {
  for (const [axis, value] of wanted.entries()) expect(found[axis]).toBeCloseTo(value, 2);
};

test("orbiting keeps the distance and stops short of the poles", () => {
  close(orbit(pose, Math.PI / 2, 0).eye, [-5, 0, 0]);
  close(orbit(pose, 0, Math.PI / 6).eye, [0, 2.5, 4.3301]);
  const top = orbit(pose, 0, 10);
  expect(distance(top)).toBeCloseTo(5, 3);
  expect(top.eye[1]).toBeLessThan(5);
  expect(top.eye[1]).toBeGreaterThan(4.99);
  let many = pose;
  for (let step = 0; step < 360; step += 1) many = orbit(many, Math.PI / 180, 0);
  close(many.eye, [0, 0, 5]);
});

test("any axis may be up", () => {
  const other: Pose = { ...pose, eye: [0, 5, 0], up: [0, 0, 1] };
  close(orbit(other, 0, Math.PI / 2 - 0.02).eye, [0, 0.1, 5]);
});

test("zoom is towards the target and never through it", () => {
  close(zoom(pose, 0.5).eye, [0, 0, 2.5]);
  expect(distance(zoom(pose, 1e-9))).toBeCloseTo(1e-3, 6);
});

test("panning moves eye and target by parts of the picture's height", () => {
  const moved = pan(pose, 0.1, 0.2);
  close(moved.eye, [1, 2, 5]);
  close(moved.target, [1, 2, 0]);
});

test("focus looks from the same side; a flight ends exactly", () => {
  const there = focus(pose, [0, 0, 1], 4);
  close(there.eye, [0, 0, 3]);
  close(between(pose, there, 0.5).eye, [0, 0, 4]);
  expect(between(pose, there, 1)).toBe(there);
});

test("numbers stay short enough for a link", () => {
  for (const value of rounded(orbit(pose, 0.1234, 0.4321)).eye) {
    expect(`${value}`.length).toBeLessThanOrEqual(7);
  }
});

const flat: Pose = { ...pose, projection: "orthographic", height: 4 };

test("without perspective zoom scales the height and the eye stays", () => {
  expect(zoom(flat, 0.5)).toEqual({ ...flat, height: 2 });
  expect(zoom(flat, 1e-9).height).toBe(1e-3);
  expect(orbit(flat, 0.3, 0.2).height).toBe(4);
  close(pan(flat, 0.1, 0.25).eye, [0.4, 1, 5]);
  expect(focus(flat, [1, 0, 0], 2)).toEqual({
    ...flat,
    eye: [1, 0, 5],
    target: [1, 0, 0],
    height: 2,
  });
  expect(between(flat, { ...flat, height: 2 }, 0.5).height).toBe(3);
  expect(rounded(zoom(flat, 1 / 3)).height).toBe(1.33333);
});

test("without perspective rays are parallel", () => {
  const { from, along } = ray({ ...flat, aspect: 2 }, 0.5, -1);
  close(from, [2, -2, 5]);
  close(along, [0, 0, -1]);
});

test("an orbit may turn about another point of the middle axis", () => {
  const other = aimed(pose, 2);
  close(other.target, [0, 0, 3]);
  expect(other.eye).toEqual(pose.eye);
  expect(span(other)).toBeCloseTo(4, 9);
});

function object(shape: SceneObject["shape"], given: Partial<SceneObject> = {}): SceneObject {
  return { ...scene.objects.ball!, shape, ...given };
}

function hit(objects: Record<string, SceneObject>, x = 0, y = 0) {
  const { from, along } = ray(pose, x, y);
  return pick({ ...scene, objects } as Scene, from, along, () => undefined);
}

test.each([
  ["sphere", 4],
  ["cube", 4.5],
] as const)("a ray meets a %s at its front", (shape, far) => {
  expect(hit({ thing: object(shape) })?.distance).toBeCloseTo(far, 5);
});

test("a plane is met from its front only", () => {
  const wall = object("plane", { rotation: [90, 0, 0] });
  expect(hit({ wall })?.distance).toBeCloseTo(5, 5);
  expect(hit({ wall: { ...wall, rotation: [-90, 0, 0] } })).toBeNull();
  expect(hit({ wall }, 0.2)).toBeNull();
});

test("a cone is met on its side, below its apex", () => {
  const cone = object("cone", { position: [0, -0.5, 0] });
  expect(hit({ cone })?.distance).toBeCloseTo(4.5, 5);
  expect(hit({ cone }, 0, 0.2)).toBeNull();
});

test("a triangle is met from its front only, or from both sides, within its edges", () => {
  const corners: SceneObject["corners"] = [
    [-1, -1, 1],
    [3, -1, 1],
    [-1, 3, 1],
  ];
  const wall = object("triangle", { corners, position: [0, 0, -2], scale: [1, 1, 2] });
  expect(hit({ wall })?.distance).toBeCloseTo(5, 5);
  expect(hit({ wall }, 0.5, 0.5)).toBeNull();
  expect(hit({ wall }, -0.25, -0.1)).toBeNull();
  expect(hit({ wall: { ...wall, rotation: [0, 180, 0] } })).toBeNull();
  close(middleOf(scene, wall).middle, [1 / 3, 1 / 3, 0]);
  expect(isBroad(scene, wall)).toBe(true);
  expect(extent({ ...scene, objects: { wall }, lights: {} })).toBeGreaterThanOrEqual(4);
});

test("in a mirrored picture hands push the other way, and right is left", () => {
  const turned: Pose = { ...pose, mirrored: true };
  expect(ray(turned, 0.3, 0.2)).toEqual(ray(pose, -0.3, 0.2));
  const hands = mirrored(ORBIT);
  expect(hands.drag(pose, 0.1, 0.2)).toEqual(ORBIT.drag(pose, -0.1, 0.2));
  expect(hands.slide(pose, 0.1, 0.2)).toEqual(ORBIT.slide(pose, -0.1, 0.2));
  expect(hands.pinch(pose, 0.1, 0.2, 0.9)).toEqual(ORBIT.pinch(pose, -0.1, 0.2, 0.9));
  expect(hands.hold(pose, { left: 1, above: 0.5 }, 0.1)).toEqual(
    ORBIT.hold(pose, { left: -1, above: 0.5 }, 0.1),
  );
  const walk = walking(() => 5);
  expect(mirrored(walk).hold(pose, { right: 1, ahead: 1 }, 0.1)).toEqual(
    walk.hold(pose, { right: -1, ahead: 1 }, 0.1),
  );
});

test("a field of view may be that of the width", () => {
  const wide: Pose = { ...pose, fov_of: "width", aspect: 2 };
  expect(span(wide)).toBeCloseTo(span(pose) / 2, 9);
  close(ray(wide, 1, 0).along, [Math.SQRT1_2, 0, -Math.SQRT1_2]);
  expect(distance(focus(wide, [0, 0, 0], 4))).toBeCloseTo(4, 9);
});

test("the nearest of several counts, scaled and moved", () => {
  const near = object("sphere", { position: [0, 0, 2], scale: [0.5, 0.5, 0.5] });
  const found = hit({ far: object("sphere"), near });
  expect(found?.name).toBe("near");
  close(found!.point, [0, 0, 2.5]);
});
