// `window.lightbench`: the page's own tools for tests and for the console.
import type { Panel } from "./atlas_error";
import { createContext } from "./core/context";
import { plan } from "./core/plan";
import { type Assets, Renderer } from "./core/render";
import type { Settings } from "./core/settings";
import type { Manifest, Plan, Program, Scene } from "./core/types";
import { loadAtlasMap } from "./data";

const WARM_UP = 3;

/** RGBA rows from the top: linear radiance (or another attachment) and display codes. */
export interface Picture {
  linear: Float32Array;
  display: Uint8Array;
  width: number;
  height: number;
  /** Width and height of `linear`, which an attachment may have of its own. */
  size: readonly number[];
  renderer: string;
}

export interface Measured {
  milliseconds: number[];
  renderer: string;
}

export interface Probe {
  /** Resolves with the first picture; rejects with what the page says in its place. */
  ready: Promise<void>;
  /** A picture of a preset or a scene, drawn aside: the page's own stays as it is. */
  render(
    scene: string | Scene,
    settings?: Settings,
    size?: [number, number],
    attachment?: string,
  ): Promise<Picture>;
  plan(
    scene: string | Scene,
    settings?: Settings,
    size?: [number, number],
    attachment?: string,
  ): Promise<Plan>;
  /**
   * Wall-clock milliseconds of whole frames after a warm-up: planning, drawing, and the read-back of
   * one pixel that waits for its end.
   */
  measure(
    scene: string | Scene,
    settings: Settings,
    size: [number, number],
    frames: number,
  ): Promise<Measured>;
  /**
   * The same of the passes that lead to the linear picture alone, planned beforehand and without what
   * displays it.
   */
  measureLinear(
    scene: string | Scene,
    settings: Settings,
    size: [number, number],
    frames: number,
  ): Promise<Measured>;
  /** The maps of a shader function over two of its inputs, computed by this browser. */
  atlas(file: string, name: string, x: string, y: string): Promise<Panel[]>;
  /** The page's address with the state as it is now. */
  link(): string;
  /** The programs of the picture that is shown. */
  programs(): readonly Program[];
  /** How often each pass of the page's own pictures has run, by its name. */
  runs(): Readonly<Record<string, number>>;
}

declare global {
  interface Window {
    lightbench: Probe;
  }
}

/** What the probe needs of the page. */
export interface Bench {
  manifest: Promise<Manifest>;
  scene(name: string): Promise<Scene>;
  assets: Assets;
  link(): string;
  shown(): Plan | null;
  runs(): Readonly<Record<string, number>>;
  ready: Promise<void>;
}

export function makeProbe(bench: Bench): Probe {
  let renderer: Renderer | null = null;
  const described = (scene: string | Scene) =>
    typeof scene === "string" ? bench.scene(scene) : Promise.resolve(scene);
  const planned: Probe["plan"] = async (scene, settings = {}, size = [640, 480], attachment) =>
    plan(await bench.manifest, await described(scene), settings, size, attachment);
  const prepared = async (found: Plan): Promise<Renderer> => {
    if (renderer?.gl.isContextLost()) renderer = null;
    renderer ??= new Renderer(createContext(new OffscreenCanvas(1, 1)), bench.assets);
    await renderer.prepare(found);
    return renderer;
  };
  return {
    ready: bench.ready,
    plan: planned,
    link: bench.link,
    programs: () => bench.shown()?.programs ?? [],
    runs: bench.runs,
    async render(scene, settings = {}, size = [640, 480], attachment) {
      const found = await planned(scene, settings, size, attachment);
      const aside = await prepared(found);
      aside.run(found);
      const [width, height] = size;
      const linear = aside.readLinear();
      const { size: own } = found.targets[found.outputs.linear!]!;
      const display = aside.readDisplay();
      return { linear, display, width, height, size: own, renderer: aside.name };
    },
    async atlas(file, name, x, y) {
      const { compute, unpack } = await import("./atlas_gl");
      return (await compute(unpack(await loadAtlasMap(file, name, x, y)))).panels;
    },
    async measure(scene, settings, size, frames) {
      const [manifest, found] = await Promise.all([bench.manifest, described(scene)]);
      const draw = () => plan(manifest, found, settings, size);
      const aside = await prepared(draw());
      const pixel = new Uint8Array(4);
      return measured(aside, frames, () => {
        aside.run(draw());
        aside.gl.readPixels(0, 0, 1, 1, aside.gl.RGBA, aside.gl.UNSIGNED_BYTE, pixel);
      });
    },
    async measureLinear(scene, settings, size, frames) {
      const found = linearOnly(await planned(scene, settings, size));
      const aside = await prepared(found);
      return measured(aside, frames, () => {
        aside.run(found);
        aside.readLinear([0, 0]);
      });
    },
  };
}

/** Milliseconds of each of some frames after a warm-up; `draw` waits for its end. */
function measured({ name }: Renderer, frames: number, draw: () => void): Measured {
  const milliseconds: number[] = [];
  for (let frame = 0; frame < WARM_UP + frames; frame++) {
    const start = performance.now();
    draw();
    milliseconds.push(performance.now() - start);
  }
  return { milliseconds: milliseconds.slice(WARM_UP), renderer: name };
}

/** The plan without the passes after its linear picture. */
export function linearOnly(whole: Plan): Plan {
  const last = whole.passes.findIndex(({ target }) => target === whole.outputs.linear);
  return { ...whole, passes: whole.passes.slice(0, last + 1) };
}
