// The panel: tabs, folds and rows, built from their description; values follow the state.
import { GUI } from "lil-gui";
import { Access, put } from "./access";
import { choiceCard } from "./card";
import { toHex } from "./color";
import type { Control } from "./control";
import { describe } from "./controls";
import type { Scene } from "./core/types";
import { texture } from "./data";
import { make } from "./dom";
import type { Formula } from "./formula";
import { type Group, type Situation, TABS, type Tab } from "./groups";
import { recall, remember } from "./memory";
import { triple } from "./parts";
import { addRow, type Row } from "./row";
import type { Store } from "./store";
import { symbolOf } from "./symbols";
import { Tabs } from "./tabs";
import { addViews, type ViewMenu } from "./views";

interface Page {
  gui: GUI;
  key: string;
  rows: Row[];
  formulas: Formula[];
}

const MOVING = ["camera.eye", "camera.target"];
// What of a material stands beside the models, where it is in use, and what these read themselves.
const BASIC = ["base_color", "metalness", "roughness"];
// More folds than this stand closer together.
const MANY = 10;

export class Panel {
  private readonly pages = new Map<Tab, Page>();
  private readonly tabs: Tabs;
  private now: Situation | null = null;
  private held = false;
  /** What the rows were made for. */
  private made: { preset: Scene | null; facts: string } = { preset: null, facts: "" };
  /** The material that was pointed at. */
  private pointed: string | null = null;

  constructor(
    private readonly root: HTMLElement,
    private readonly store: Store,
    private readonly views: ViewMenu,
  ) {
    this.tabs = new Tabs(root, () => {
      this.follow();
      this.fit();
    });
    for (const [tab, container] of this.tabs.pages) {
      const gui = new GUI({ container, title: TABS[tab], touchStyles: 0 });
      this.pages.set(tab, { gui, key: "", rows: [], formulas: [] });
    }
    root.addEventListener("pointerdown", ({ target }) => {
      this.held = target instanceof HTMLInputElement && target.type === "range";
    });
    for (const end of ["pointerup", "pointercancel"]) {
      window.addEventListener(end, () => this.release());
    }
    new ResizeObserver(() => this.fit()).observe(root);
  }

  /** Follow a new plan; rows are rebuilt only where the set of controls is another. */
  update(now: Situation): void {
    this.now = now;
    this.follow();
  }

  /** Bring forward the material of an object that was pointed at. */
  showMaterial(material: string): void {
    this.pointed = material;
    const id = `materials.${material}`;
    if (this.tabs.selected === "material") {
      remember(`fold:${id}`, true);
      this.pages.get("material")!.key = "";
    }
    this.made.preset = null;
    this.rebuild();
    if (this.tabs.selected !== "material") return;
    this.root.querySelector(`[data-group="${id}"]`)?.scrollIntoView({ block: "nearest" });
  }

  private follow(): void {
    if (!this.now) return;
    if (!this.held) this.rebuild();
    for (const row of this.pages.get(this.tabs.selected)!.rows) row.update();
  }

  private release(): void {
    if (!this.held) return;
    this.held = false;
    this.follow();
  }

  private fit(): void {
    for (const formula of this.pages.get(this.tabs.selected)!.formulas) formula.fit();
  }

  private rebuild(): void {
    if (!this.now || this.isMade(this.now)) return;
    const groups = this.arranged(describe(this.now));
    for (const [tab, page] of this.pages) {
      const own = groups.filter((group) => group.tab === tab);
      const facts = own.map((g) => [g.id, g.title, g.about, g.choice?.chosen, g.controls, g.views]);
      const key = JSON.stringify(facts);
      if (key === page.key) continue;
      page.key = key;
      this.tabs.offer(tab, own.length > 0);
      this.build(page, own);
    }
    this.tabs.settle();
  }

  /** Whether the rows are those for this: where the camera stands changes none of them. */
  private isMade({ preset, settings, plan }: Situation): boolean {
    const still = Object.entries(settings).filter(([name]) => !MOVING.includes(name));
    const facts = JSON.stringify([still, plan.settings, plan.files, Object.keys(plan.textures)]);
    const before = this.made;
    this.made = { preset, facts };
    return before.preset === preset && before.facts === facts;
  }

