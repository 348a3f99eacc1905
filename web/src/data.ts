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
