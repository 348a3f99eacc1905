// The server's picture of the same state, pixel by pixel beside the browser's.
import { LightbenchError } from "./core/errors";
import { path, sentence } from "./data";
import { query, type State } from "./state";

export interface ServerPicture {
  width: number;
  height: number;
  /** RGBA codes, row 0 at the top. */
  pixels: Uint8ClampedArray;
  milliseconds: number;
  renderer: string;
}

export interface Difference {
  pixels: number;
  largest: number;
}

/** Address of a picture, relative to the page. */
export function address(state: State, size: readonly number[]): string {
  const settings = query(state.settings);
  const head = `api/render/${path(state.scene)}.png?width=${size[0]}&height=${size[1]}`;
  return settings ? `${head}&${settings}` : head;
}

/** Throws LightbenchError with what the server said, or that there is none. */
export async function fetchPicture(
  state: State,
  size: readonly number[],
  signal: AbortSignal,
): Promise<ServerPicture> {
  const response = await fetch(address(state, size), { signal }).catch((error: unknown) => {
    if (signal.aborted) throw error;
    return null;
  });
  const type = response?.headers.get("content-type") ?? "";
  if (response && !response.ok && type.includes("json")) {
    throw new LightbenchError(`The server refuses: ${sentence(await response.json())}`);
  }
  if (!response?.ok || !type.startsWith("image/png")) {
    throw new LightbenchError(
      "There is no server behind this page, only files. Run `lightbench serve` and open the address that it prints to compare the two pictures.",
    );
  }
  const { width, height, data } = await decode(await response.blob());
  return {
    width,
    height,
    pixels: data,
    milliseconds: Number(response.headers.get("x-lightbench-render-ms")),
    renderer: response.headers.get("x-lightbench-renderer") ?? "",
  };
}

async function decode(blob: Blob): Promise<ImageData> {
  const bitmap = await createImageBitmap(blob, {
    colorSpaceConversion: "none",
    premultiplyAlpha: "none",
  });
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, bitmap.width, bitmap.height);
}

/** How many pixels differ, and the largest difference of a channel in codes; alpha is left out. */
export function compare(a: ArrayLike<number>, b: ArrayLike<number>): Difference {
  const found: Difference = { pixels: 0, largest: 0 };
  for (let at = 0; at < a.length; at += 4) {
    const most = Math.max(
      Math.abs(a[at]! - b[at]!),
      Math.abs(a[at + 1]! - b[at + 1]!),
      Math.abs(a[at + 2]! - b[at + 2]!),
    );
    if (most > 0) found.pixels += 1;
    if (most > found.largest) found.largest = most;
  }
  return found;
}
