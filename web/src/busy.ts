// The thin line above the picture, and what the page is busy with.
import { make } from "./dom";

export class Busy {
  /** What is being done, by who does it. */
  private readonly doing = new Map<string, string>();

  constructor(private readonly line: HTMLElement) {}

  /** What `who` is doing; null once nothing is. */
  say(what: string | null, who = "picture"): void {
    if (what === null) this.doing.delete(who);
    else this.doing.set(who, what);
    const words = [...this.doing.values()].at(-1) ?? "";
    if (this.line.textContent === words) return;
    this.line.hidden = words === "";
    this.line.setAttribute("aria-valuetext", words);
    this.line.replaceChildren(make("span", {}, words));
  }
}
