// Sentences over the picture: what went wrong and what to do.
import { make } from "./dom";

export class Notices {
  private failure: HTMLElement | null = null;

  constructor(private readonly root: HTMLElement) {}

  /** A sentence that stays until it is dismissed, or for so many seconds, or another on its topic. */
  say(sentence: string, seconds = 0, topic = ""): void {
    if (topic) this.forget(topic);
    if ([...this.root.children].some((notice) => notice.firstChild?.textContent === sentence))
      return;
    const about = topic || undefined;
    const notice = make("div", { class: "notice", "data-topic": about }, make("p", {}, sentence));
    const click = () => notice.remove();
    notice.append(make("button", { type: "button", "aria-label": "Dismiss", click }, "×"));
    this.root.append(notice);
    if (seconds > 0) setTimeout(click, seconds * 1000);
  }

  /** The one sentence about the picture itself; null once it is drawn again. */
  fail(sentence: string | null): void {
    if (this.failure?.textContent === (sentence ?? undefined)) return;
    this.failure?.remove();
    this.failure =
      sentence === null ? null : make("div", { class: "notice failure" }, make("p", {}, sentence));
    if (this.failure) this.root.prepend(this.failure);
  }

  /** Take back what was said on a topic. */
  forget(topic: string): void {
    this.root.querySelector(`[data-topic="${topic}"]`)?.remove();
  }

  clear(): void {
    this.root.replaceChildren();
    this.failure = null;
  }
}
