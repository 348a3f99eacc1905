import { expect, test } from "vitest";
import type { Scene } from "../src/core/types";
import { extent, isSolid } from "../src/extent";
import { Held } from "../src/held";
import { ORBIT, type Push, together, walking } from "../src/modes";
import { distance, type Pose, rounded } from "../src/orbit";
import { LeftViews, standing, viewsOf } from "../src/views";
import { look, STEEPEST, type Stride, step, stride } from "../src/walk";
import { scene } from "./bench";

const pose: Pose = { eye: [0, 0, 5], target: [0, 0, 0], up: [0, 1, 0], fov: 45 };
const still: Stride = { right: 0, up: 0, ahead: 0, left: 0, above: 0 };
const close = (found: readonly number[], wanted: readonly number[], digits = 9) => {
  for (const [axis, value] of wanted.entries()) expect(found[axis]).toBeCloseTo(value, digits);
};
const view = ({ eye, target }: Pose) => target.map((c, axis) => c - (eye[axis] ?? 0));
const length = (v: readonly number[]) => Math.hypot(...v);
const steepness = (at: Pose) =>
  Math.abs(view(at).reduce((sum, c, axis) => sum + c * (at.up[axis] ?? 0), 0)) /
  (length(view(at)) * length(at.up));

test.each([
  [{ ahead: 1 }, [0, 0, 3]],
  [{ ahead: -1 }, [0, 0, 7]],
  [{ right: 1 }, [2, 0, 5]],
  [{ right: -1 }, [-2, 0, 5]],
  [{ up: 1 }, [0, 2, 5]],
  [{ up: -1 }, [0, -2, 5]],
  [{ ahead: 0.5 }, [0, 0, 4]],
])("at one metre a second, %o for two seconds leads to %o", (push, eye) => {
  const there = stride(pose, { ...still, ...push }, 1, 1, 2);
  close(there.eye, eye);
  close(view(there), view(pose));
});

test("several directions at once are no faster than one", () => {
  const risen = look(pose, 0.4, 0.9);
  for (const push of [
    { ahead: 1, right: 1 },
    { ahead: 1, right: -1, up: 1 },
    { ahead: 1, up: -1 },
    { ahead: 2 },
  ]) {
    const there = stride(risen, { ...still, ...push }, 3, 1, 0.5);
    expect(length(there.eye.map((c, axis) => c - risen.eye[axis]!))).toBeCloseTo(1.5, 9);
  }
  const both = together([{ ahead: 1 }, { ahead: -1 }]);
  expect(walking(() => 1).hold(pose, both, 1)).toBe(pose);
});

test("forward goes where the view goes, up goes along the up vector", () => {
  const risen = look(pose, 0, Math.PI / 6);
  close(stride(risen, { ...still, ahead: 1 }, 1, 1, 1).eye, [0, 0.5, 5 - Math.sqrt(0.75)]);
  close(stride(risen, { ...still, up: 1 }, 1, 1, 1).eye, [0, 1, 5]);
  close(step(risen, 1, 2, 0).eye, [1, 2, 5]);
});

test("looking turns the view about the eye, to the left and up", () => {
  const left = look(pose, Math.PI / 2, 0);
  expect(left.eye).toEqual(pose.eye);
  close(left.target, [-5, 0, 5]);
  close(look(pose, 0, Math.PI / 6).target, [0, 2.5, 5 - 5 * Math.sqrt(0.75)]);
  expect(distance(look(pose, 1, 0.5))).toBeCloseTo(5, 9);
});

test.each([[[0, 1, 0]], [[0, 0, 1]], [[1, 2, -0.5]]])(
  "the view never comes closer to up %o than the bound",
  (up) => {
    let at: Pose = { ...pose, eye: [0.3, -2, 5], up };
    for (let turn = 0; turn < 40; turn += 1) {
      at = look(at, 0.37, turn < 20 ? 0.3 : -0.4);
      expect(steepness(rounded(at))).toBeLessThan(STEEPEST);
    }
    const risen = stride(at, { ...still, above: 1, ahead: 1 }, 1, 1.2, 30);
    expect(steepness(rounded(risen))).toBeLessThan(STEEPEST);
    expect(steepness(risen)).toBeGreaterThan(STEEPEST - 0.001);
  },
);

