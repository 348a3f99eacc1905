// The stability atlas: where a shader function loses its digits, computed on this device.
import "./style/atlas.css";
import { compute, unpack } from "./atlas_gl";
import { Maps, marks } from "./atlas_maps";
import { LOUD, label, RAMP, scale } from "./atlas_scale";
import { LightbenchError } from "./core/errors";
import { type AtlasEntry, loadAtlas, loadAtlasMap } from "./data";
import { openDialog } from "./dialog";
import { make } from "./dom";
import { recall, remember } from "./memory";

const FIRST = "distributions/ggx.glsl distribution";
/** Open the atlas; it lasts until its dialog is closed. */
export function showAtlas(): void {
  new Atlas();
}

class Atlas {
  private readonly functions = make("select", { id: "atlas-function", change: () => this.pick() });
  private readonly x = make("select", { id: "atlas-x", change: () => this.axes("x") });
  private readonly y = make("select", { id: "atlas-y", change: () => this.axes("y") });
  private readonly says = make("p", { class: "says", role: "status" }, "Loading");
  private readonly body = make("div", { class: "maps" });
  private inputs: HTMLElement = make("p", { class: "inputs" });
  private entries: AtlasEntry[] = [];
  private last: [x: string, y: string] = ["", ""];
  private turn = 0;

  constructor() {
    const field = (text: string, select: HTMLSelectElement) =>
      make("label", { for: select.id }, text, select);
    openDialog(
      "Stability atlas",
      "atlas",
      make(
        "p",
        {},
        "How far each shader function is from its exact value, in ULP: steps between neighbouring numbers of the precision, 0.5 is the best there is.",
      ),
      make(
        "div",
        { class: "bar" },
        field("Function", this.functions),
        field("x axis", this.x),
        field("y axis", this.y),
      ),
      this.says,
      this.body,
      this.inputs,
      legend(),
    );
    loadAtlas().then(
      (entries) => this.offer(entries),
      (error: unknown) => this.fail(error),
    );
  }

  private get entry(): AtlasEntry {
    return this.entries[Number(this.functions.value)]!;
  }

  private offer(entries: AtlasEntry[]): void {
    this.entries = entries;
    const groups = new Map<string, HTMLOptGroupElement>();
    for (const [index, { group, title, function: name, file }] of entries.entries()) {
      const option = make("option", { value: index }, `${title}: ${name}`);
      if (`${file} ${name}` === recall("atlas", FIRST)) option.selected = true;
      if (!groups.has(group)) groups.set(group, make("optgroup", { label: group }));
      groups.get(group)!.append(option);
    }
    this.functions.append(...groups.values());
    if (entries.length) this.pick();
    else this.says.textContent = "The shader folder has no function to map.";
  }

  /** Another function: its usual axes. */
  private pick(): void {
    const { inputs, axes, file, function: name } = this.entry;
    remember("atlas", `${file} ${name}`);
    for (const select of [this.x, this.y])
      select.replaceChildren(...inputs.map((i) => make("option", { value: i.name }, label(i))));
    [this.x.value, this.y.value] = axes[0]!;
    void this.show();
  }

  /** One axis is chosen; the other takes its place where both would be the same. */
  private axes(changed: "x" | "y"): void {
    const [x, y] = this.last;
    if (this.x.value === this.y.value) {
      if (changed === "x") this.y.value = x;
      else this.x.value = y;
    }
    void this.show();
  }

  private async show(): Promise<void> {
    this.turn += 1;
    const { turn, entry } = this;
    this.last = [this.x.value, this.y.value];
    this.body.setAttribute("aria-busy", "true");
    try {
      const sweep = unpack(await loadAtlasMap(entry.file, entry.function, ...this.last));
      if (turn !== this.turn) return;
      const { panels, renderer } = await compute(sweep);
      if (turn !== this.turn) return;
      const maps = new Maps(sweep, panels);
      this.body.replaceChildren(...maps.figures);
      this.inputs.replaceWith(maps.inputs);
      this.inputs = maps.inputs;
      const exact = panels.every((panel) => panel.exact)
        ? ""
        : " No exact form is known: half precision is compared with float32.";
      const note = sweep.note ? ` ${sweep.note}` : "";
      this.says.textContent = `${sweep.size} × ${sweep.size} points, computed on ${renderer}.${exact}${note}`;
      this.says.classList.remove("failure");
    } catch (error) {
      if (turn === this.turn) this.fail(error);
    }
    if (turn === this.turn) this.body.removeAttribute("aria-busy");
  }

  private fail(error: unknown): void {
    this.body.replaceChildren();
    this.inputs.textContent = "";
    this.says.textContent = error instanceof Error ? error.message : String(error);
    this.says.classList.add("failure");
    if (!(error instanceof LightbenchError)) throw error;
  }
}

const SCALES = [
  { name: "half", bits: 11 },
  { name: "float32", bits: 24 },
].map((each) => ({ ...each, tiny: 0, negligible: 0, half: false, full: 2 ** (each.bits - 1) }));

function legend(): HTMLElement {
  const [above, below] = SCALES.map((precision) => [
    make("span", { class: "name" }, `ULP in ${precision.name}`),
    marks("x", scale(precision)),
  ]);
  const ramp = make("div", { class: "ramp", style: `background:linear-gradient(90deg,${RAMP})` });
  const loud = Object.values(LOUD).map(([color, name]) =>
    make("li", {}, make("i", { style: `background:${color}` }), name),
  );
  return make(
    "div",
    { class: "legend" },
    make("div", { class: "scales" }, ...above!, make("span"), ramp, ...below!),
    make("ul", {}, ...loud),
  );
}
