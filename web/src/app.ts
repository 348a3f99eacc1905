// The page's parts and how they hear of each other: state to picture, picture to panel.
import { Camera } from "./camera";
import { current, type Situation, tabOf } from "./controls";
import { LightbenchError } from "./core/errors";
import { type Mesh, meshesFrom } from "./core/mesh";
import { plan } from "./core/plan";
import { resolve } from "./core/settings";
import type { Manifest, Plan, Scene } from "./core/types";
import { loadManifest, loadScene, thumbnail } from "./data";
import { byId } from "./dom";
import type { Values } from "./fields";
import { loadTypesetter } from "./formula";
import { countInvalid } from "./invalid";
import { Link } from "./link";
import { recall, remember } from "./memory";
import { Notices } from "./notices";
import { focus, type Pose, ray } from "./orbit";
import { Panel } from "./panel";
import { type Hit, pick } from "./pick";
import { makeProbe } from "./probe";
import { trim } from "./state";
import { Status } from "./status";
import { Store } from "./store";
import { addTools } from "./tools";
import { type Size, View } from "./view";
import { Wipe } from "./wipe";

const DEFAULT_SCENE = "box-room";
// How far from an object a double click goes, in its radii.
const CLOSE = 3.2;

export class App {
  readonly notices = new Notices(byId("notices"));
  readonly status = new Status(byId("line"));
  readonly store = new Store({ scene: "", settings: {} });
  readonly link = new Link(this.store, (sentence) => this.notices.say(sentence));
  manifest!: Manifest;
  view!: View;
  wipe!: Wipe;
  panel!: Panel;
  private camera!: Camera;
  private preset!: Scene;
  /** The preset's name; the state's may be ahead of it while that one loads. */
  private name = "";
  private readonly scenes = new Map<string, Promise<Scene>>();
  private readonly triangles = new Map<string, number>();
  private readonly loading = loadManifest();
  private arrive!: () => void;
  private readonly ready = new Promise<void>((done) => {
    this.arrive = done;
  });

  /** Resolves once everything is loaded and the first picture is under way. */
  async start(): Promise<void> {
    window.lightbench = makeProbe({
      manifest: this.loading,
      scene: (name) => this.scene(name),
      meshes: (key) => this.mesh(key),
      link: () => this.link.flush(),
      shown: () => this.view?.plan ?? null,
      ready: this.ready,
    });
    this.busy("Loading");
    const asked = this.link.scene() ?? DEFAULT_SCENE;
    const early = this.scene(asked).catch(() => null); // beside the manifest, not after it
    this.makeView();
    this.manifest = await this.loading;
    const known = Object.keys(this.manifest.scenes);
    const name = known.includes(asked)
      ? asked
      : known.includes(DEFAULT_SCENE)
        ? DEFAULT_SCENE
        : known[0];
    if (name === undefined)
      throw new LightbenchError("There is no scene to show: the folder of scenes is empty");
    if (name !== asked)
      this.notices.say(`There is no scene '${asked}'; there is: ${known.join(", ")}.`);
    this.preset = (name === asked && (await early)) || (await this.scene(name));
    this.name = name;
    this.store.start({ scene: name, settings: this.link.settings(this.manifest, this.preset) });
    this.makeParts();
    this.follow();
    this.view.start();
  }

  private makeView(): void {
    this.view = new View(byId<HTMLCanvasElement>("picture"), (key) => this.mesh(key), {
      plan: (size) => this.plan(size),
      drawn: (shown) => this.drawn(shown),
      timed: (timing) => this.status.timed(timing),
      metered: (radiance) => this.status.meter(radiance),
      idle: () => {
        if (!this.status.settled) this.view.request();
        this.status.invalid(countInvalid(this.view.renderer!.readLinear()));
      },
      busy: (what) => this.busy(what),
      failed: (sentence) => this.notices.fail(sentence),
    });
  }

  private makeParts(): void {
    this.panel = new Panel(byId("panel"), this.store, () => this.home());
    this.wipe = new Wipe(byId("frame"), {
      state: () => this.store.state,
      size: () => this.view.plan?.size ?? [1, 1],
      codes: () => this.view.renderer!.readDisplay(),
      say: (sentence) => this.notices.say(sentence),
      shown: (shown) => {
        byId("server").setAttribute("aria-pressed", `${shown}`);
        this.dismissHint();
      },
    });
    this.camera = new Camera(this.view.canvas, {
      pose: () => this.edited().camera,
      fov: () => this.edited().camera.fov,
      move: (pose) => this.move(pose),
      release: (milliseconds) => this.store.release(milliseconds),
      point: (x, y, twice) => this.point(x, y, twice),
      hover: (at) => this.view.meter(at),
    });
    addTools(this);
    byId("hint").hidden = recall("moved", false);
    this.store.listen(() => this.follow());
    this.link.listen(() => this.manifest && this.takeLink());
  }

  /** The state has changed: show its scene, then draw. */
  private follow(): void {
    const { scene } = this.store.state;
    if (scene === this.name) {
      this.show();
      return;
    }
    this.busy("Loading the scene");
    this.scene(scene).then(
      (preset) => {
        if (this.store.state.scene !== scene) return;
        this.preset = preset;
        this.name = scene;
        this.show();
      },
      (error: unknown) => this.notices.fail(error instanceof Error ? error.message : String(error)),
    );
  }

