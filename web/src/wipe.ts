// Two pictures in one place: the browser's to the left of a handle, the server's to its right.
import { LightbenchError } from "./core/errors";
import type { Scene } from "./core/types";
import { make } from "./dom";
import { clamp, spell } from "./number";
import { address, compare, fetchPicture, type ServerPicture } from "./server";
import type { State } from "./state";
import { shortRenderer } from "./status";

/** What the comparison needs of the page. */
export interface Source {
  state(): State;
  /** The scene to send along where the server knows none of that name. */
  sent(): Scene | null;
  size(): readonly number[];
  codes(): Uint8Array;
  say(sentence: string): void;
  shown(shown: boolean): void;
}

const WAIT_MILLISECONDS = 200;

export class Wipe {
  private readonly canvas = make("canvas", {
    class: "server",
    "aria-label": "The server's picture",
    role: "img",
  });
  private readonly handle = make("div", {
    class: "handle",
    role: "slider",
    tabindex: 0,
    "aria-label": "Wipe between this browser's picture and the server's",
    "aria-valuemin": 0,
    "aria-valuemax": 100,
  });
  private readonly verdict = make("p", { class: "verdict", role: "status" });
  private readonly box = make(
    "div",
    { class: "wipe", hidden: true },
    this.canvas,
    this.handle,
    this.verdict,
  );
  private share = 0.5;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** The picture that the server has been asked for. */
  private asked = "";
  private request: AbortController | null = null;

  constructor(
    stage: HTMLElement,
    private readonly source: Source,
  ) {
    this.box.append(
      make("span", { class: "side left" }, "This browser"),
      make("span", { class: "side right" }, "Server"),
    );
    stage.append(this.box);
    this.handle.addEventListener("pointerdown", (event) =>
      this.handle.setPointerCapture(event.pointerId),
    );
    this.handle.addEventListener("pointermove", (event) => this.drag(event));
    this.handle.addEventListener("keydown", (event) => this.key(event));
    this.place(0.5);
  }

  get shown(): boolean {
    return !this.box.hidden;
  }

  show(shown: boolean): void {
    this.box.hidden = !shown;
    this.source.shown(shown);
    this.stop();
    this.asked = "";
    if (shown) this.refresh();
  }

  /** The picture beside it has changed: the server's is stale until it has answered. */
  refresh(): void {
    const asked = address(this.source.state(), this.source.size());
    if (!this.shown || asked === this.asked) return;
    this.asked = asked;
    this.stop();
    this.box.classList.add("stale");
    this.timer = setTimeout(() => void this.load(), WAIT_MILLISECONDS);
  }

  private stop(): void {
    clearTimeout(this.timer);
    this.request?.abort();
    this.request = null;
  }

  private async load(): Promise<void> {
    const request = new AbortController();
    this.request = request;
    this.verdict.textContent = "Waiting for the server";
    try {
      const { source } = this;
      const wanted = [source.state(), source.sent(), source.size()] as const;
      const picture = await fetchPicture(...wanted, request.signal);
      if (!request.signal.aborted) this.take(picture);
    } catch (error) {
      if (request.signal.aborted) return;
      if (!(error instanceof LightbenchError)) throw error;
      this.show(false);
      this.source.say(error.message);
    }
  }

  private take(picture: ServerPicture): void {
    const { width, height, pixels, milliseconds, renderer } = picture;
    this.canvas.width = width;
    this.canvas.height = height;
    this.canvas
      .getContext("2d")!
      .putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
    this.box.classList.remove("stale");
    const { pixels: differ, largest } = compare(this.source.codes(), pixels);
    const all = spell(width * height, 9);
    const verdict =
      differ === 0
        ? `All ${all} pixels are equal`
        : `${spell(differ, 9)} of ${all} pixels differ, by at most ${largest} of 255 codes`;
    this.verdict.textContent = `${verdict}. Server: ${spell(milliseconds, 3)} ms on ${shortRenderer(renderer)}`;
  }

  private place(share: number): void {
    this.share = clamp(share, 0, 1);
    const percent = Math.round(this.share * 1000) / 10;
    this.box.style.setProperty("--wipe", `${percent}%`);
    this.handle.ariaValueNow = `${Math.round(percent)}`;
    this.handle.ariaValueText = `${Math.round(percent)} % this browser`;
  }

  private drag(event: PointerEvent): void {
    if (!this.handle.hasPointerCapture(event.pointerId)) return;
    const box = this.box.getBoundingClientRect();
    this.place((event.clientX - box.left) / box.width);
  }

  private key(event: KeyboardEvent): void {
    const step = event.shiftKey ? 0.1 : 0.01;
    const next = {
      ArrowLeft: this.share - step,
      ArrowRight: this.share + step,
      Home: 0,
      End: 1,
    }[event.key];
    if (next === undefined) return;
    this.place(next);
    event.preventDefault();
    event.stopPropagation();
  }
}