  /** One surface also leads the Model tab, so that its sliders stand beside the formulas. */
  private arranged(groups: Group[]): Group[] {
    const find = (name: string | null | undefined) =>
      groups.find((group) => group.id === `materials.${name}`);
    const surface = find(this.pointed) ?? find(this.prominent());
    if (!surface) return groups;
    const fields = new Set([
      ...BASIC,
      ...groups.flatMap((g) => (g.tab === "model" ? (g.choice?.meta.material ?? []) : [])),
    ]);
    const controls = surface.controls.filter(({ name }) => fields.has(name.split(".").at(-1)!));
    const title = `Material: ${surface.title}`;
    return [{ ...surface, id: "surface", tab: "model", title, controls }, ...groups];
  }

  /** The material of the thing that shows most of what a model does: a sphere, else no wall. */
  private prominent(): string | undefined {
    const things = Object.values(this.now?.scene.objects ?? {});
    const round = things.find((thing) => thing.shape === "sphere");
    return (round ?? things.find((thing) => thing.shape !== "plane") ?? things[0])?.material;
  }

  private build(page: Page, groups: Group[]): void {
    const focused = (document.activeElement as HTMLElement | null)?.dataset.control;
    for (const child of [...page.gui.children]) child.destroy();
    page.gui.$children.replaceChildren();
    page.rows = [];
    page.formulas = [];
    const symbols = [...new Set(groups.flatMap((g) => g.controls.map((c) => symbolOf(c.name))))];
    page.gui.domElement.classList.toggle("many", groups.length > MANY);
    for (const group of groups) this.addGroup(page, group, symbols, groups);
    if (!focused) return;
    page.gui.domElement.querySelector<HTMLElement>(`[data-control="${focused}"]`)?.focus();
  }

  private addGroup(page: Page, group: Group, symbols: string[], all: Group[]): void {
    const fold = page.gui.addFolder(group.title);
    fold.domElement.dataset.group = group.id;
    if (group.choice) this.addCard(page, fold, group, symbols);
    else if (group.about) fold.$children.append(make("p", { class: "about" }, group.about));
    if (group.views?.length) page.rows.push(addViews(fold, group.views, this.views));
    for (const control of group.controls)
      page.rows.push(this.addControl(page, fold, control, group.id));
    if (group.id === "camera")
      fold.add({ home: () => this.views.show("") }, "home").name("Back to the scene's view");
    this.keepFold(fold, group, all);
  }

  private addCard(page: Page, fold: GUI, group: Group, symbols: string[]): void {
    const card = choiceCard(group, symbols, (value) => {
      put(this.store, this.situation(), group.id, value);
      this.store.release();
    });
    fold.$title.after(card.select);
    fold.$children.append(...card.content);
    if (card.formula) page.formulas.push(card.formula);
  }

  private addControl(page: Page, fold: GUI, control: Control, group: string): Row {
    const access = new Access(control, this.store, () => this.situation());
    const light = (symbol: string | null) => {
      for (const formula of page.formulas) formula.light(symbol);
    };
    const id = `${group}/${control.name}/${control.part ?? ""}`;
    const row = addRow(fold, control, access, { id, light });
    const isFirst = !fold.$title.querySelector(".swatch");
    if (control.kind !== "color" || !isFirst || !control.name.includes(".")) return row;
    const swatch = make("span", { class: "swatch", "aria-hidden": "true" });
    fold.$title.append(swatch);
    const update = () => {
      row.update();
      swatch.style.backgroundColor = `#${toHex(triple(access.value()))}`;
      const image = this.imageOf(control.name);
      swatch.style.backgroundImage = image ? `url("${image}")` : "";
    };
    update();
    return { update };
  }

  /** Address of the image that is multiplied with a colour. */
  private imageOf(name: string): string | null {
    const [group, material = "", slot = ""] = name.split(".");
    const { scene } = this.now!;
    const map = group === "materials" ? scene.materials[material]?.maps[slot] : undefined;
    return map ? texture(scene.textures[map.texture]!.image) : null;
  }

  /** Of several lights, materials or parts one stands open; a choice without a choice stays closed. */
  private keepFold(fold: GUI, group: Group, all: Group[]): void {
    const many = /^(lights|materials|parts)\./.test(group.id);
    const chosen =
      group.tab === "material" ? `materials.${this.pointed ?? this.prominent()}` : all[0]?.id;
    const idle = group.choice?.options.length === 1 && !group.controls.length;
    const open = many ? group.id === chosen : !idle;
    if (!recall(`fold:${group.id}`, open)) fold.close();
    fold.onOpenClose((changed) => {
      if (changed === fold) remember(`fold:${group.id}`, !fold._closed);
      this.fit();
    });
  }

  private situation(): Situation {
    return { ...this.now!, settings: this.store.state.settings };
  }
}
