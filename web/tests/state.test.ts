import { expect, test, vi } from "vitest";
import { resolve } from "../src/core/settings";
import { defaultOf, parse, same } from "../src/fields";
import { accept, read, trim, write } from "../src/state";
import { Store } from "../src/store";
import { manifest, scene } from "./bench";

const texts = (hash: string) => read(hash).texts;
const check = (settings: Record<string, unknown>) => {
  const inner = Number(settings["lights.lamp.inner"] ?? 14);
  const outer = Number(settings["lights.lamp.outer"] ?? 24);
  if (inner > outer) throw new Error(`inner ${inner} above outer ${outer}`);
  for (const name of Object.keys(settings)) if (name === "wrong") throw new Error("no 'wrong'");
};

test("a link is short and readable", () => {
  const settings = {
    model: "shiny",
    "lights.lamp.intensity": 0.1 + 0.2,
    "camera.eye": [1, 2, 3],
    "materials.wall.base_color": "c8503c",
  };
  const hash = write({ scene: "lab/shadows", settings });
  expect(hash).toBe(
    "lab/shadows&model=shiny&lights.lamp.intensity=0.3&camera.eye=1,2,3&materials.wall.base_color=c8503c",
  );
  expect(read(`#${hash}`).scene).toBe("lab/shadows");
  expect(texts(`#${hash}`).get("camera.eye")).toBe("1,2,3");
});

test("a link may name no scene, carry odd characters, or be cut off", () => {
  expect(read("#model=shiny")).toEqual({ scene: null, texts: new Map([["model", "shiny"]]) });
  expect(read("")).toEqual({ scene: null, texts: new Map() });
  expect(texts("#room&model=%E0%A4%A&exposure").get("model")).toBe("%E0%A4%A");
  expect(texts("#room&exposure").get("exposure")).toBe("");
});

test("texts become values of the setting's kind", () => {
  const value = (name: string, text: string) => parse(manifest, scene, name, text);
  expect(value("model", "shiny")).toBe("shiny");
  expect(value("samples", "2")).toBe(2);
  expect(value("lights.lamp.c0", "2")).toBe(2);
  expect(value("camera.eye", "1,2,3")).toEqual([1, 2, 3]);
  expect(value("camera.fov", "wide")).toBe("wide");
  expect(value("materials.wall.kd", "#112233")).toBe("112233");
  expect(value("materials.wall.kd", "0.5,0,1")).toEqual([0.5, 0, 1]);
  expect(value("materials.wall.shininess", "100000")).toBe(100000);
  expect(value("materials.wall.shininess", "auto")).toBe("auto");
});

test("defaults: the scene's own, the menu's, and for a light what stands for all lights", () => {
  const standard = (name: string, above = {}) => defaultOf(manifest, scene, name, above);
  expect(standard("model")).toBe("matt");
  expect(standard("tonemap")).toBe("curve");
  expect(standard("L_white")).toBe(3);
  expect(standard("lights.lamp.intensity")).toBe(14);
  expect(standard("lights.lamp.c0")).toBe(1);
  expect(standard("lights.lamp.c0", { c0: 5 })).toBe(5);
  expect(standard("materials.wall.kd")).toBe("auto");
});

test("what says what holds anyway leaves the state", () => {
  const given = { model: "matt", L_white: 3, "camera.eye": [0, 0, 5], "camera.fov": 50 };
  expect(trim(manifest, scene, given)).toEqual({ "camera.fov": 50 });
  expect(same("e7e7e7", [0.8, 0.8, 0.8])).toBe(true);
  expect(same([2, 2, 2], [1, 1, 1])).toBe(false);
});

test("wrong values are dropped with a sentence, the rest is kept", () => {
  const found = accept(manifest, scene, texts("#room&wrong=1&camera.fov=60&model=shiny"), check);
  expect(found.settings).toEqual({ "camera.fov": 60, model: "shiny" });
  expect(found.problems).toEqual(["no 'wrong'"]);
});

test("values that are right only together are accepted in any order", () => {
  const hash = "#room&lights.lamp.inner=40&lights.lamp.outer=50";
  expect(accept(manifest, scene, texts(hash), check).problems).toEqual([]);
  const withWrong = accept(manifest, scene, texts(`${hash}&wrong=1`), check);
  expect(withWrong.settings).toEqual({ "lights.lamp.inner": 40, "lights.lamp.outer": 50 });
});

test("the page's own check refuses with the allowed values", () => {
  const real = (settings: Parameters<typeof resolve>[2]) => void resolve(manifest, scene, settings);
  const found = accept(manifest, scene, texts("#room&model=mat"), real);
  expect(found).toEqual({ settings: {}, problems: ["model: no 'mat'; allowed are: matt, shiny"] });
});

test("undo takes a whole gesture back, redo brings it again", () => {
  const store = new Store({ scene: "room", settings: {} });
  const shown: unknown[] = [];
  store.listen((state) => shown.push(state.settings));
  const fov = (value: number, gesture: string | null) =>
    store.set({ scene: "room", settings: { "camera.fov": value } }, gesture);
  fov(50, "drag");
  fov(55, "drag");
  store.release();
  fov(60, "drag");
  fov(60, "drag");
  expect(shown).toHaveLength(3);
  store.undo();
  expect(store.state.settings).toEqual({ "camera.fov": 55 });
  store.undo();
  expect(store.state.settings).toEqual({});
  store.undo();
  store.redo();
  expect(store.state.settings).toEqual({ "camera.fov": 55 });
  fov(70, null);
  expect(store.canRedo).toBe(false);
});

test("a gesture ends once nothing has followed for a while", () => {
  vi.useFakeTimers();
  const store = new Store({ scene: "room", settings: {} });
  const fov = (value: number) =>
    store.set({ scene: "room", settings: { "camera.fov": value } }, "key");
  fov(50);
  store.release(600);
  vi.advanceTimersByTime(599);
  fov(51);
  store.release(600);
  vi.advanceTimersByTime(601);
  fov(52);
  store.undo();
  expect(store.state.settings).toEqual({ "camera.fov": 51 });
  store.undo();
  expect(store.canUndo).toBe(false);
  vi.useRealTimers();
});