  private show(): void {
    this.link.write();
    document.title = `${this.preset.title || this.name} · Lightbench`;
    byId("scene-title").textContent = this.preset.title || this.name;
    const thumb = byId<HTMLImageElement>("thumb");
    const source = thumbnail(this.name);
    if (thumb.getAttribute("src") !== source) thumb.src = source;
    thumb.hidden = false;
    this.view.request();
  }

  /** Change to a preset; how it is rendered stays, what was changed in the old scene does not. */
  choose(name: string): void {
    const { scene, settings } = this.store.state;
    if (name === scene) return;
    const kept = Object.entries(settings).filter(([key]) => !key.includes("."));
    this.store.set({ scene: name, settings: Object.fromEntries(kept) });
  }

  /** The camera back to the preset's. */
  home(): void {
    this.camera.fly(resolve(this.manifest, this.preset, {}).scene.camera);
  }

  private async takeLink(): Promise<void> {
    const name = this.link.scene() ?? this.store.state.scene;
    if (!this.manifest.scenes[name]) {
      const known = Object.keys(this.manifest.scenes).join(", ");
      return this.notices.say(`There is no scene '${name}'; there is: ${known}.`);
    }
    const preset = await this.scene(name);
    this.store.set({ scene: name, settings: this.link.settings(this.manifest, preset) });
  }

  private plan(size: Size): Plan {
    return plan(this.manifest, this.preset, this.settings(), size);
  }

  /** Of the scene that is shown: none while another is loading. */
  private settings(): Values {
    return this.store.state.scene === this.name ? this.store.state.settings : {};
  }

  /** The preset with the state's edits; without them where they make no scene. */
  private edited(): Scene {
    try {
      return resolve(this.manifest, this.preset, this.settings()).scene;
    } catch {
      return this.preset;
    }
  }

  private drawn(shown: Plan): void {
    const keys = shown.passes.flatMap((p) => p.batches.flatMap((b) => b.draws.map((d) => d.mesh)));
    const count = keys.reduce((sum, key) => sum + (this.triangles.get(key ?? "") ?? 0), 0);
    this.status.drawn(shown, count);
    this.status.renderer(this.view.renderer!.name);
    const now: Situation = {
      manifest: this.manifest,
      scene: this.edited(),
      preset: this.preset,
      settings: this.settings(),
      plan: shown,
    };
    this.panel.update(now);
    this.summarise(now);
    this.wipe.refresh();
    this.arrive();
    void loadTypesetter();
  }

  /** The choices that make the surface, as the bar shows them. */
  private summarise(now: Situation): void {
    const titles = Object.entries(this.manifest.folders).flatMap(([name, folder]) => {
      const used = tabOf(folder) === "model" && now.plan.settings.includes(folder.setting);
      const file = `${name}/${current(now, folder.setting)}.glsl`;
      return used ? [[now.plan.settings.indexOf(folder.setting), file] as const] : [];
    });
    titles.sort(([a], [b]) => a - b);
    byId("summary").textContent = titles
      .map(([, file]) => this.manifest.files[file]!.meta.title)
      .join(" · ");
  }

  private move(pose: Pose): void {
    const state = this.store.state;
    const edits = { "camera.eye": [...pose.eye], "camera.target": [...pose.target] };
    const settings = trim(this.manifest, this.preset, { ...state.settings, ...edits });
    this.dismissHint();
    this.store.set({ ...state, settings }, "camera");
  }

  /** Said once: whoever has moved the camera knows how. */
  private dismissHint(): void {
    const hint = byId("hint");
    if (!hint.hidden) remember("moved", true);
    hint.hidden = true;
  }

  private point(x: number, y: number, twice: boolean): void {
    const { camera } = this.edited();
    const { width, height } = this.view.canvas;
    const direction = ray(camera, camera.fov, width / height, x, y);
    const hit = pick(this.edited(), camera.eye, direction);
    if (twice && hit) this.camera.fly(this.closeUp(hit));
    else if (twice) this.home();
    else if (hit) this.panel.showMaterial(hit.object.material);
  }

  /** A flat thing is looked at where it was pointed at, a solid one at its middle. */
  private closeUp({ object, point, distance }: Hit): Pose {
    const { camera } = this.edited();
    if (object.shape === "plane") return focus(camera, point, distance);
    const height = object.shape === "cone" ? 0.45 * (object.scale[1] ?? 1) : 0;
    const middle = object.position.map((c, axis) => c + (axis === 1 ? height : 0));
    const size = Math.max(...object.scale) * (object.shape === "sphere" ? 1 : 0.6);
    return focus(
      camera,
      middle,
      (CLOSE * size * Math.tan(Math.PI / 8)) / Math.tan((camera.fov * Math.PI) / 360),
    );
  }

  private scene(name: string): Promise<Scene> {
    let found = this.scenes.get(name);
    if (!found) {
      found = loadScene(name);
      found.catch(() => this.scenes.delete(name));
      this.scenes.set(name, found);
    }
    return found;
  }

  private async mesh(key: string): Promise<Mesh> {
    const mesh = await meshesFrom("data/meshes")(key);
    this.triangles.set(key, mesh.indices.length / 3);
    return mesh;
  }

  private busy(what: string | null): void {
    const progress = byId("progress");
    progress.hidden = what === null;
    progress.setAttribute("aria-valuetext", what ?? "");
  }
}
