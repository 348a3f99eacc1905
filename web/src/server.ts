// What only a server can do: draw the same picture for comparison, and read models.
import type { Model } from "./bundle";
import { LightbenchError } from "./core/errors";
import type { Scene } from "./core/types";
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

const ONLY_FILES =
  "There is no server behind this page, only files. Run `lightbench serve` and open the address that it prints";
// Longest name of a file that the service takes.
const LONGEST = 200;

/** Address of a picture, relative to the page. */
export function address(state: State, size: readonly number[]): string {
  const settings = query(state.settings);
  const head = `api/render/${path(state.scene)}.png?width=${size[0]}&height=${size[1]}`;
  return settings ? `${head}&${settings}` : head;
}

/**
 * The server's picture of a state; of a scene that the server has no name for, by sending it.
 *
 * Throws LightbenchError with what the server said, or that there is none.
 */
export async function fetchPicture(
  state: State,
  scene: Scene | null,
  size: readonly number[],
  signal: AbortSignal,
): Promise<ServerPicture> {
  const [width, height] = size;
  const asked = scene ? { scene, settings: state.settings, width, height, format: "png" } : null;
  const response = asked
    ? await fetchOrNull("api/render", {
        ...post(JSON.stringify(asked), "application/json"),
        signal,
      })
    : await fetchOrNull(address(state, size), { signal });
  if (response?.status === 404 && asked) throw new LightbenchError(gone(scene!.title));
  const reason = await refusal(response);
  if (reason !== null) throw new LightbenchError(`The server refuses: ${reason}`);
  if (!isMedia(response, "image/png"))
    throw new LightbenchError(`${ONLY_FILES} to compare the two pictures.`);
  const { width: across, height: down, data } = await decode(await response.blob());
  return {
    width: across,
    height: down,
    pixels: data,
    milliseconds: Number(response.headers.get("x-lightbench-render-ms")),
    renderer: response.headers.get("x-lightbench-renderer") ?? "",
  };
}

/** The scene of a model that the server has read. Throws LightbenchError as `fetchPicture` does. */
export async function upload({ name, body }: Model, signal: AbortSignal): Promise<Scene> {
  const place = `api/models?name=${encodeURIComponent(name.slice(-LONGEST))}`;
  const response = await fetchOrNull(place, { ...post(body, "application/octet-stream"), signal });
  const reason = await refusal(response);
  if (reason !== null) throw new LightbenchError(reason);
  if (!isMedia(response, "application/json"))
    throw new LightbenchError(`${ONLY_FILES} to open models of your own.`);
  return (await response.json()) as Scene;
}

/** What to do about a model whose parts the server no longer has. */
export function gone(model: string): string {
  return `The server no longer has ${model}: it was started anew, or newer models took the room. Drop the file again.`;
}

function post(body: BodyInit, type: string): RequestInit {
  return { method: "POST", body, headers: { "content-type": type } };
}

/** Null where no server answered; rejects where the request was given up. */
async function fetchOrNull(place: string, init: RequestInit): Promise<Response | null> {
  return fetch(place, init).catch((error: unknown) => {
    if (init.signal?.aborted) throw error;
    return null;
  });
}

/** Why the service refuses; null where it does not, or where it is no service that answers. */
async function refusal(response: Response | null): Promise<string | null> {
  const refuses = response && !response.ok && typeOf(response).includes("json");
  return refuses ? sentence(await response.json()) : null;
}

function isMedia(response: Response | null, media: string): response is Response {
  return response?.ok === true && typeOf(response).startsWith(media);
}

function typeOf(response: Response): string {
  return response.headers.get("content-type") ?? "";
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
