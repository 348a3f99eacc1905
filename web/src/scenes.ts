// The scenes of a session: the presets, loaded when they are asked for, and the models opened here.
import type { Manifest, Scene } from "./core/types";
import { loadScene, thumbnail } from "./data";

/** A model of a person's own: its file's name, its scene, and its picture once it was drawn. */
export interface Opened {
  readonly name: string;
  readonly file: string;
  readonly scene: Scene;
  thumb: string | null;
}

// Presets are named by their path in a folder, which never begins like this.
const MARK = "/";

/** Whether a scene is a model opened here, which no link leads to. */
export function isOpened(name: string): boolean {
  return name.startsWith(MARK);
}

/** The presets by the folder that they are in, those in none first. */
export function presetFolders({ scenes }: Pick<Manifest, "scenes">): Map<string, string[]> {
  const found = new Map<string, string[]>([["", []]]);
  for (const name of Object.keys(scenes)) {
    const folder = name.slice(0, Math.max(name.lastIndexOf("/"), 0));
    found.set(folder, [...(found.get(folder) ?? []), name]);
  }
  return found;
}

/** The preset that a digit leads to; undefined where there are not as many. */
export function presetAt(manifest: Pick<Manifest, "scenes">, digit: number): string | undefined {
  return [...presetFolders(manifest).values()].flat()[digit - 1];
}

export class Scenes {
  private readonly presets = new Map<string, Promise<Scene>>();
  private readonly models = new Map<string, Opened>();

  /** The models of this session, the latest first. */
  get opened(): Opened[] {
    return [...this.models.values()].reverse();
  }

  /** A scene by its name. Rejects with LightbenchError. */
  load(name: string): Promise<Scene> {
    const model = this.models.get(name);
    if (model) return Promise.resolve(model.scene);
    let found = this.presets.get(name);
    if (!found) {
      found = loadScene(name);
      found.catch(() => this.presets.delete(name));
      this.presets.set(name, found);
    }
    return found;
  }

  /** Keep a model and return its scene's name; the same one again has the name it had. */
  open(file: string, scene: Scene): string {
    const text = JSON.stringify(scene);
    const known = this.opened.find((model) => JSON.stringify(model.scene) === text);
    const name = known?.name ?? `${MARK}${this.models.size + 1}${MARK}${file}`;
    if (!known) this.models.set(name, { name, file, scene, thumb: null });
    return name;
  }

  /** The model of that name; null for a preset. */
  model(name: string): Opened | null {
    return this.models.get(name) ?? null;
  }

  /** Address of a scene's small picture; null while a model has none. */
  thumbnail(name: string): string | null {
    const model = this.models.get(name);
    return model ? model.thumb : thumbnail(name);
  }
}
