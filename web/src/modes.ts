// The two ways to move the camera: what pointers, wheel and held keys do to it. Pure functions.
import { orbit, type Pose, pan, zoom } from "./orbit";
import { look, type Stride, step, stride } from "./walk";

export type ModeName = "orbit" | "walk";

/** What one key does; of several that are held, the sum. */
export type Push = Readonly<Partial<Stride & { closer: number; fast: number }>>;

/** Distances of pointers are parts of the picture's height, to the right and down. */
export interface Mode {
  /** By what a key is called (`w`) or by its place (`KeyW`). */
  readonly keys: Readonly<Record<string, Push>>;
  /** Whether Shift makes a drag a sideways one. */
  readonly shiftSlides: boolean;
  drag(pose: Pose, dx: number, dy: number): Pose;
  /** A drag with the right or middle button. */
  slide(pose: Pose, dx: number, dy: number): Pose;
  /** Two fingers; `factor` is below 1 while they spread. */
  pinch(pose: Pose, dx: number, dy: number, factor: number): Pose;
  wheel(pose: Pose, factor: number): Pose;
  /** The same pose where nothing moves it. */
  hold(pose: Pose, push: Push, seconds: number): Pose;
}

const DRAG = Math.PI; // radians, over the picture's height
const TURN = 1.2; // radians a second
const ZOOM = 1.2; // e-folds a second
// In parts of the scene's extent:
const PACE = 0.3; // a second
const PULL = 0.6; // over the picture's height, and for an e-fold of wheel or pinch
const FAST = 3;

const TURNS = {
  ArrowLeft: { left: 1 },
  ArrowRight: { left: -1 },
  ArrowUp: { above: 1 },
  ArrowDown: { above: -1 },
};

export const ORBIT: Mode = {
  keys: { ...TURNS, "+": { closer: 1 }, "=": { closer: 1 }, "-": { closer: -1 } },
  shiftSlides: true,
  drag: (pose, dx, dy) => orbit(pose, dx * DRAG, dy * DRAG),
  slide: (pose, dx, dy) => pan(pose, -dx, dy),
  pinch: (pose, dx, dy, factor) => zoom(pan(pose, -dx, dy), factor),
  wheel: zoom,
  hold(pose, { left = 0, above = 0, closer = 0 }, seconds) {
    if (!left && !above && !closer) return pose;
    const turned = orbit(pose, left * TURN * seconds, above * TURN * seconds);
    return zoom(turned, Math.exp(-closer * ZOOM * seconds));
  },
};

/** First person in a scene that reaches `extent()` metres from its middle. */
export function walking(extent: () => number): Mode {
  const pull = (pose: Pose, right: number, up: number, ahead: number) =>
    step(pose, right * PULL * extent(), up * PULL * extent(), ahead * PULL * extent());
  return {
    keys: {
      ...TURNS,
      KeyW: { ahead: 1 },
      KeyS: { ahead: -1 },
      KeyA: { right: -1 },
      KeyD: { right: 1 },
      KeyR: { up: 1 },
      KeyF: { up: -1 },
      ShiftLeft: { fast: 1 },
      ShiftRight: { fast: 1 },
    },
    shiftSlides: false,
    drag: (pose, dx, dy) => look(pose, -dx * DRAG, -dy * DRAG),
    slide: (pose, dx, dy) => pull(pose, -dx, dy, 0),
    pinch: (pose, dx, dy, factor) => pull(pose, dx, 0, -dy - Math.log(factor)),
    wheel: (pose, factor) => pull(pose, 0, 0, -Math.log(factor)),
    hold(pose, push, seconds) {
      const moves = (["right", "up", "ahead", "left", "above"] as const).some((way) => push[way]);
      if (!moves) return pose;
      const move = { right: 0, up: 0, ahead: 0, left: 0, above: 0, ...push };
      const speed = PACE * extent() * (push.fast ? FAST : 1);
      return stride(pose, move, speed, TURN, seconds);
    },
  };
}

/** The same hands on a picture in which right is left. */
export function mirrored(mode: Mode): Mode {
  return {
    ...mode,
    drag: (pose, dx, dy) => mode.drag(pose, -dx, dy),
    slide: (pose, dx, dy) => mode.slide(pose, -dx, dy),
    pinch: (pose, dx, dy, factor) => mode.pinch(pose, -dx, dy, factor),
    hold: (pose, { right = 0, left = 0, ...push }, seconds) =>
      mode.hold(pose, { ...push, right: -right, left: -left }, seconds),
  };
}

/** What several keys do together. */
export function together(pushes: Iterable<Push>): Push {
  const sum: Record<string, number> = {};
  for (const push of pushes) {
    for (const [way, amount] of Object.entries(push)) sum[way] = (sum[way] ?? 0) + amount;
  }
  return sum;
}
