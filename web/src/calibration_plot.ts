// Measured luminances, the power that was fitted to them, and what undoes it.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Fit } from "./core/gamma";
import { make } from "./dom";

const SIDE = 255;
const LEVELS = Array.from({ length: SIDE + 1 }, (_, code) => code / SIDE);
const HIGHEST = 320;

export class CalibrationPlot {
  readonly element = make("div", { class: "curves", hidden: true });
  private readonly plot: uPlot;

  constructor() {
    const style = getComputedStyle(document.documentElement);
    const color = (name: string) => () => style.getPropertyValue(name);
    const axis = (label: string): uPlot.Axis => ({
      label,
      stroke: color("--quiet"),
      font: "12px system-ui",
      labelFont: "12px system-ui",
      labelSize: 18,
      size: 38,
      grid: { stroke: color("--line"), width: 1 },
      ticks: { stroke: color("--line"), width: 1 },
    });
    const curve = (label: string, dash: number[]): uPlot.Series => ({
      label,
      stroke: color("--accent"),
      width: 2,
      dash,
      points: { show: false },
    });
    const measured: uPlot.Series = {
      label: "measured",
      stroke: color("--text"),
      paths: () => null,
      points: { show: true, size: 8, fill: color("--back"), width: 2 },
    };
    this.plot = new uPlot(
      {
        ...this.size(),
        scales: { x: { time: false, range: [0, 1] }, y: { range: [0, 1] } },
        axes: [axis("level, of white"), axis("luminance, of white")],
        series: [
          {},
          measured,
          curve("fitted, x^γ", []),
          curve("corrected, x^(1/γ), in dashes", [6, 5]),
        ],
        cursor: { show: false },
        legend: { live: false },
      },
      [LEVELS, LEVELS.map(() => null), [...LEVELS], [...LEVELS]],
      this.element,
    );
    new ResizeObserver(() => this.plot.setSize(this.size())).observe(this.element);
  }

  /** No fit, no curves. */
  show(fit: Fit | null): void {
    this.element.hidden = fit === null;
    if (!fit) return;
    const y = new Map(fit.x.map((x, index) => [Math.round(x * SIDE), fit.y[index]!]));
    this.plot.setData([
      LEVELS,
      LEVELS.map((_, code) => y.get(code) ?? null),
      LEVELS.map((x) => x ** fit.gamma),
      LEVELS.map((x) => x ** (1 / fit.gamma)),
    ]);
  }

  private size(): { width: number; height: number } {
    const width = Math.max(this.element.clientWidth, 1);
    return { width, height: Math.min(width, HIGHEST) };
  }
}