test("a view along up is brought back within the bound before it moves", () => {
  const steep: Pose = { ...pose, eye: [0, 5, 0.01] };
  expect(steepness(stride(steep, { ...still, ahead: 1 }, 1, 1, 0.1))).toBeLessThan(STEEPEST);
  expect(steepness(step(steep, 0, 0, 1))).toBeLessThan(STEEPEST);
});

/** A hand on keys (and a mouse, which turns the view), in milliseconds. */
const HAND: [at: number, name: string, push: Push | null][] = [
  [103.7, "KeyW", { ahead: 1 }],
  [341.2, "ArrowLeft", { left: 1 }],
  [512.9, "KeyR", { up: 1 }],
  [604.4, "mouse", {}],
  [777.1, "ShiftLeft", { fast: 1 }],
  [900.3, "KeyR", null],
  [1111.8, "ArrowUp", { above: 1 }],
  [2950.5, "KeyA", { right: -1 }],
  [3001.6, "ArrowLeft", null],
  [3204.9, "ShiftLeft", null],
  [3300.2, "ArrowUp", null],
  [3333.3, "KeyD", { right: 1 }],
  [3340.1, "KeyD", null],
  [3512.6, "KeyW", null],
  [3777.7, "KeyA", null],
];

/** Where the hand leads with frames at these times. */
function walked(frames: Iterable<number>, mode = walking(() => 5)): Pose {
  let at = pose;
  const held = new Held<Push>((pushes, seconds) => {
    at = mode.hold(at, together(pushes), seconds);
  });
  const events: { at: number; act(now: number): void }[] = HAND.map(([when, name, push]) => ({
    at: when,
    act(now) {
      held.advance(now);
      if (name === "mouse") at = mode.drag(at, 0.1, -0.05);
      else if (push) held.press(name, push, now);
      else held.lift(name, now);
    },
  }));
  const all = [
    ...events,
    ...[...frames].map((when) => ({ at: when, act: (now: number) => held.advance(now) })),
  ];
  for (const event of all.sort((a, b) => a.at - b.at)) event.act(event.at);
  expect(held.idle).toBe(true);
  return at;
}

function* even(rate: number): Generator<number> {
  for (let frame = 0; frame < 5 * rate; frame += 1) yield (frame * 1000) / rate;
}

/** Frames that come as a busy machine's do. */
function* uneven(): Generator<number> {
  let state = 1;
  for (let now = 0; now < 5000; ) {
    state = (state * 48271) % 2147483647;
    now += 2 + 90 * (state / 2147483647) ** 3;
    yield now;
  }
}

test("30, 60 and 144 frames a second and uneven ones lead the same way", () => {
  const wanted = walked(even(1000));
  expect(length(wanted.eye.map((c, axis) => c - pose.eye[axis]!))).toBeGreaterThan(1);
  for (const frames of [even(30), even(60), even(144), uneven()]) {
    const there = walked(frames);
    close(there.eye, wanted.eye, 9);
    close(there.target, wanted.target, 9);
  }
});

test("orbit's keys lead the same way too", () => {
  const wanted = walked(even(1000), ORBIT);
  expect(wanted.eye[1]).toBeGreaterThan(1);
  for (const frames of [even(30), even(144), uneven()])
    close(walked(frames, ORBIT).eye, wanted.eye, 9);
});

test("a path with turns is the limit of many small steps", () => {
  const push = { ...still, ahead: 1, right: 0.5, left: 1, above: 0.7 };
  let small = pose;
  for (let at = 0; at < 20000; at += 1) small = stride(small, push, 2, 1.2, 1e-5);
  const whole = stride(stride(pose, push, 2, 1.2, 0.1), push, 2, 1.2, 0.1);
  close(whole.eye, small.eye, 8);
});

function counted() {
  const steps: [names: string, seconds: number][] = [];
  const held = new Held<string>((pushes, seconds) => steps.push([pushes.join(), seconds]));
  const total = () => steps.reduce((sum, [, seconds]) => sum + seconds, 0);
  return { held, steps, total };
}

