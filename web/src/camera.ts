// Hands on the picture: pointer, wheel and keys move the camera, which is a setting like any other.
import { isTyping } from "./dom";
import { Fingers } from "./fingers";
import { Held } from "./held";
import { type Mode, type ModeName, mirrored, ORBIT, type Push, together, walking } from "./modes";
import { aimed, between, isOrthographic, type Pose, rounded } from "./orbit";

/** The camera as the page holds it. */
export interface Handle {
  pose(): Pose;
  move(pose: Pose): void;
  /** A gesture has ended, now or once nothing follows for so many milliseconds. */
  release(milliseconds: number): void;
  /** A click, or a double click, at a point of the picture: x and y from -1 to 1, y up. */
  point(x: number, y: number, twice: boolean): void;
  /** The pointer rests on the picture, or (null) has left it. */
  hover(at: readonly [x: number, y: number] | null): void;
  /** Metres that the scene reaches from its middle. */
  extent(): number;
  /** Metres to what is in the middle of the picture; null where nothing is. */
  depth(): number | null;
  /** Whether there is nothing to look at, so that the camera stays where it is. */
  fixed(): boolean;
  /** Another mode is in use. */
  changed(mode: ModeName): void;
}

const WHEEL = 0.0015; // e-folds per pixel of scrolling
const PINCH = 0.01; // the same for a trackpad's pinch, which browsers send as a small wheel
const LINE = 16; // pixels of a line of scrolling
const CLICK = 4; // pixels that a click may wander
const TWICE_MILLISECONDS = 350;
const FLIGHT_MILLISECONDS = 280;
const PAUSE_MILLISECONDS = 500;
// Where arrow keys have a meaning of their own.
const OWN_ARROWS = "[role=tablist], [role=slider], dialog, aside";

export class Camera {
  mode: ModeName = "orbit";
  private readonly modes: Record<ModeName, Mode>;
  private readonly fingers = new Fingers();
  private readonly held = new Held<Push>((pushes, seconds) => {
    const pose = this.pose();
    const next = this.way.hold(pose, together(pushes), seconds);
    if (next !== pose) this.move(next);
  });
  private sliding = false;
  private lastClick = 0;
  private flight = 0;
  private keeping = false;
  /** The pose before its numbers were shortened for the link, and after. */
  private exact: { frame: Partial<Pose>; shown: Pose } | null = null;
  /** The target is where a walk carried it: orbiting first looks for one. */
  private astray = false;

  constructor(
    private readonly surface: HTMLElement,
    private readonly handle: Handle,
  ) {
    this.modes = { orbit: ORBIT, walk: walking(() => handle.extent()) };
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
    window.addEventListener("keyup", (event) => this.keyUp(event));
    window.addEventListener("blur", () => this.held.clear());
    document.addEventListener("visibilitychange", () => this.held.clear());
  }

  /** Move to another pose, as a short flight where motion is welcome. */
  fly(to: Pose): void {
    if (this.handle.fixed()) return;
    const from = this.pose();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const start = performance.now();
    const flight = ++this.flight;
    const step = (now: number) => {
      if (flight !== this.flight) return;
      const share = still ? 1 : Math.min(Math.max(now - start, 0) / FLIGHT_MILLISECONDS, 1);
      if (share < 1) {
        this.move(between(from, to, share * share * (3 - 2 * share)));
        requestAnimationFrame(step);
      } else {
        this.handle.move(to);
        this.handle.release(0);
        this.astray = false;
      }
    };
    requestAnimationFrame(step);
  }

  /** Stand still, whatever is held. */
  stop(): void {
    this.flight += 1;
    this.held.clear();
  }

  /** Orbit or walk. There is no walking into a picture without perspective, or into nothing. */
  use(mode: ModeName): void {
    if (mode === this.mode) return;
    if (mode === "walk" && (this.handle.fixed() || isOrthographic(this.pose()))) return;
    this.stop();
    this.settle(0);
    this.mode = mode;
    this.handle.changed(mode);
  }

  /** Hold something, as a key is held, until it is held no more (null). */
  hold(name: string, push: Push | null, now: number): void {
    this.flight += 1;
    if (push) this.held.press(name, push, now);
    else this.held.lift(name, now);
    if (this.keeping) return;
    this.keeping = true;
    requestAnimationFrame((next) => this.keep(next));
  }

