// The maps of one sweep on the page, and the point that is read in all of them.
import { KINDS, type Panel } from "./atlas_error";
import type { Axis, Sweep } from "./atlas_gl";
import { band, LOUD, label, number, pixels, summary, type Tick, ticks } from "./atlas_scale";
import { make } from "./dom";

const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowDown: [0, -1],
  ArrowUp: [0, 1],
};

/** One map on the page, and what it says of a point. */
interface Shown {
  panel: Panel;
  cursor: HTMLElement;
  readout: HTMLElement;
}

/** A figure for each panel; `inputs` says where the point is that they read. */
export class Maps {
  readonly figures: HTMLElement[];
  readonly inputs: HTMLElement;
  private readonly shown: Shown[];
  private place: [x: number, y: number];

  constructor(
    private readonly sweep: Sweep,
    panels: readonly Panel[],
  ) {
    this.place = [sweep.size >> 1, sweep.size >> 1];
    this.shown = panels.map((panel) => ({
      panel,
      cursor: make("i", { class: "cursor", hidden: true }),
      readout: make("p", { class: "readout" }),
    }));
    const pair = panels.some((panel) => panel.textbook);
    this.figures = this.shown.map((each, index) => this.figure(each, index, pair));
    const fixed = this.fixed();
    const known = fixed.length ? `Fixed: ${fixed.join(", ")}. ` : "";
    this.inputs = make("p", { class: "inputs" }, `${known}Point at a map to read its values.`);
  }

  private figure({ panel, cursor, readout }: Shown, index: number, pair: boolean): HTMLElement {
    const { x, y } = this.sweep;
    const form = pair ? (panel.textbook ? "Textbook, " : "Ours, ") : "";
    const name = `${form}${panel.precision.name}`;
    const [words, read] = [`atlas-summary-${index}`, `atlas-readout-${index}`];
    readout.id = read;
    const canvas = this.canvas(panel, {
      "aria-label": `Map of ${name}; arrow keys read its points`,
      "aria-describedby": `${words} ${read}`,
    });
    return make(
      "figure",
      { "data-file": panel.file, "data-precision": panel.precision.name },
      make("figcaption", {}, name),
      make(
        "div",
        { class: "plot" },
        make("span", { class: "label y" }, label(y)),
        marks("y", ticks(y)),
        make("div", { class: "map" }, canvas, ...zeros(x, y), cursor),
        marks("x", ticks(x)),
        make("span", { class: "label x" }, label(x)),
      ),
      make("p", { class: "summary", id: words }, summary(panel)),
      readout,
    );
  }

  private canvas(panel: Panel, names: Record<string, string>): HTMLCanvasElement {
    const { size } = this.sweep;
    const canvas = make("canvas", {
      width: size,
      height: size,
      tabindex: 0,
      role: "img",
      ...names,
      pointermove: (event) => {
        const { offsetX, offsetY } = event as PointerEvent;
        const row = Math.floor((offsetY * size) / canvas.clientHeight);
        this.read(Math.floor((offsetX * size) / canvas.clientWidth), size - 1 - row);
      },
      focus: () => this.read(...this.place),
      keydown: (event) => this.key(event as KeyboardEvent),
    });
    canvas.getContext("2d")!.putImageData(pixels(panel, size), 0, 0);
    return canvas;
  }

  private key(event: KeyboardEvent): void {
    const way = ARROWS[event.key];
    if (!way) return;
    event.preventDefault();
    const far = event.shiftKey ? 10 : 1;
    this.read(this.place[0] + far * way[0], this.place[1] + far * way[1]);
  }

  /** Say in every map what is at a point. */
  private read(column: number, row: number): void {
    const { size, x, y } = this.sweep;
    const inside = (value: number) => Math.min(Math.max(value, 0), size - 1);
    this.place = [inside(column), inside(row)];
    const [left, bottom] = this.place;
    for (const { panel, cursor, readout } of this.shown) {
      readout.textContent = at(panel, bottom * size + left);
      cursor.hidden = false;
      cursor.style.left = `${(100 * (left + 0.5)) / size}%`;
      cursor.style.bottom = `${(100 * (bottom + 0.5)) / size}%`;
    }
    const swept = [spoken(x, x.values[left]!), spoken(y, y.values[bottom]!)];
    this.inputs.textContent = [...swept, ...this.fixed()].join(", ");
  }

  private fixed(): string[] {
    return this.sweep.fixed.map((input) => spoken(input, input.at));
  }
}

/** What a point is: value, truth, error. */
function at(panel: Panel, point: number): string {
  const { components } = panel;
  const take = (values: Float32Array | Float64Array) =>
    [...values.subarray(point * components, (point + 1) * components)]
      .map((value) => number(value, 6))
      .join(", ");
  const kind = KINDS[panel.kind[point]!]!;
  const error = kind === "finite" ? `${number(panel.ulp[point]!, 3)} ULP` : LOUD[kind][1];
  return `${take(panel.got)}; truth ${take(panel.want)}; ${error}`;
}

/** An input with its value. */
function spoken(input: Pick<Axis, "label" | "unit">, value: number): string {
  return `${input.label} ${number(value)}${input.unit ? `\u202f${input.unit}` : ""}`;
}

/** The marks of an axis or a scale. */
export function marks(side: string, found: readonly Tick[]): HTMLElement {
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
