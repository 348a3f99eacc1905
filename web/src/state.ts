// The state of the page as it stands in a link: `#box-room&model=phong&camera.eye=1,2,3`.
// Names and values are those of the service's query string and of the command line.
import type { Manifest, Scene } from "./core/types";
import { defaultOf, parse, same, type Value, type Values } from "./fields";
import { shorten } from "./number";

export interface State {
  scene: string;
  settings: Values;
}

/** The link's text after `#`: the scene's name, then what differs from its defaults. */
export function write(state: State): string {
  return [state.scene, query(state.settings)].filter(Boolean).join("&");
}

/** The settings as a query string, readable as far as a link allows. */
export function query(settings: Values): string {
  return Object.entries(settings)
    .map(([name, value]) => `${encodeURIComponent(name)}=${spelled(value)}`)
    .join("&");
}

function spelled(value: Value): string {
  const parts = Array.isArray(value) ? value : [value];
  const words = parts.map((part) => (typeof part === "number" ? `${shorten(part)}` : `${part}`));
  return words.map(encodeURIComponent).join(",");
}

/** Scene name and raw settings of a link; null for a scene's name that it does not have. */
export function read(hash: string): { scene: string | null; texts: Map<string, string> } {
  const [first = "", ...rest] = hash.replace(/^#/, "").split("&");
  const named = first !== "" && !first.includes("=");
  const texts = new Map<string, string>();
  for (const part of named ? rest : [first, ...rest]) {
    const at = part.indexOf("=");
    if (part)
      texts.set(
        decoded(at < 0 ? part : part.slice(0, at)),
        at < 0 ? "" : decoded(part.slice(at + 1)),
      );
  }
  return { scene: named ? decoded(first) : null, texts };
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Raw settings of a link as values, those that `check` refuses left out with its sentence. */
export function accept(
  manifest: Manifest,
  scene: Scene,
  texts: ReadonlyMap<string, string>,
  check: (settings: Values) => void,
): { settings: Values; problems: string[] } {
  const wanted = [...texts].map(
    ([name, text]) => [name, parse(manifest, scene, name, text)] as const,
  );
  const settings: Record<string, Value> = Object.fromEntries(wanted);
  if (!problem(settings, check)) return { settings: trim(manifest, scene, settings), problems: [] };
  const kept: Record<string, Value> = {};
  let waiting = wanted;
  // One value may be wrong only until another is there (a spot's inner and outer angle).
  for (let before = -1; before !== waiting.length; ) {
    before = waiting.length;
    waiting = waiting.filter(([name, value]) => {
      const refused = problem({ ...kept, [name]: value }, check);
      if (!refused) kept[name] = value;
      return refused !== null;
    });
  }
  const problems = waiting.map(([name, value]) => problem({ ...kept, [name]: value }, check)!);
  return { settings: trim(manifest, scene, kept), problems };
}

function problem(settings: Values, check: (settings: Values) => void): string | null {
  try {
    check(settings);
    return null;
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
}

/** Settings without those that say what holds anyway. */
export function trim(manifest: Manifest, scene: Scene, settings: Values): Values {
  return Object.fromEntries(
    Object.entries(settings).filter(
      ([name, value]) => !same(value, defaultOf(manifest, scene, name, settings)),
    ),
  );
}
