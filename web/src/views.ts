// Views of a scene: those that its file names, and the one that it was left with.
import type { GUI } from "lil-gui";
import { words } from "./control";
import type { Camera, Scene } from "./core/types";
import { grouped } from "./dom";
import type { Values } from "./fields";
import type { Row } from "./row";
import type { State } from "./state";

const OWN = "";

/** The cameras that the scene's file names. */
export function viewsOf(scene: Scene & { views?: Record<string, Camera> }): Record<string, Camera> {
  return scene.views ?? {};
}

/** The name of the view that the camera stands in, "" for the scene's own; null elsewhere. */
export function standing(camera: Camera, preset: Scene): string | null {
  const all = Object.entries({ [OWN]: preset.camera, ...viewsOf(preset) });
  return all.find(([, view]) => alike(camera, view))?.[0] ?? null;
}

function alike(camera: Camera, view: Camera): boolean {
  return Object.keys(view).every(
    (field) => `${camera[field as keyof Camera]}` === `${view[field as keyof Camera]}`,
  );
}

/** What the camera of each scene was when it was left, until the page is closed. */
export class LeftViews {
  private readonly views = new Map<string, Values>();

  leave({ scene, settings }: State): void {
    this.views.set(scene, camera(settings));
  }

  of(scene: string): Values {
    return this.views.get(scene) ?? {};
  }
}

function camera(settings: Values): Values {
  return Object.fromEntries(
    Object.entries(settings).filter(([name]) => name.startsWith("camera.")),
  );
}

/** A place to see a scene from; `of` is the heading that it stands under. */
export interface Seat {
  name: string;
  title: string;
  of: string;
}

// Names of views have no space.
const LIGHT = "light ";

/** The scene's own camera, those that its file names, and its lights. */
export function seatsOf(scene: Scene): Seat[] {
  const lights = Object.keys(scene.lights).map((name) => ({
    ...{ name: seatAt(name), title: `Light: ${words(name)}`, of: "Lights" },
  }));
  return [
    { name: OWN, title: "The scene's view", of: "Cameras" },
    ...Object.keys(viewsOf(scene)).map((name) => ({ name, title: words(name), of: "Cameras" })),
    ...lights,
  ];
}

/** The light that a seat is; null for a camera. */
export function lightOf(seat: string): string | null {
  return seat.startsWith(LIGHT) ? seat.slice(LIGHT.length) : null;
}

/** The seat at a light. */
export function seatAt(light: string): string {
  return `${LIGHT}${light}`;
}

/** The panel's way to the views. */
export interface ViewMenu {
  /** The seat that is taken: "" for the scene's own view, null for none of them. */
  current(): string | null;
  show(name: string): void;
}

/** A menu of what a scene may be seen from. */
export function addViews(fold: GUI, seats: readonly Seat[], { current, show }: ViewMenu): Row {
  const proxy = {
    get value() {
      return current() ?? "Elsewhere";
    },
    set value(name: string) {
      show(name);
    },
  };
  const options = Object.fromEntries(seats.map(({ title, name }) => [title, name]));
  const controller = fold.add(proxy, "value", options).name("Seen from");
  const select = controller.domElement.querySelector("select")!;
  select.dataset.control = "camera/view";
  grouped(
    select,
    seats.map(({ of }) => of),
  );
  return { update: () => void controller.updateDisplay() };
}