  private get way(): Mode {
    const mode = this.modes[this.mode];
    return this.handle.pose().mirrored ? mirrored(mode) : mode;
  }

  private pose(): Pose {
    const shown = this.handle.pose();
    const { exact } = this;
    const pose = exact && same(exact.shown, shown) ? { ...shown, ...exact.frame } : shown;
    return this.astray && this.mode === "orbit" ? this.found(pose) : pose;
  }

  /** After a walk, what is in the middle is what an orbit turns about. */
  private found(pose: Pose): Pose {
    this.astray = false;
    const depth = this.handle.depth();
    return depth === null ? pose : aimed(pose, depth);
  }

  private move(pose: Pose): void {
    if (this.handle.fixed()) return;
    const shown = rounded(pose);
    const { eye, target, height } = pose;
    this.exact = { frame: { eye, target, height }, shown };
    this.astray ||= this.mode === "walk";
    this.handle.move(shown);
  }

  private press(event: PointerEvent): void {
    this.surface.setPointerCapture(event.pointerId);
    this.settle(0); // what went before is a gesture of its own
    this.fingers.press(event);
    this.sliding = event.button !== 0 || (event.shiftKey && this.way.shiftSlides);
  }

  private drag(event: PointerEvent): void {
    const shift = this.fingers.move(event);
    if (!shift) {
      this.handle.hover(this.place(event));
      return;
    }
    if (this.fingers.wandered < CLICK || (shift.dx === 0 && shift.dy === 0 && shift.factor === 1))
      return;
    this.flight += 1; // a hand on the camera ends its flight
    this.held.advance(event.timeStamp);
    const height = this.surface.clientHeight;
    const [dx, dy] = [shift.dx / height, shift.dy / height];
    const { way } = this;
    if (this.fingers.count > 1) this.move(way.pinch(this.pose(), dx, dy, shift.factor));
    else this.move((this.sliding ? way.slide : way.drag)(this.pose(), dx, dy));
  }

  private lift(event: PointerEvent): void {
    if (!this.fingers.lift(event) || this.fingers.count) return;
    this.settle(0);
    if (event.type !== "pointerup" || event.button !== 0 || this.fingers.wandered >= CLICK) return;
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
    this.move(this.way.wheel(this.pose(), Math.exp(Math.max(-1, Math.min(amount, 1)))));
    this.settle(PAUSE_MILLISECONDS);
  }

  private keyDown(event: KeyboardEvent): void {
    const { key, code, ctrlKey, metaKey, altKey } = event;
    if (ctrlKey || metaKey || altKey || isTyping(event.target) || inDialog()) return;
    if ((event.target as HTMLElement).closest(OWN_ARROWS) && key.startsWith("Arrow")) return;
    if (this.mode === "orbit" && key.toLowerCase() === "f" && !event.repeat) this.use("walk");
    else if (this.mode === "walk" && key === "Escape") this.use("orbit");
    else {
      const push = this.way.keys[code] ?? this.way.keys[key];
      if (!push) return;
      if (!event.repeat) this.hold(code || key, push, event.timeStamp);
    }
    event.preventDefault();
  }

  private keyUp(event: KeyboardEvent): void {
    if (event.key === "Meta")
      this.held.clear(); // whose system tells of no other key meanwhile
    else if (!this.held.idle) this.hold(event.code || event.key, null, event.timeStamp);
  }

  /** At each frame while something is held. */
  private keep(now: number): void {
    if (inDialog()) this.held.clear();
    this.held.advance(now);
    this.keeping = !this.held.idle;
    if (this.keeping) requestAnimationFrame((next) => this.keep(next));
    else this.settle(PAUSE_MILLISECONDS);
  }

  /** The gesture is over once nothing is down. */
  private settle(milliseconds: number): void {
    if (this.held.idle && !this.fingers.count) this.handle.release(milliseconds);
  }
}

function same(a: Pose, b: Pose): boolean {
  return `${[...a.eye, ...a.target, a.height]}` === `${[...b.eye, ...b.target, b.height]}`;
}

function inDialog(): boolean {
  return document.querySelector("dialog[open]") !== null;
}