test("a tap counts though no frame saw it, a longer press counts as long as it lasted", () => {
  const tap = counted();
  tap.held.press("w", "ahead", 1000);
  tap.held.lift("w", 1001);
  expect(tap.total()).toBeCloseTo(1 / 30, 9);
  const press = counted();
  press.held.press("w", "ahead", 1000);
  press.held.advance(1016);
  press.held.lift("w", 1050);
  expect(press.total()).toBeCloseTo(0.05, 9);
});

test("a page that was stopped goes on from where it was", () => {
  const { held, total } = counted();
  held.press("w", "ahead", 1000);
  held.advance(61_000);
  expect(total()).toBe(0.5);
  held.clear();
  held.advance(62_000);
  expect(total()).toBe(0.5);
  expect(held.idle).toBe(true);
});

test("times that run backwards move nothing", () => {
  const { held, steps } = counted();
  held.press("w", "ahead", 1000);
  held.advance(990);
  held.lift("s", 995);
  expect(steps).toEqual([]);
});

test("the pace is the scene's, and Shift is faster", () => {
  const gone = (reach: number, push: Push) => 5 - walking(() => reach).hold(pose, push, 1).eye[2]!;
  expect(gone(10, { ahead: 1 })).toBeCloseTo(10 * gone(1, { ahead: 1 }), 9);
  expect(gone(1, { ahead: 1, fast: 1 })).toBeCloseTo(3 * gone(1, { ahead: 1 }), 9);
  expect(gone(1, { ahead: 1, fast: 2 })).toBeCloseTo(gone(1, { ahead: 1, fast: 1 }), 9);
  expect(walking(() => 1).hold(pose, { fast: 1 }, 1)).toBe(pose);
});

test("two fingers that go up or spread walk ahead, the wheel too", () => {
  const mode = walking(() => 1);
  expect(mode.pinch(pose, 0, -0.5, 1).eye[2]).toBeLessThan(5);
  expect(mode.pinch(pose, 0, 0, 0.5).eye[2]).toBeLessThan(5);
  expect(mode.pinch(pose, 0.5, 0, 1).eye[0]).toBeGreaterThan(0);
  expect(mode.wheel(pose, 0.9).eye[2]).toBeLessThan(5);
});

test("a scene is as large as its farthest thing or light", () => {
  const thing = { ...scene.objects.ball!, position: [0, 0, 0], scale: [2, 2, 2] };
  const only = (object: object, rest: object = {}) =>
    extent({ ...scene, lights: {}, objects: { thing: object }, ...rest } as unknown as Scene);
  expect(only(thing)).toBe(1);
  expect(only({ ...thing, position: [-4, 0, 0] })).toBe(5);
  expect(only({ ...thing, scale: [500, 1, 500] })).toBe(10);
  const meshes = { hall: { low: [-20, 0, -1], high: [3, 2, 1] } };
  expect(only({ ...thing, mesh: "hall" }, { meshes })).toBe(50);
});

test("flat parts are nothing that a camera looks at", () => {
  expect(isSolid(scene)).toBe(true);
  expect(isSolid({ objects: {} })).toBe(false);
});

test("a scene's views are known by name", () => {
  const { camera } = scene;
  const top = { ...camera, eye: [0, 9, 1] as [number, number, number] };
  const viewed = { ...scene, views: { top } };
  expect(viewsOf(scene)).toEqual({});
  expect(viewsOf(viewed)).toEqual({ top });
  expect(standing(camera, viewed)).toBe("");
  expect(standing({ ...top }, viewed)).toBe("top");
  expect(standing({ ...top, fov: 12 }, viewed)).toBeNull();
});

test("each scene is found as it was left, the camera and no more", () => {
  const left = new LeftViews();
  left.leave({ scene: "room", settings: { model: "phong", "camera.eye": [1, 2, 3] } });
  expect(left.of("room")).toEqual({ "camera.eye": [1, 2, 3] });
  expect(left.of("other")).toEqual({});
});
