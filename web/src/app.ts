// The page's parts and how they hear of each other: state to picture, picture to panel.
import { Busy } from "./busy";
import { tabOf } from "./controls";
import { withUniforms } from "./core/constants";
import { LightbenchError } from "./core/errors";
import { type Mesh, meshesFrom } from "./core/mesh";
import { plan } from "./core/plan";
import { resolve } from "./core/settings";
import { hierarchiesFrom } from "./core/tables";
import { imagesFrom } from "./core/textures";
import type { Manifest, Plan, Scene } from "./core/types";
import { loadManifest } from "./data";
import { byId } from "./dom";
import { acceptDrops, type Take } from "./drop";
import type { Values } from "./fields";
import { loadTypesetter } from "./formula";
import { current, type Situation } from "./groups";
import { countInvalid } from "./invalid";
import { Link } from "./link";
import { Notices } from "./notices";
import { Opening } from "./opening";
import { Panel } from "./panel";
import { makeProbe } from "./probe";
import { Scenes } from "./scenes";
import { gone } from "./server";
import { miniature } from "./snapshot";
import { Status } from "./status";
import { Store } from "./store";
import { addTools } from "./tools";
import { type Size, View } from "./view";
import { Viewpoint } from "./viewpoint";
import { LeftViews } from "./views";
import { Wipe } from "./wipe";

const DEFAULT_SCENE = "box-room";

export class App {
  readonly busy = new Busy(byId("progress"));
  readonly notices = new Notices(byId("notices"));
  readonly status = new Status(byId("line"));
  readonly store = new Store({ scene: "", settings: {} });
  readonly link = new Link(this.store, (sentence) => this.notices.say(sentence));
  manifest!: Manifest;
  view!: View;
  wipe!: Wipe;
  panel!: Panel;
  viewpoint!: Viewpoint;
  private readonly left = new LeftViews();
  private preset!: Scene;
  /** The preset's name; the state's may be ahead of it while that one loads. */
  private name = "";
  readonly scenes = new Scenes();
  private readonly meshes = new Map<string, Mesh>();
  private readonly assets = {
    mesh: (key: string) => this.mesh(key),
    image: imagesFrom("data/textures"),
    hierarchy: hierarchiesFrom("data/hierarchies"),
  };
  private readonly opening = new Opening({
    busy: (what) => this.busy.say(what, "model"),
    opened: (file, scene) => this.opened(file, scene),
    refused: (reason) => this.notices.say(reason, 0, "model"),
  });
  /** Open the model among these files. */
  readonly open: Take = (files) => void this.opening.take(files);
  private readonly loading = loadManifest();
  /** Whether what is shown has changed just now, and may be changing. */
  private moving = false;
  private arrive!: () => void;
  /** There is no first picture, for this reason. */
  refuse!: (reason: unknown) => void;
  private readonly ready = new Promise<void>((done, refused) => {
    this.arrive = done;
    this.refuse = refused;
  });

  constructor() {
    this.ready.catch(() => {}); // the page itself says why; only who waits hears it from here
  }

  /** Resolves once everything is loaded and the first picture is under way. */
  async start(): Promise<void> {
    window.lightbench = makeProbe({
      manifest: this.loading,
      scene: (name) => this.scenes.load(name),
      assets: this.assets,
      link: () => this.link.flush(),
      shown: () => this.view?.plan ?? null,
      runs: () => this.view?.renderer?.runs ?? {},
      ready: this.ready,
    });
    this.busy.say("Loading");
    const asked = this.link.scene() ?? DEFAULT_SCENE;
    const early = this.scenes.load(asked).catch(() => null); // beside the manifest, not after it
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
    this.preset = (name === asked && (await early)) || (await this.scenes.load(name));
    this.name = name;
    this.store.start({ scene: name, settings: this.link.settings(this.manifest, this.preset) });
    this.makeParts();
    this.show();
    this.view.start();
  }

  private makeView(): void {
    this.view = new View(byId<HTMLCanvasElement>("picture"), this.assets, {
      plan: (size) => this.plan(size),
      drawn: (shown) => this.drawn(shown),
      timed: (timing) => this.status.timed(timing),
      metered: (radiance) => this.status.meter(radiance),
      idle: () => this.idle(),
      busy: (what) => this.busy.say(what),
      failed: (sentence) => this.failed(sentence && this.explained(sentence)),
    });
  }

