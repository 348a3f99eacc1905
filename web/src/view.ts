// The picture on its canvas: drawn when something changed, sized to its place, back after a loss.
import { createContext } from "./core/context";
import { GraphicsError, LightbenchError } from "./core/errors";
import { type Assets, Renderer } from "./core/render";
import { measure, type Timing } from "./core/timer";
import type { Plan } from "./core/types";

export type Size = [width: number, height: number];

/** What the page is told, and asked for. */
export interface Hooks {
  plan(size: Size): Plan;
  drawn(plan: Plan): void;
  timed(timing: Timing): void;
  /** Linear light under the pointer; null where there is no pointer. */
  metered(radiance: Float32Array | null): void;
  /** Nothing has changed for a moment: time to read pixels back. */
  idle(): void;
  busy(what: string | null): void;
  failed(sentence: string | null): void;
}

// More pixels per CSS pixel than this are not seen; more pixels than this no screen has.
const MAX_RATIO = 2;
const MAX_PIXELS = 3840 * 2160;
const IDLE_MILLISECONDS = 250;

export class View {
  plan: Plan | null = null;
  renderer: Renderer | null = null;
  private size: Size = [1, 1];
  private started = false;
  private wanted = false;
  private drawing = false;
  private metering: readonly [x: number, y: number] | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** Throws GraphicsError where the browser has no WebGL2 or lacks what the renderer needs. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly assets: Assets,
    private readonly hooks: Hooks,
  ) {
    this.renderer = new Renderer(createContext(canvas), assets);
    canvas.addEventListener("webglcontextlost", (event) => this.lose(event));
    canvas.addEventListener("webglcontextrestored", () => this.restore());
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(canvas);
    this.followRatio();
    this.resize();
  }

  /** Draw from now on: there is something to plan. */
  start(): void {
    this.started = true;
    this.request();
  }

  /** Draw anew before the next frame is shown. */
  request(): void {
    if (this.wanted || !this.started) return;
    this.wanted = true;
    requestAnimationFrame(() => {
      this.wanted = false;
      void this.frame();
    });
  }

  /** Read the light at a point of the picture (x and y from -1 to 1, y up) once nothing is drawn. */
  meter(at: readonly [x: number, y: number] | null): void {
    this.metering = at;
    if (at && this.plan && !this.wanted && !this.drawing) this.read(at, this.plan);
    else this.hooks.metered(null);
  }

  private read([x, y]: readonly [x: number, y: number], plan: Plan): void {
    const [width, height] = plan.targets[plan.outputs.linear!]!.size as Size;
    const column = Math.min(Math.floor(((x + 1) / 2) * width), width - 1);
    const row = Math.min(Math.floor(((1 - y) / 2) * height), height - 1);
    if (column < 0 || row < 0) return;
    this.hooks.metered(this.renderer?.readLinear([column, row]) ?? null);
  }

  private rest(): void {
    if (!this.renderer || this.drawing) return;
    this.hooks.idle();
    this.meter(this.metering);
  }

  private async frame(): Promise<void> {
    if (!this.renderer || this.drawing) {
      if (this.drawing) this.request();
      return;
    }
    this.drawing = true;
    try {
      await this.draw(this.renderer);
      this.hooks.failed(null);
    } catch (error) {
      this.fail(error);
    } finally {
      this.hooks.busy(null);
      this.drawing = false;
    }
  }

  private async draw(renderer: Renderer): Promise<void> {
    let plan = this.hooks.plan(this.size);
    if (!renderer.ready(plan)) {
      this.hooks.busy("Compiling shaders, loading shapes and images");
      await renderer.prepare(plan);
      if (renderer !== this.renderer) return;
      // Sliders may have moved since; a plan that needs no more waiting is drawn at once.
      const newer = this.hooks.plan(this.size);
      if (renderer.ready(newer)) plan = newer;
      else this.request();
    }
    const failures: unknown[] = [];
    const timing = measure(renderer.gl, () => {
      try {
        renderer.run(plan);
      } catch (error) {
        failures.push(error);
      }
    });
    if (failures.length) throw failures[0];
    this.plan = plan;
    this.hooks.drawn(plan);
    void timing.then((found) => found && this.hooks.timed(found));
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.rest(), IDLE_MILLISECONDS);
  }

  private fail(error: unknown): void {
    if (this.canvas.getContext("webgl2")?.isContextLost()) return;
    if (!(error instanceof LightbenchError)) throw error;
    this.hooks.failed(error.message);
  }

  /** Watch for a window that moves to a screen with other pixels. */
  private followRatio(): void {
    const query = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    const changed = () => {
      this.resize();
      this.followRatio();
    };
    query.addEventListener("change", changed, { once: true });
  }

  private resize(): void {
    const { width, height } = this.canvas.getBoundingClientRect();
    const ratio = Math.min(
      devicePixelRatio,
      MAX_RATIO,
      Math.sqrt(MAX_PIXELS / Math.max(width * height, 1)),
    );
    const size: Size = [width, height].map((side) => Math.max(1, Math.round(side * ratio))) as Size;
    if (`${size}` === `${this.size}`) return;
    this.size = size;
    this.request();
  }

  private lose(event: Event): void {
    event.preventDefault(); // asks for the context back
    clearTimeout(this.timer);
    this.renderer = null;
    this.hooks.failed(
      "The browser took the graphics context away. The picture comes back by itself.",
    );
  }

  private restore(): void {
    try {
      this.renderer = new Renderer(createContext(this.canvas), this.assets);
      this.hooks.failed(null);
      this.request();
    } catch (error) {
      if (!(error instanceof GraphicsError)) throw error;
      this.hooks.failed(error.message);
    }
  }
}
