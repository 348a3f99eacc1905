// The display's gamma: measured with a meter or matched by eye, fitted, and put to use.
import "./style/calibration.css";
import { CalibrationPlot } from "./calibration_plot";
import { LightbenchError } from "./core/errors";
import { type Fit, fitGamma, type Measured } from "./core/gamma";
import { openDialog } from "./dialog";
import { make } from "./dom";
import { recall, remember } from "./memory";
import { shorten } from "./number";
import { Pixels, patch, showChart } from "./pixels";

// The codes of the preset lab/calibration-chart.
const LEVELS = [0, 63, 127, 191, 255];
const WHITE = 255;
// Quarters of the lines that are white beside a patch.
const QUARTERS = [1, 2, 3];

type Way = "meter" | "eye";
const TO_DO: Record<Way, string> = {
  meter: "type the luminances of white and of a level or more",
  eye: "move a slider until its patch is gone",
};

/** What the page does with the gamma that was found. */
export interface Use {
  /** The gammas that the picture can be encoded for. */
  range: readonly [low: number, high: number];
  use(gamma: number): void;
}

/** What was typed and matched, kept between visits: the display is the same. */
interface Kept {
  way: Way;
  luminances: Record<number, string>;
  patches: Record<number, number>;
}

/** Open the calibration; it lasts until its dialog is closed. */
export function showCalibration(use: Use): void {
  new Calibration(use);
}

class Calibration {
  private readonly kept = recall<Kept>("display", { way: "meter", luminances: {}, patches: {} });
  private readonly says = make("p", { class: "says", role: "status" });
  private readonly apply = make("button", {
    type: "button",
    class: "apply",
    click: () => this.put(),
  });
  private readonly plot = new CalibrationPlot();
  private readonly cells = new Map<number, [measured: HTMLElement, fitted: HTMLElement]>();
  private readonly sections: Record<Way, HTMLElement> = {
    meter: this.meter(),
    eye: this.eye(),
  };
  private found: Fit | null = null;

  constructor(private readonly use: Use) {
    openDialog(
      "Display gamma",
      "calibration",
      make(
        "p",
        {},
        "A level x of the display's white shines with about x^γ of white's light. The γ of this display, screen settings and system included, is measured here; the transfer “Gamma” then undoes it.",
      ),
      make(
        "fieldset",
        {},
        make("legend", {}, "Measured"),
        this.way("meter", "with a luminance meter"),
        this.way("eye", "by eye"),
      ),
      this.sections.meter,
      this.sections.eye,
      this.says,
      this.plot.element,
      this.apply,
    );
    this.update();
  }

  private way(value: Way, text: string): HTMLElement {
    const change = () => {
      this.kept.way = value;
      this.update();
    };
    const checked = this.kept.way === value;
    return make("label", {}, make("input", { type: "radio", name: "way", checked, change }), text);
  }

  private meter(): HTMLElement {
    const head = ["Level", "Luminance", "Of white", "x^γ"].map((text) =>
      make("th", { scope: "col" }, text),
    );
    return make(
      "section",
      {},
      make(
        "p",
        {},
        "Show the chart in a dark room, measure the middle of each bar, and type what the meter says, in any unit. White and one level between are the least.",
      ),
      make("button", { type: "button", click: () => showChart(LEVELS) }, "Show the chart"),
      make(
        "table",
        {},
        make("thead", {}, make("tr", {}, ...head)),
        make("tbody", {}, ...LEVELS.map((level) => this.row(level))),
      ),
    );
  }

  private row(level: number): HTMLElement {
    const cells = [make("td"), make("td")] as const;
    this.cells.set(level, [...cells]);
    const field = make("input", {
      type: "text",
      inputmode: "decimal",
      autocomplete: "off",
      "aria-label": `Luminance of level ${level}`,
      value: this.kept.luminances[level] ?? "",
      input: () => {
        this.kept.luminances[level] = field.value;
        this.update();
      },
    });
    const swatch = make("i", { style: `background:rgb(${level} ${level} ${level})` });
    const name = make("th", { scope: "row" }, make("span", {}, swatch, `${level}`));
    return make("tr", {}, name, make("td", {}, field), ...cells);
  }