  private makeParts(): void {
    this.panel = new Panel(byId("panel"), this.store, {
      current: () => this.viewpoint.current(),
      show: (name) => this.viewpoint.show(name),
    });
    this.wipe = new Wipe(byId("frame"), {
      state: () => this.store.state,
      sent: () => this.scenes.model(this.store.state.scene)?.scene ?? null,
      size: () => this.view.plan?.size ?? [1, 1],
      codes: () => this.view.renderer!.readDisplay(),
      say: (sentence) => this.notices.say(sentence),
      shown: (shown) => {
        byId("server").setAttribute("aria-pressed", `${shown}`);
        this.viewpoint.dismissHint();
      },
    });
    this.viewpoint = new Viewpoint(this.view.canvas, this.store, {
      manifest: () => this.manifest,
      preset: () => this.preset,
      scene: () => this.edited(),
      mesh: (key) => this.meshes.get(key),
      loaded: () => this.store.state.scene === this.name,
      hover: (at) => this.view.meter(at),
      pointed: (material) => this.panel.showMaterial(material),
    });
    addTools(this);
    acceptDrops(this.open);
    this.store.listen(() => this.follow());
    this.link.listen(() => this.manifest && this.takeLink());
  }

  /** The file of the model that is shown; null for a preset. */
  get file(): string | null {
    return this.scenes.model(this.store.state.scene)?.file ?? null;
  }

  /** The state has changed: show its scene, then draw. */
  private follow(): void {
    const { scene } = this.store.state;
    if (scene === this.name) {
      this.moving = true;
      this.show();
      return;
    }
    this.moving = false;
    this.busy.say("Loading the scene");
    this.viewpoint.stop();
    this.scenes.load(scene).then(
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
    this.showThumb();
    this.view.request();
  }

  private showThumb(): void {
    const thumb = byId<HTMLImageElement>("thumb");
    const source = this.scenes.thumbnail(this.name);
    thumb.hidden = source === null;
    if (source && thumb.getAttribute("src") !== source) thumb.src = source;
  }

  /** A model has arrived: show it, under its own settings where it has some. */
  private opened(file: string, scene: Scene): void {
    this.notices.say(`${file}: ${scene.about}`, 12, "model");
    const name = this.scenes.open(file, scene);
    if (name === this.store.state.scene) this.view.request();
    else this.choose(name, Object.keys(scene.settings));
  }

  /**
   * Change to a scene; how it is rendered stays, but for some settings, and each has the view it was
   * left with.
   */
  choose(name: string, but: readonly string[] = []): void {
    const { scene, settings } = this.store.state;
    if (name === scene) return;
    const kept = Object.entries(settings).filter(
      ([key]) => !key.includes(".") && !but.includes(key),
    );
    this.left.leave(this.store.state);
    const seen = this.left.of(name);
    this.store.set({ scene: name, settings: { ...Object.fromEntries(kept), ...seen } });
  }

  private async takeLink(): Promise<void> {
    const name = this.link.scene() ?? this.link.preset;
    if (!this.manifest.scenes[name]) {
      const known = Object.keys(this.manifest.scenes).join(", ");
      return this.notices.say(`There is no scene '${name}'; there is: ${known}.`);
    }
    const preset = await this.scenes.load(name);
    this.left.leave(this.store.state);
    this.store.set({ scene: name, settings: this.link.settings(this.manifest, preset) });
  }

  private plan(size: Size): Plan {
    const settings = this.settings();
    const moved = this.moving ? withUniforms(this.manifest, settings) : settings;
    return plan(this.manifest, this.preset, moved, size);
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
    const count = keys.reduce((sum, key) => sum + this.trianglesOf(key ?? ""), 0);
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
    this.viewpoint.follow();
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

  /** Nothing has changed for a moment. */
  private idle(): void {
    const { plan, renderer } = this.view;
    this.status.invalid(countInvalid(renderer!.readLinear(), plan!.signed));
    // After the pixels were waited for: what the frame took has gone by.
    if (this.moving || !this.status.settled) this.view.request();
    this.moving = false;
    const model = this.scenes.model(this.name);
    if (!model || model.thumb || this.store.state.scene !== this.name) return;
    model.thumb = miniature(renderer!.readDisplay(), plan!.size);
    this.showThumb();
  }

  private failed(sentence: string | null): void {
    this.notices.fail(sentence);
    // Without a renderer the context is lost, and comes back.
    if (sentence && this.view.renderer) this.refuse(new LightbenchError(sentence));
  }

  /** What the server no longer has of a model is said as what to do about it. */
  private explained(sentence: string): string {
    const { file } = this;
    return file && sentence.endsWith("(status 404)") ? gone(file) : sentence;
  }

  private trianglesOf(key: string): number {
    return (this.meshes.get(key)?.indices.length ?? 0) / 3;
  }

  private async mesh(key: string): Promise<Mesh> {
    const mesh = await meshesFrom("data/meshes")(key);
    this.meshes.set(key, mesh);
    return mesh;
  }
}
