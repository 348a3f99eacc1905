import { expect, test } from "vitest";
import { fieldControls } from "../src/control";
import { describe as content, materialFields, tabOf } from "../src/controls";
import { coupled, derived } from "../src/derived";
import { mark, symbolOf } from "../src/symbols";
import { manifest, scene, situation } from "./bench";

const names = (groups: ReturnType<typeof content>, id: string) =>
  groups.find((group) => group.id === id)?.controls.map((c) => c.name + (c.part ?? "")) ?? null;

test("a choice stands where its function belongs", () => {
  const tabs = Object.values(manifest.folders).map((folder) => tabOf(folder));
  expect(tabs).toEqual(["model", "picture", "lights", "lights"]);
});

test("only what is in use is shown", () => {
  const matt = content(situation({}, { model: "matt", tonemap: "none" }));
  expect(names(matt, "materials.wall")).toEqual(["materials.wall.base_color"]);
  expect(names(matt, "attenuation")).toBeNull();
  expect(names(matt, "lights.lamp")).not.toContain("lights.lamp.c0");
  const now = content(situation({}, { model: "matt", attenuation: "poly", tonemap: "curve" }));
  expect(names(now, "lights.lamp")).toContain("lights.lamp.c0");
  expect(names(now, "attenuation")).toEqual(["c0"]);
  expect(names(now, "tonemap")).toEqual(["L_white"]);
});

test("a pass that is off keeps the switch that turns it on", () => {
  expect(names(content(situation({}, { model: "matt" })), "quality")).toEqual(["samples"]);
});

test("a material shows what the chosen files read, and what that follows from", () => {
  const all = ["kd", "ks", "shininess"];
  const auto = materialFields(all, () => true);
  expect([...auto].sort()).toEqual(
    ["base_color", "f0", "ior", "kd", "ks", "metalness", "roughness", "shininess"].sort(),
  );
  expect([...materialFields(all, () => false)]).toEqual(all);
  expect([...materialFields(["f0"], (f) => f !== "f0")]).toEqual(["f0", "base_color", "metalness"]);
});

test("sliders take reach, limits and unit from the schema and the scene", () => {
  const now = content(situation({}, { model: "shiny" }));
  const lamp = now.find((group) => group.id === "lights.lamp")!.controls;
  const intensity = lamp.find((control) => control.name === "lights.lamp.intensity")!;
  expect(intensity).toMatchObject({ unit: "cd", low: 0, high: 100, max: 1e30, step: 0.1 });
  const [fov] = fieldControls({ manifest, scene }, "camera.fov");
  expect(fov).toMatchObject({ low: 10, high: 120, min: 1, max: 170, step: 1 });
  const ks = fieldControls({ manifest, scene }, "materials.wall.ks");
  expect(ks.map((control) => control.part)).toEqual(["hue", "level"]);
  expect(fieldControls({ manifest, scene }, "materials.wall.shininess")[0]).toMatchObject({
    log: true,
    optional: true,
  });
});

test("what is auto shows what it comes to", () => {
  expect(derived(scene, "materials.wall.ior")).toBe(1.5);
  expect(derived(scene, "materials.wall.f0")).toEqual([0.04, 0.04, 0.04]);
  expect(derived(scene, "materials.wall.kd")).toEqual([0.8, 0.8, 0.8]);
  expect(derived(scene, "materials.wall.shininess")).toBe(30);
});

test("what only fits together is changed together", () => {
  expect(coupled(scene, "lights.lamp.inner", 30)).toEqual({ "lights.lamp.outer": 30 });
  expect(coupled(scene, "lights.lamp.inner", 20)).toEqual({});
  expect(coupled(scene, "lights.lamp.outer", 10)).toEqual({ "lights.lamp.inner": 10 });
  expect(coupled(scene, "materials.wall.f0", [0, 0, 0])).toEqual({ "materials.wall.ior": "auto" });
});

test.each([
  ["materials.wall.roughness", "\\alpha"],
  ["L_white", "L_w"],
  ["lights.lamp.c2", "c_2"],
  ["gamma", "\\gamma"],
  ["exposure", "\\mathrm{exposure}"],
])("%s moves %s", (name, symbol) => {
  expect(symbolOf(name)).toBe(symbol);
});

test("symbols are marked alone, with their powers, and nowhere else", () => {
  expect(mark("\\frac{\\alpha^2}{\\pi}", ["\\alpha"])).toBe(
    "\\frac{{\\htmlClass{symbol-0}{\\alpha^2}}}{\\pi}",
  );
  expect(mark("k_s (r \\cdot v)^s \\cos", ["s", "k_s"])).toBe(
    "{\\htmlClass{symbol-1}{k_s}} (r \\cdot v)^{\\htmlClass{symbol-0}{s}} \\cos",
  );
  expect(mark("c_0 + c_1 d", ["c_1"])).toBe("c_0 + {\\htmlClass{symbol-0}{c_1}} d");
  expect(mark("x", [])).toBe("x");
});
