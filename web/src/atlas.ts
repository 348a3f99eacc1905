// The stability atlas: where a shader function loses its digits, computed on this device.
import "./style/atlas.css";
import { type Axis, compute, KINDS, type Panel, type Sweep, unpack } from "./atlas_gl";
import {
  band,
  LOUD,
  label,
  number,
  pixels,
  RAMP,
  scale,
  summary,
  type Tick,
  ticks,
} from "./atlas_scale";
import { LightbenchError } from "./core/errors";
import { type AtlasEntry, loadAtlas, loadAtlasMap } from "./data";
import { openDialog } from "./dialog";
import { make } from "./dom";
import { recall, remember } from "./memory";

const FIRST = "distributions/ggx.glsl distribution";
const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowDown: [0, -1],
  ArrowUp: [0, 1],
};

/** Open the atlas; it lasts until its dialog is closed. */
export function showAtlas(): void {
  new Atlas();
}

/** One map on the page, and what it says of a point. */
interface Shown {
  panel: Panel;
  cursor: HTMLElement;
  readout: HTMLElement;
}

class Atlas {
  private readonly functions = make("select", { id: "atlas-function", change: () => this.pick() });
  private readonly x = make("select", { id: "atlas-x", change: () => this.axes("x") });
  private readonly y = make("select", { id: "atlas-y", change: () => this.axes("y") });
  private readonly says = make("p", { class: "says", role: "status" }, "Loading");
  private readonly inputs = make("p", { class: "inputs" });
  private readonly body = make("div", { class: "maps" });
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
      this.draw(sweep, panels);
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

  private draw(sweep: Sweep, panels: Panel[]): void {
    const shown: Shown[] = [];
    let place: [number, number] = [sweep.size >> 1, sweep.size >> 1];
    const point = (x: number, y: number) => {
      const inside = (value: number) => Math.min(Math.max(value, 0), sweep.size - 1);
      place = [inside(x), inside(y)];
      this.point(sweep, shown, place);
    };
    const figures = panels.map((panel, index) => {
      const form = !panels.some((each) => each.textbook)
        ? ""
        : panel.textbook
          ? "Textbook, "
          : "Ours, ";
      const name = `${form}${panel.precision.name}`;
      const canvas = make("canvas", {
        width: sweep.size,
        height: sweep.size,
        tabindex: 0,
        role: "img",
        "aria-label": `Map of ${name}; arrow keys read its points`,
        "aria-describedby": `atlas-summary-${index}`,
        pointermove: (event) => {
          const { offsetX, offsetY } = event as PointerEvent;
          const cell = canvas.clientWidth / sweep.size;
          const row = Math.floor((offsetY * sweep.size) / canvas.clientHeight);
          point(Math.floor(offsetX / cell), sweep.size - 1 - row);
        },
        focus: () => point(...place),
        keydown: (event) => {
          const way = ARROWS[(event as KeyboardEvent).key];
          if (!way) return;
          event.preventDefault();
          const far = (event as KeyboardEvent).shiftKey ? 10 : 1;
          point(place[0] + far * way[0], place[1] + far * way[1]);
        },
      });
      canvas.getContext("2d")!.putImageData(pixels(panel, sweep.size), 0, 0);
      const cursor = make("i", { class: "cursor", hidden: true });
      const readout = make("p", { class: "readout" });
      shown.push({ panel, cursor, readout });
      return make(
        "figure",
        { "data-file": panel.file, "data-precision": panel.precision.name },
        make("figcaption", {}, name),
        make(
          "div",
          { class: "plot" },
          make("span", { class: "label y" }, label(sweep.y)),
          marks("y", ticks(sweep.y)),
          make("div", { class: "map" }, canvas, ...zeros(sweep.x, sweep.y), cursor),
          marks("x", ticks(sweep.x)),
          make("span", { class: "label x" }, label(sweep.x)),
        ),
        make("p", { class: "summary", id: `atlas-summary-${index}` }, summary(panel)),
        readout,
      );
    });
    this.body.replaceChildren(...figures);
    const fixed = sweep.fixed.map((input) => spoken(input, input.at));
    this.inputs.textContent = fixed.length
      ? `Fixed: ${fixed.join(", ")}. Point at a map to read its values.`
      : "Point at a map to read its values.";
  }

  private point(sweep: Sweep, shown: readonly Shown[], [x, y]: [number, number]): void {
    const at = y * sweep.size + x;
    for (const { panel, cursor, readout } of shown) {
      const { components } = panel;
      const take = (values: Float32Array | Float64Array) =>
        [...values.subarray(at * components, (at + 1) * components)]
          .map((value) => number(value, 6))
          .join(", ");
      const kind = KINDS[panel.kind[at]!]!;
      const error = kind === "finite" ? `${number(panel.ulp[at]!, 3)} ULP` : LOUD[kind][1];
      readout.textContent = `${take(panel.got)}; truth ${take(panel.want)}; ${error}`;
      cursor.hidden = false;
      cursor.style.left = `${(100 * (x + 0.5)) / sweep.size}%`;
      cursor.style.bottom = `${(100 * (y + 0.5)) / sweep.size}%`;
    }
    this.inputs.textContent = [
      spoken(sweep.x, sweep.x.values[x]!),
      spoken(sweep.y, sweep.y.values[y]!),
      ...sweep.fixed.map((input) => spoken(input, input.at)),
    ].join(", ");
  }
}

/** An input with its value. */
function spoken(input: Pick<Axis, "label" | "unit">, value: number): string {
  return `${input.label} ${number(value)}${input.unit ? `\u202f${input.unit}` : ""}`;
}

function marks(side: string, found: readonly Tick[]): HTMLElement {
  const way = side === "y" ? "bottom" : "left";
  return make(
    "div",
    { class: `ticks ${side}`, "aria-hidden": "true" },
    ...found.map(({ at, text }) => make("span", { style: `${way}:${100 * at}%` }, text)),
  );
}

/** Lines that part the exact zeros from the rest. */
function zeros(x: Axis, y: Axis): HTMLElement[] {
  const line = (way: string, at: number) =>
    at ? [make("i", { class: `zero ${way}`, style: `${way}:${100 * at}%` })] : [];
  return [...line("left", band(x)), ...line("bottom", band(y))];
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