  private eye(): HTMLElement {
    return make(
      "section",
      {},
      make(
        "p",
        {},
        "From so far away that the lines melt into a grey, or with half-closed eyes, move each slider until the patch in the middle is gone. One of them is enough; the browser's zoom should be 100 %.",
      ),
      make("div", { class: "patches" }, ...QUARTERS.map((quarters) => this.match(quarters))),
    );
  }

  private match(quarters: number): HTMLElement {
    const share = quarters / 4;
    const value = this.kept.patches[quarters] ?? Math.round(share * WHITE);
    const name = { 1: "A quarter", 2: "Half", 3: "Three quarters" }[quarters];
    const slider = make("input", { type: "range", min: 1, max: WHITE - 1, value });
    const label = `Lines of which ${name!.toLowerCase()} are white, with a grey patch in the middle`;
    const pixels = new Pixels(
      label,
      patch(quarters, () => slider.valueAsNumber),
    );
    const text = make("span", { class: "matched" }, "not matched yet");
    const show = () => {
      const level = slider.valueAsNumber;
      const gamma = Math.log(share) / Math.log(level / WHITE);
      text.textContent = `level ${level}, γ ${gamma.toFixed(2)}`;
      slider.setAttribute("aria-valuetext", text.textContent);
    };
    if (quarters in this.kept.patches) show();
    slider.addEventListener("input", () => {
      this.kept.patches[quarters] = slider.valueAsNumber;
      pixels.draw();
      show();
      this.update();
    });
    return make(
      "figure",
      {},
      pixels.canvas,
      make("figcaption", {}, make("label", {}, `${name} of white`, slider), text),
    );
  }

  /** What there is to fit: fields left empty are levels not measured. */
  private measured(): Measured[] {
    const { way, luminances, patches } = this.kept;
    if (way === "eye") {
      const matched = Object.entries(patches).map(
        ([quarters, level]): Measured => [level, Number(quarters) / 4],
      );
      return matched.length ? [...matched, [WHITE, 1]] : [];
    }
    return LEVELS.flatMap((level): Measured[] => {
      const text = luminances[level]?.trim().replace(",", ".");
      return text ? [[level, Number(text)]] : [];
    });
  }

  private get untouched(): boolean {
    return this.measured().length === 0;
  }

  private update(): void {
    remember("display", this.kept);
    for (const [way, section] of Object.entries(this.sections))
      section.hidden = way !== this.kept.way;
    try {
      this.found = fitGamma(this.measured());
      this.says.textContent = `γ = ${this.found.gamma.toFixed(2)}, by least squares; the curve is off by ${this.found.residual.toFixed(4)} of white (root mean square).`;
    } catch (error) {
      if (!(error instanceof LightbenchError)) throw error;
      this.found = null;
      this.says.textContent = `No γ yet: ${this.untouched ? TO_DO[this.kept.way] : error.message}.`;
    }
    this.fill();
    this.plot.show(this.found);
    this.offer();
  }

  private fill(): void {
    for (const [level, [measured, fitted]] of this.cells) {
      const at = this.found?.levels.indexOf(level) ?? -1;
      const known = this.found && at >= 0 && this.kept.way === "meter";
      measured.textContent = known ? this.found!.y[at]!.toFixed(4) : "";
      fitted.textContent = known ? (this.found!.x[at]! ** this.found!.gamma).toFixed(4) : "";
    }
  }

  private offer(): void {
    const [low, high] = this.use.range;
    const gamma = this.found?.gamma ?? 0;
    const fits = low <= gamma && gamma <= high;
    this.apply.disabled = !fits;
    this.apply.textContent = fits
      ? `Encode the picture for γ ${gamma.toFixed(2)}`
      : `Encode the picture for γ from ${low} to ${high}`;
  }

  private put(): void {
    if (!this.found) return;
    this.use.use(shorten(this.found.gamma, 4));
    this.says.textContent = `The picture is now encoded for a display of γ ${this.found.gamma.toFixed(2)}.`;
  }
}
