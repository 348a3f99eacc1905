// Canvases whose pixels are the screen's own: none is scaled or smoothed.
import { make } from "./dom";

/** Levels 0 to 255 of a canvas of this size. */
export type Paint = (
  fill: (level: number, x: number, y: number, width: number, height: number) => void,
  width: number,
  height: number,
) => void;

/** A canvas that is painted anew whenever its place on the screen changes. */
export class Pixels {
  readonly canvas: HTMLCanvasElement;

  constructor(
    label: string,
    private readonly paint: Paint,
  ) {
    this.canvas = make("canvas", { class: "pixels", role: "img", "aria-label": label });
    const observer = new ResizeObserver(([entry]) => this.resize(entry!));
    try {
      observer.observe(this.canvas, { box: "device-pixel-content-box" });
    } catch {
      observer.observe(this.canvas); // Safari counts no pixels of the device
    }
  }

  draw(): void {
    const { width, height } = this.canvas;
    const context = this.canvas.getContext("2d", { alpha: false })!;
    this.paint(
      (level, ...place) => {
        context.fillStyle = `rgb(${level} ${level} ${level})`;
        context.fillRect(...place);
      },
      width,
      height,
    );
  }

  private resize(entry: ResizeObserverEntry): void {
    const [box] = entry.devicePixelContentBoxSize ?? [];
    const { width, height } = entry.contentRect;
    this.canvas.width = counted(width, box?.inlineSize);
    this.canvas.height = counted(height, box?.blockSize);
    this.draw();
  }
}

/** Pixels of the device along a side; the browser's count, but for one of another screen. */
function counted(side: number, count: number | undefined): number {
  const likely = Math.round(side * devicePixelRatio);
  return count !== undefined && Math.abs(count - likely) <= 1 ? count : likely;
}

/** Upright bars of one width, a level each. */
export function bars(levels: readonly number[]): Paint {
  return (fill, width, height) => {
    for (const [index, level] of levels.entries()) {
      const [left, right] = [index, index + 1].map((edge) =>
        Math.round((edge * width) / levels.length),
      );
      fill(level, left!, 0, right! - left!, height);
    }
  };
}

/** A patch on lines of black and white, of which so many quarters are white. */
export function patch(quarters: number, level: () => number): Paint {
  // Whether each of four lines is white, those that are as far apart as they can be.
  const lines = [0, 1, 2, 3].map((line) => (line * quarters) % 4 < quarters);
  return (fill, width, height) => {
    for (let y = 0; y < height; y += 1) fill(lines[y % 4] ? 255 : 0, 0, y, width, 1);
    const [left, top] = [Math.round(width / 4), Math.round(height / 4)];
    fill(level(), left, top, width - 2 * left, height - 2 * top);
  };
}

/** The chart over the whole screen, or the window where that is refused, until a key or a tap. */
export function showChart(levels: readonly number[]): void {
  const label = `Calibration chart: bars of levels ${levels.join(", ")} from left to right`;
  const { canvas } = new Pixels(label, bars(levels));
  const frame = make("div", {}, canvas, make("p", {}, "A key or a tap leaves"));
  const dialog = make("dialog", { class: "chart", "aria-label": "Calibration chart" }, frame);
  const close = () => dialog.close();
  const left = () => document.fullscreenElement || close();
  dialog.addEventListener("click", close);
  dialog.addEventListener("keydown", (event) => {
    event.preventDefault();
    close();
  });
  document.addEventListener("fullscreenchange", left);
  dialog.addEventListener("close", () => {
    document.removeEventListener("fullscreenchange", left);
    if (document.fullscreenElement) void document.exitFullscreen();
    dialog.remove();
  });
  document.body.append(dialog);
  dialog.showModal();
  frame.requestFullscreen?.().catch(() => {});
}
