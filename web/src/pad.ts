// A stick and two buttons over the picture: walking by touch.
import { make } from "./dom";
import type { Push } from "./modes";

/** Something is held from now on, or (null) no more. */
type Hold = (name: string, push: Push | null, now: number) => void;

export class Pad {
  private readonly stick = make("div", { class: "stick", "aria-hidden": "true" }, make("i"));
  private readonly buttons = make("div", { class: "heights" });

  constructor(
    frame: HTMLElement,
    private readonly hold: Hold,
  ) {
    this.buttons.append(
      this.button("Up", { up: 1 }, "\u2191"),
      this.button("Down", { up: -1 }, "\u2193"),
    );
    this.stick.addEventListener("pointerdown", (event) => {
      this.stick.setPointerCapture(event.pointerId);
      this.lean(event);
    });
    this.stick.addEventListener("pointermove", (event) => {
      if (this.stick.hasPointerCapture(event.pointerId)) this.lean(event);
    });
    this.stick.addEventListener("lostpointercapture", (event) => this.lean(event, true));
    frame.addEventListener("pointerdown", ({ pointerType }) => {
      if (pointerType === "touch") frame.classList.add("touched");
    });
    this.show(false);
    frame.append(this.stick, this.buttons);
  }

  /** Where fingers are the usual hands, or one has touched the picture; see walk.css. */
  show(shown: boolean): void {
    this.stick.hidden = !shown;
    this.buttons.hidden = !shown;
  }

  private lean(event: PointerEvent, over = false): void {
    const box = this.stick.getBoundingClientRect();
    const place = (at: number, from: number, size: number) => ((at - from) / size) * 2 - 1;
    const x = place(event.clientX, box.left, box.width);
    const y = place(event.clientY, box.top, box.height);
    const share = over ? 0 : 1 / Math.max(1, Math.hypot(x, y));
    const knob = this.stick.firstElementChild as HTMLElement;
    knob.style.translate = `${x * share * 50}% ${y * share * 50}%`;
    this.hold("stick", over ? null : { right: x * share, ahead: -y * share }, event.timeStamp);
  }

  private button(name: string, push: Push, arrow: string): HTMLButtonElement {
    const button = make("button", { type: "button", "aria-label": name, tabindex: -1 }, arrow);
    button.addEventListener("pointerdown", (event) => {
      button.setPointerCapture(event.pointerId);
      this.hold(name, push, event.timeStamp);
    });
    button.addEventListener("lostpointercapture", (event) =>
      this.hold(name, null, event.timeStamp),
    );
    return button;
  }
}
