// The panel's folds as data, and the situation that they depend on.
import type { Control } from "./control";
import type { Choice, Manifest, Plan, Scene } from "./core/types";
import { defaultOf, type Value, type Values } from "./fields";
import type { Seat } from "./views";

export type Tab = "parts" | "model" | "lights" | "material" | "camera" | "picture";
export const TABS: Record<Tab, string> = {
  parts: "Parts",
  model: "Model",
  lights: "Lights",
  material: "Material",
  camera: "Camera",
  picture: "Picture",
};

/** A fold of the panel: a choice with its formula, a light, a material. */
export interface Group {
  id: string;
  tab: Tab;
  title: string;
  about: string;
  choice: Menu | null;
  controls: Control[];
  /** What the scene may be seen from, in the camera's fold. */
  views?: Seat[];
}

/** A choice setting: what may be chosen, and the front matter of what is. */
export interface Menu {
  setting: string;
  options: MenuItem[];
  chosen: string;
  meta: Choice;
}

/** `hint` says what it is; `kind` is the heading that it stands under, where there are several. */
export interface MenuItem {
  value: string;
  title: string;
  hint: string;
  kind: string;
}

/** All that the description depends on. */
export interface Situation {
  manifest: Manifest;
  /** The preset with the edits of the link. */
  scene: Scene;
  /** The preset as it was loaded. */
  preset: Scene;
  settings: Values;
  plan: Plan;
}

/** The value that holds now. */
export function current(now: Situation, name: string): Value {
  return now.settings[name] ?? defaultOf(now.manifest, now.preset, name, now.settings);
}

/** A fold without a choice. */
export function group(
  id: string,
  tab: Tab,
  title: string,
  about: string,
  controls: Control[],
): Group {
  return { id, tab, title, about, choice: null, controls };
}
