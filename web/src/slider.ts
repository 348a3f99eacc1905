// A slider with its number, unit and reset: a controller of the panel with native inputs inside.
import { Controller, type GUI } from "lil-gui";
import { clamp } from "./number";
import { display, fromPosition, POSITIONS, pretty, type Scale, stepped, toPosition } from "./scale";

export class Slider extends Controller {
  readonly range = document.createElement("input");
  readonly field = document.createElement("input");
  private readonly unit = document.createElement("span");

  constructor(
    parent: GUI,
    proxy: { value: unknown },
    private readonly scale: Scale,
  ) {
    super(parent, proxy, "value", "lb-slider");
    this.range.type = "range";
    this.range.min = "0";
    this.range.max = `${POSITIONS}`;
    this.range.step = "any";
    this.field.type = "text";
    this.field.inputMode = "decimal";
    this.field.autocomplete = "off";
    this.unit.className = "unit";
    this.unit.textContent = pretty(scale.unit);
    for (const input of [this.range, this.field])
      input.setAttribute("aria-labelledby", this.$name.id);
    this.$widget.append(this.range, this.field, this.unit);
    this.name(scale.label);
    this.follow();
    this.updateDisplay();
  }

  override updateDisplay(): this {
    const value = Number(this.getValue());
    const text = Number.isFinite(value) ? display(this.scale, value) : "";
    this.range.value = `${toPosition(this.scale, value) * POSITIONS}`;
    this.range.setAttribute("aria-valuetext", `${text} ${this.scale.unit}`.trim());
    if (document.activeElement !== this.field) this.field.value = text;
    return this;
  }

  private follow(): void {
    this.range.addEventListener("input", () => {
      this.setValue(fromPosition(this.scale, Number(this.range.value) / POSITIONS));
    });
    this.range.addEventListener("change", () => this._callOnFinishChange());
    this.range.addEventListener("keydown", (event) => this.onKey(event, true));
    this.field.addEventListener("keydown", (event) => this.onKey(event, false));
    this.field.addEventListener("change", () => this.take());
    this.field.addEventListener("focus", () => this.field.select());
    this.field.addEventListener("blur", () => this.updateDisplay());
  }

  /** Arrows step; on the slider itself Home, End and Page keys too, and Backspace resets. */
  private onKey(event: KeyboardEvent, onSlider: boolean): void {
    const { key, shiftKey, ctrlKey, metaKey, altKey } = event;
    if (ctrlKey || metaKey || altKey) return;
    const sides: Record<string, number> = onSlider ? { ArrowRight: 1, ArrowLeft: -1 } : {};
    const steps: Record<string, number> = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
    const count = (sides[key] ?? steps[key] ?? 0) * (shiftKey ? 10 : 1);
    const ends: Record<string, number> = { Home: this.scale.low, End: this.scale.high };
    if (count) this.put(stepped(this.scale, Number(this.getValue()), count));
    else if (onSlider && ends[key] !== undefined) this.put(ends[key]);
    else if (onSlider && (key === "Backspace" || key === "Delete")) this.reset();
    else if (key === "Enter") this.take();
    else return;
    event.preventDefault();
  }

  private put(value: number): void {
    this.setValue(value);
    this.field.value = display(this.scale, Number(this.getValue()));
    this._callOnFinishChange();
  }

  /** What was typed; a comma may stand for the point, and text that is no number is dropped. */
  private take(): void {
    const value = Number(this.field.value.replace(",", ".").replace("\u2212", "-"));
    if (this.field.value.trim() && Number.isFinite(value)) {
      this.put(clamp(value, this.scale.min, this.scale.max));
    } else {
      this.field.value = display(this.scale, Number(this.getValue()));
    }
  }
}
