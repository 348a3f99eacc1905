// What the page loads, relative to itself: the same files from a server and as static files.
import { LightbenchError } from "./core/errors";
import type { Manifest, Scene } from "./core/types";

/** The library, the presets and the schema. */
export function loadManifest(): Promise<Manifest> {
  return json<Manifest>("data/manifest.json");
}

/** A preset. */
export function loadScene(name: string): Promise<Scene> {
  return json<Scene>(`data/scenes/${path(name)}.json`);
}

/** Address of a preset's picture in the menu. */
export function thumbnail(name: string): string {
  return `data/thumbs/${path(name)}.png`;
}

/** Address of an image on surfaces. */
export function texture(key: string): string {
  return `data/textures/${key}.png`;
}

/** A function of the atlas and the inputs to choose axes from, the usual pairs in `axes`. */
export interface AtlasEntry {
  file: string;
  function: string;
  group: string;
  title: string;
  inputs: { name: string; label: string; unit: string }[];
  axes: [x: string, y: string][];
}

/** Every function of the atlas. */
export async function loadAtlas(): Promise<AtlasEntry[]> {
  return (await json<{ functions: AtlasEntry[] }>("data/atlas.json")).functions;
}

/** A function over two inputs, as `unpack` reads it. */
export async function loadAtlasMap(
  file: string,
  name: string,
  x: string,
  y: string,
): Promise<ArrayBuffer> {
  const place = path(`${file.replace(/\.glsl$/, "")}/${name}/${x}/${y}`);
  const response = await fetch(`data/atlas/${place}.bin`).catch(() => null);
  const type = response?.headers.get("content-type") ?? "";
  if (response?.ok && !type.includes("html")) return response.arrayBuffer();
  if (response && type.includes("json"))
    throw new LightbenchError(`The server refuses: ${sentence(await response.json())}`);
  throw new LightbenchError(
    response
      ? "Behind this page are only files, and none has these axes. Run `lightbench serve` and open the address that it prints to choose any."
      : "The map could not be loaded: no server answered. Choose it again to try again.",
  );
}

/** What an error of the service says. */
export function sentence(body: unknown): string {
  const message = (body as { error?: { message?: unknown } } | null)?.error?.message;
  return typeof message === "string" ? message : "it does not say why";
}

/** `lab/shadows` keeps its slash. */
export function path(name: string): string {
  return name.split("/").map(encodeURIComponent).join("/");
}

async function json<T>(address: string): Promise<T> {
  const response = await get(address);
  try {
    return (await response.json()) as T;
  } catch {
    throw new LightbenchError(
      `${address} is not JSON: the page and its data do not belong together.`,
    );
  }
}

async function get(address: string): Promise<Response> {
  const response = await fetch(address).catch(() => null);
  if (response?.ok) return response;
  const reason = response ? `the server answered ${response.status}` : "no server answered";
  throw new LightbenchError(
    `${address} could not be loaded (${reason}). Reload the page to try again.`,
  );
}
