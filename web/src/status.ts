// The line below the picture: what it costs, what drew it, what is wrong in it.
import type { Timing } from "./core/timer";
import type { Plan } from "./core/types";
import { make } from "./dom";
import type { Invalid } from "./invalid";
import { spell } from "./number";
import { Times } from "./times";

// Screen readers hear the numbers at most this often.
const SPEAK_MILLISECONDS = 4000;

export class Status {
  private readonly items = new Map<string, HTMLElement>();
  private readonly times = new Times();
  private spoken: ReturnType<typeof setTimeout> | undefined;
  private readonly voice = make("p", { class: "spoken", "aria-live": "polite" });

  constructor(line: HTMLElement) {
    for (const name of [
      "invalid",
      "time",
      "source",
      "renderer",
      "size",
      "triangles",
      "passes",
      "meter",
    ]) {
      const item = make("span", { class: name });
      this.items.set(name, item);
      line.append(item);
    }
    line.after(this.voice);
  }

  drawn(plan: Plan, triangles: number): void {
    const [width, height] = plan.size as [number, number];
    const kind = `${width} ${height} ${plan.programs.map((program) => program.fragment).join()}`;
    this.times.drawn(kind, performance.now());
    this.show("size", `${width} × ${height}`);
    this.show("triangles", `${spell(triangles, 7)} triangles`);
    const passes = plan.passes.map((pass) => pass.name);
    this.show(
      "passes",
      `${passes.length} ${passes.length === 1 ? "pass" : "passes"}`,
      passes.join(", then "),
    );
  }

  timed(timing: Timing): void {
    this.times.add(timing.milliseconds);
    const { count, median, fastest, slowest } = this.times;
    const title = `fastest ${spell(fastest, 3)} ms, slowest ${spell(slowest, 3)} ms`;
    const source = count > 1 ? `${timing.source}, median of ${count}` : timing.source;
    this.show("time", `${spell(median, 3)} ms`, title);
    this.show("source", source);
  }

  /** Whether the time needs no frame more. */
  get settled(): boolean {
    return this.times.settled(performance.now());
  }

  renderer(name: string): void {
    this.show("renderer", shortRenderer(name), name);
  }

  /** Counts in red; nothing where nothing is wrong. */
  invalid(counts: Invalid): void {
    const words = [
      counts.nan ? `${spell(counts.nan, 9)} NaN` : "",
      counts.inf ? `${spell(counts.inf, 9)} infinite` : "",
      counts.negative ? `${spell(counts.negative, 9)} negative` : "",
    ].filter(Boolean);
    this.show(
      "invalid",
      words.length ? `${words.join(", ")} pixels` : "",
      "Set View to Invalid values to see where",
    );
  }

  /** The radiance under the pointer: its luminance (Rec. 709), then the three channels. */
  meter(radiance: ArrayLike<number> | null): void {
    if (!radiance) {
      this.show("meter", "");
      return;
    }
    const [r = 0, g = 0, b = 0] = Array.from(radiance);
    const luminance = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const channels = [r, g, b].map((c) => spell(c, 3)).join("  ");
    this.show("meter", `${spell(luminance, 3)} cd/m²`, `linear r g b: ${channels}`);
  }

  private show(name: string, text: string, title = ""): void {
    const item = this.items.get(name)!;
    if (item.textContent === text && item.title === title) return;
    item.textContent = text;
    item.title = title;
    if (name !== "meter") this.speakLater();
  }

  private speakLater(): void {
    this.spoken ??= setTimeout(() => {
      this.spoken = undefined;
      const parts = [...this.items].filter(([name]) => name !== "meter");
      this.voice.textContent = parts
        .map(([, item]) => item.textContent)
        .filter(Boolean)
        .join(", ");
    }, SPEAK_MILLISECONDS);
  }
}

/** ANGLE wraps the device's name in its own: what a person knows it by is inside. */
export function shortRenderer(name: string): string {
  const inner = /^ANGLE \((.*)\)$/.exec(name)?.[1];
  if (!inner) return name;
  const parts = inner.split(", ");
  const device = (parts.length > 1 ? parts[1]! : inner).replace(/^Vulkan [\d.]+ \((.*)\)$/, "$1");
  return device.replace(/ \(0x[0-9A-Fa-f]+\)$/, "").replace(/ Direct3D.*$/, "");
}
