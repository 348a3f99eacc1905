// Where the picture is seen from: the camera as a setting, its modes, views and flights.
import { Camera } from "./camera";
import type { Manifest, Scene } from "./core/types";
import { byId } from "./dom";
import { extent, isSolid } from "./extent";
import { AUTO, type Value, type Values } from "./fields";
import { recall, remember } from "./memory";
import type { ModeName } from "./modes";
import { distance, focus, isOrthographic, type Pose, ray, rounded, span } from "./orbit";
import { Pad } from "./pad";
import { type Hit, type Meshes, pick } from "./pick";
import { isBroad, middleOf } from "./solid";
import { trim } from "./state";
import type { Store } from "./store";
import { lightOf, seatAt, standing, viewsOf } from "./views";

/** What is seen, and who hears of what is pointed at. */
export interface Scenery {
  manifest(): Manifest;
  preset(): Scene;
  /** The preset with its edits. */
  scene(): Scene;
  /** The meshes that are loaded. */
  mesh: Meshes;
  /** False while another scene is loading. */
  loaded(): boolean;
  hover(at: readonly [x: number, y: number] | null): void;
  pointed(material: string): void;
}

// Metres of picture about an object that a double click goes to, in its radii.
const CLOSE = 2.65;

const LABELS: Record<ModeName, string> = {
  orbit: "Drag or use arrow keys to orbit, wheel or plus and minus to zoom, F to walk.",
  walk: "W, A, S and D walk, R and F go up and down, drag or arrow keys turn the view, Escape ends.",
};

const HINTS: Record<ModeName, { id: string; memory: string }> = {
  orbit: { id: "hint", memory: "moved" },
  walk: { id: "walk-hint", memory: "walked" },
};

export class Viewpoint {
  private readonly camera: Camera;
  private readonly pad: Pad;
  /** Whether what is shown is for a camera. */
  private solid = true;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly store: Store,
    private readonly page: Scenery,
  ) {
    this.camera = new Camera(canvas, {
      pose: () => this.pose(),
      move: (pose) => this.move(pose),
      release: (milliseconds) => store.release(milliseconds),
      point: (x, y, twice) => this.point(x, y, twice),
      hover: (at) => page.hover(at),
      extent: () => extent(page.preset()),
      depth: () => this.hit(0, 0)?.distance ?? null,
      fixed: () => !isSolid(page.scene()),
      changed: () => this.showMode(),
    });
    this.pad = new Pad(byId("frame"), (name, push, now) => this.camera.hold(name, push, now));
    for (const mode of ["orbit", "walk"] as const) {
      byId(mode).addEventListener("click", () => this.camera.use(mode));
    }
    this.showMode();
  }

  /** The picture shows another camera. */
  follow(): void {
    const flat = isOrthographic(this.page.scene().camera);
    const walk = byId<HTMLButtonElement>("walk");
    walk.disabled = flat;
    walk.title = flat ? "Walking needs a camera with perspective" : "Walk (F)";
    const solid = isSolid(this.page.scene());
    if (flat || !solid) this.camera.use("orbit");
    if (solid !== this.solid) this.showMode();
  }

  stop(): void {
    this.camera.stop();
  }

  /** The seat that is taken: "" for the scene's own view, null for none. */
  current(): string | null {
    const own = this.page.preset().camera.light;
    const light = this.store.state.settings["camera.light"] ?? own ?? AUTO;
    if (light !== AUTO) return seatAt(`${light}`);
    return standing(this.page.scene().camera, this.page.preset());
  }

  /** Go to a view of the scene, to its own one with "". */
  show(name: string): void {
    const preset = this.page.preset();
    const light = lightOf(name);
    if (light !== null) {
      this.camera.stop();
      this.put({ "camera.light": light });
      this.store.release();
      return;
    }
    this.camera.fly(viewsOf(preset)[name] ?? preset.camera);
  }

  /** Said once a mode: whoever has moved the camera knows how. */
  dismissHint(): void {
    const hint = byId(HINTS[this.camera.mode].id);
    if (!hint.hidden) remember(HINTS[this.camera.mode].memory, true);
    hint.hidden = true;
  }

  private showMode(): void {
    const { mode } = this.camera;
    this.solid = isSolid(this.page.scene());
    byId("modes").hidden = !this.solid;
    for (const name of ["orbit", "walk"] as const) {
      byId(name).setAttribute("aria-pressed", `${name === mode}`);
      const { id, memory } = HINTS[name];
      byId(id).hidden = !this.solid || name !== mode || recall(memory, false);
    }
    this.canvas.setAttribute(
      "aria-label",
      this.solid ? `The picture. ${LABELS[mode]}` : "The picture",
    );
    this.canvas.classList.toggle("fixed", !this.solid);
    this.canvas.classList.toggle("walk", mode === "walk");
    this.pad.show(mode === "walk");
  }

  private pose(): Pose {
    return { ...this.page.scene().camera, aspect: this.canvas.width / this.canvas.height };
  }

  private move(pose: Pose): void {
    if (!this.page.loaded()) return;
    const { aspect: _, ...camera } = pose;
    const edits = Object.entries(camera as Pose).map(([field, value]): [string, Value] => [
      `camera.${field}`,
      value ?? AUTO,
    ]);
    this.dismissHint();
    this.put(Object.fromEntries(edits));
  }

  private put(edits: Values): void {
    const { state } = this.store;
    const changed = { ...state.settings, ...edits };
    const settings = trim(this.page.manifest(), this.page.preset(), changed);
    this.store.set({ ...state, settings }, "camera");
  }

  private point(x: number, y: number, twice: boolean): void {
    const hit = this.hit(x, y);
    if (twice && hit) this.camera.fly(this.closeUp(hit));
    else if (twice) this.show("");
    else if (hit) this.page.pointed(hit.object.material);
  }

  private hit(x: number, y: number): Hit | null {
    const scene = this.page.scene();
    const { from, along } = ray(this.pose(), x, y);
    return pick(scene, from, along, this.page.mesh);
  }

  /** A broad thing is looked at where it was pointed at, a solid one at its middle. */
  private closeUp({ object, point, distance: away }: Hit): Pose {
    const scene = this.page.scene();
    const camera = this.pose();
    if (isBroad(scene, object)) {
      const height = isOrthographic(camera)
        ? span(camera)
        : (span(camera) * away) / distance(camera);
      return rounded(focus(camera, point, height));
    }
    const { middle, size } = middleOf(scene, object);
    return rounded(focus(camera, middle, CLOSE * size));
  }
}
