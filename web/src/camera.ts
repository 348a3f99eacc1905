// Hands on the picture: pointer, wheel and keys move the camera, which is a setting like any other.
import { isTyping } from "./dom";
import { between, orbit, type Pose, pan, zoom } from "./orbit";

/** The camera as the page holds it. */
export interface Handle {
  pose(): Pose;
  fov(): number;
  move(pose: Pose): void;
  /** A gesture has ended, now or once nothing follows for so many milliseconds. */
  release(milliseconds: number): void;
  /** A click, or a double click, at a point of the picture: x and y from -1 to 1, y up. */
  point(x: number, y: number, twice: boolean): void;
  /** The pointer rests on the picture, or (null) has left it. */
  hover(at: readonly [x: number, y: number] | null): void;
}

interface Finger {
  x: number;
  y: number;
}

const TURN = Math.PI; // a drag over the picture's height, in radians
const KEY_TURN = 1.2; // radians per second
const KEY_ZOOM = 1.2; // e-folds per second
const WHEEL = 0.0015; // e-folds per pixel of scrolling
const PINCH = 0.01; // the same for a trackpad's pinch, which browsers send as a small wheel
const LINE = 16; // pixels of a line of scrolling
const CLICK = 4; // pixels that a click may wander
const TWICE_MILLISECONDS = 350;
const FLIGHT_MILLISECONDS = 280;
const PAUSE_MILLISECONDS = 500;

const TAP_SECONDS = 1 / 30; // what a key does at once, so that a tap shorter than a frame counts
// Where arrow keys have a meaning of their own.
const OWN_ARROWS = "[role=tablist], [role=slider], dialog, aside";

