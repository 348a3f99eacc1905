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

export interface Probe {
  /** Resolves with the first picture. */
  ready: Promise<void>;
  /** A picture of a preset, drawn aside: the page's own stays as it is. */
  render(
    scene: string,
    settings?: Settings,
    size?: [number, number],
    attachment?: string,
  ): Promise<Picture>;
  plan(
    scene: string,
    settings?: Settings,
    size?: [number, number],
    attachment?: string,
  ): Promise<Plan>;
  /**
   * Wall-clock milliseconds of whole frames after a warm-up: planning, drawing, and the read-back of
   * one pixel that waits for its end.
   */
  measure(
    scene: string,
    settings: Settings,
    size: [number, number],
    frames: number,
  ): Promise<{ milliseconds: number[]; renderer: string }>;
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
  const planned: Probe["plan"] = async (scene, settings = {}, size = [640, 480], attachment) =>
    plan(await bench.manifest, await bench.scene(scene), settings, size, attachment);
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
      const [manifest, described] = await Promise.all([bench.manifest, bench.scene(scene)]);
      const draw = () => plan(manifest, described, settings, size);
      const aside = await prepared(draw());
      const pixel = new Uint8Array(4);
      const milliseconds: number[] = [];
      for (let frame = 0; frame < WARM_UP + frames; frame++) {
        const start = performance.now();
        aside.run(draw());
        aside.gl.readPixels(0, 0, 1, 1, aside.gl.RGBA, aside.gl.UNSIGNED_BYTE, pixel);
        milliseconds.push(performance.now() - start);
      }
      return { milliseconds: milliseconds.slice(WARM_UP), renderer: aside.name };
    },
  };
}