const KEYS: Record<string, [left: number, above: number, closer: number]> = {
  ArrowLeft: [1, 0, 0],
  ArrowRight: [-1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  "+": [0, 0, 1],
  "=": [0, 0, 1],
  "-": [0, 0, -1],
};

export class Camera {
  private readonly fingers = new Map<number, Finger>();
  private readonly keys = new Set<string>();
  private wandered = 0;
  private panning = false;
  private lastClick = 0;
  private last = 0;
  private flight = 0;

  constructor(
    private readonly surface: HTMLElement,
    private readonly handle: Handle,
  ) {
    surface.addEventListener("pointerdown", (event) => this.press(event));
    surface.addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"] as const) {
      surface.addEventListener(end, (event) => this.lift(event));
    }
    surface.addEventListener("pointerleave", () => this.handle.hover(null));
    surface.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    surface.addEventListener("contextmenu", (event) => event.preventDefault());
    surface.addEventListener("mousedown", (event) => {
      if (event.button === 1) event.preventDefault(); // no scrolling by the middle button
    });
    window.addEventListener("keydown", (event) => this.keyDown(event));
    window.addEventListener("keyup", (event) => this.keys.delete(event.key));
    window.addEventListener("blur", () => this.keys.clear());
  }

  /** Move to another pose, as a short flight where motion is welcome. */
  fly(to: Pose): void {
    const from = this.handle.pose();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const start = performance.now();
    const flight = ++this.flight;
    const step = (now: number) => {
      if (flight !== this.flight) return;
      const share = still ? 1 : Math.min((now - start) / FLIGHT_MILLISECONDS, 1);
      this.handle.move(between(from, to, share * share * (3 - 2 * share)));
      if (share < 1) requestAnimationFrame(step);
      else this.handle.release(0);
    };
    requestAnimationFrame(step);
  }

  private press(event: PointerEvent): void {
    this.surface.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.panning = event.button !== 0 || event.shiftKey;
    if (this.fingers.size === 1) this.wandered = 0;
  }

  private drag(event: PointerEvent): void {
    const finger = this.fingers.get(event.pointerId);
    if (!finger) {
      this.handle.hover(this.place(event));
      return;
    }
    const before = this.grip();
    const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
    finger.x = event.clientX;
    finger.y = event.clientY;
    this.wandered += Math.abs(dx) + Math.abs(dy);
    if (this.wandered < CLICK || (dx === 0 && dy === 0)) return;
    this.flight += 1; // a hand on the camera ends its flight
    const height = this.surface.clientHeight;
    const pose = this.handle.pose();
    if (this.fingers.size > 1) this.pinch(pose, before, height);
    else if (this.panning)
      this.handle.move(pan(pose, this.handle.fov(), -dx / height, dy / height));
    else this.handle.move(orbit(pose, (dx / height) * TURN, (dy / height) * TURN));
  }

  private pinch(
    pose: Pose,
    before: { x: number; y: number; spread: number },
    height: number,
  ): void {
    const after = this.grip();
    const closer = before.spread > 0 && after.spread > 0 ? before.spread / after.spread : 1;
    const [dx, dy] = [(after.x - before.x) / height, (after.y - before.y) / height];
    this.handle.move(zoom(pan(pose, this.handle.fov(), -dx, dy), closer));
  }

  /** Middle of the fingers and their mean distance from it. */
  private grip(): { x: number; y: number; spread: number } {
    const all = [...this.fingers.values()];
    const mean = (of: (finger: Finger) => number) =>
      all.reduce((sum, f) => sum + of(f), 0) / all.length;
    const [x, y] = [mean((f) => f.x), mean((f) => f.y)];
    return { x, y, spread: mean((f) => Math.hypot(f.x - x, f.y - y)) };
  }

  private lift(event: PointerEvent): void {
    if (!this.fingers.delete(event.pointerId) || this.fingers.size) return;
    this.handle.release(0);
    if (event.type !== "pointerup" || event.button !== 0 || this.wandered >= CLICK) return;
    const twice = event.timeStamp - this.lastClick < TWICE_MILLISECONDS;
    this.lastClick = twice ? 0 : event.timeStamp;
    this.handle.point(...this.place(event), twice);
  }

  private place(event: PointerEvent): [x: number, y: number] {
    const box = this.surface.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * 2 - 1;
    return [x, 1 - ((event.clientY - box.top) / box.height) * 2];
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.flight += 1;
    const unit =
      event.deltaMode === 1 ? LINE : event.deltaMode === 2 ? this.surface.clientHeight : 1;
    const amount = event.deltaY * unit * (event.ctrlKey ? PINCH : WHEEL);
    this.handle.move(zoom(this.handle.pose(), Math.exp(Math.max(-1, Math.min(amount, 1)))));
    this.handle.release(PAUSE_MILLISECONDS);
  }

  private keyDown(event: KeyboardEvent): void {
    const { key, ctrlKey, metaKey, altKey } = event;
    if (!KEYS[key] || ctrlKey || metaKey || altKey || isTyping(event.target)) return;
    if ((event.target as HTMLElement).closest(OWN_ARROWS) && key.startsWith("Arrow")) return;
    event.preventDefault();
    this.flight += 1;
    if (this.keys.has(key)) return;
    this.keys.add(key);
    this.last = performance.now();
    this.turn(TAP_SECONDS);
    if (this.keys.size === 1) requestAnimationFrame((now) => this.hold(now));
  }

  /** While keys are down: as far in a second on a slow machine as on a quick one. */
  private hold(now: number): void {
    const seconds = Math.min(Math.max(now - this.last, 0) / 1000, 0.2);
    this.last = now;
    if (this.keys.size) {
      this.turn(seconds);
      requestAnimationFrame((next) => this.hold(next));
    } else this.handle.release(PAUSE_MILLISECONDS);
  }

  private turn(seconds: number): void {
    const sum = (at: 0 | 1 | 2) => [...this.keys].reduce((total, key) => total + KEYS[key]![at], 0);
    const turn = KEY_TURN * seconds;
    const turned = orbit(this.handle.pose(), sum(0) * turn, sum(1) * turn);
    this.handle.move(zoom(turned, Math.exp(-sum(2) * KEY_ZOOM * seconds)));
  }
}
