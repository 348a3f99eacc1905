import { expect, test } from "vitest";
import { put } from "../src/access";
import { fieldControls } from "../src/control";
import { describe as content, tabOf } from "../src/controls";
import type { LibraryMaterial, Material, Scene, TextureMap } from "../src/core/types";
import { coupled, derived } from "../src/derived";
import { defaultOf, parse, type Values } from "../src/fields";
import { materialFields } from "../src/material_controls";
import { readPart, writePart } from "../src/parts";
import { Store } from "../src/store";
import { mark, symbolOf } from "../src/symbols";
import { lightOf, seatsOf } from "../src/views";
import { manifest, scene, situation } from "./bench";

const map: TextureMap = {
  ...{ texture: "bumps", channels: "rgba", uv: 0, rotation: 0 },
  ...{ offset: [0, 0], scale: [1, 1] },
};

const names = (groups: ReturnType<typeof content>, id: string) =>
  groups.find((group) => group.id === id)?.controls.map((c) => c.name + (c.part ?? "")) ?? null;

/** Fields of every material that is lit: how it emits, and whether light goes through it. */
const ALWAYS = ["emissivehue", "emissivelevel", "alpha_mode", "double_sided", "unlit"];
const wall = (groups: ReturnType<typeof content>) =>
  names(groups, "materials.wall")?.map((name) => name.replace("materials.wall.", ""));

test("a choice stands where its function belongs", () => {
  const tabs = Object.values(manifest.folders).map((folder) => tabOf(folder));
  expect(tabs).toEqual(["model", "picture", "lights", "lights", "lights"]);
  expect(tabOf({ ...manifest.folders.shadows!, function: "float outline(ivec2 pixel)" })).toBe(
    "picture",
  );
});

test("only what is in use is shown", () => {
  const matt = content(situation({}, { model: "matt", tonemap: "none" }));
  expect(wall(matt)).toEqual([...["library", "base_color"], ...ALWAYS, "model"]);
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

function walled(fields: Partial<Material>, settings = {}) {
  const now = situation(settings, { model: "matt" });
  const materials = { wall: { ...scene.materials.wall!, ...fields } as Material };
  return wall(content({ ...now, scene: { ...scene, materials } }));
}

test("a material shows what matters for what it is", () => {
  expect(walled({ alpha_mode: "blend" })).toContain("opacity");
  expect(walled({ alpha_mode: "blend" })).not.toContain("alpha_cutoff");
  expect(walled({ alpha_mode: "mask" })).toContain("alpha_cutoff");
  expect(walled({ unlit: true })).toEqual([
    ...["library", "base_color", "alpha_mode", "double_sided", "unlit"],
  ]);
  const bumps = { normal: map };
  expect(walled({ maps: bumps })).toContain("normal_scale");
  expect(walled({ maps: bumps, unlit: true })).not.toContain("normal_scale");
});

test("a material may make its own choice, or the scene's", () => {
  const options = (preset: Scene) => {
    const groups = content({ ...situation({}, { model: "matt" }), preset });
    const fold = groups.find((group) => group.id === "materials.wall")!;
    const menu = fold.controls.find(({ name }) => name === "materials.wall.model");
    return menu?.options.map(({ value }) => value);
  };
  expect(options(scene)).toEqual(["auto", "matt", "shiny"]);
  const wall = { ...scene.materials.wall!, model: "shiny" };
  expect(options({ ...scene, materials: { wall } })).toEqual(["matt", "shiny"]);
});

test("a choice that is off is offered, of lights where there are any", () => {
  const now = situation({}, { model: "matt" });
  const ids = (situated: typeof now) => content(situated).map((group) => group.id);
  expect(ids(now)).toContain("shadow");
  expect(ids({ ...now, scene: { ...scene, lights: {} } })).not.toContain("shadow");
  expect(ids({ ...now, settings: { shadow: "hard" } })).not.toContain("shadow");
  expect(names(content(now), "lights.lamp")).not.toContain("lights.lamp.casts");
  const drawn = content(situation({ shadow: "hard" }, { model: "matt", shadow: "hard" }));
  expect(names(drawn, "lights.lamp")).toContain("lights.lamp.casts");
  expect(names(drawn, "lights.lamp")).toContain("lights.lamp.far");
});

test("the camera shows what its projection has, and nothing of its own from a light", () => {
  const camera = (settings: Values) =>
    names(content(situation(settings, { model: "matt" })), "camera")!;
  expect(camera({})).toContain("camera.fov");
  expect(camera({})).not.toContain("camera.height");
  expect(camera({ "camera.projection": "orthographic" })).toContain("camera.height");
  expect(camera({ "camera.projection": "orthographic" })).not.toContain("camera.fov");
  expect(camera({ "camera.light": "lamp" })).toEqual([]);
});

test("a library material stands under a material's own values", () => {
  const above = { "materials.wall.library": "gold" };
  const value = (field: string, settings = {}) =>
    defaultOf(manifest, scene, `materials.wall.${field}`, settings);
  expect([value("roughness"), value("roughness", above)]).toEqual([0.5, 0.2]);
  expect([value("f0", above), value("opacity", above)]).toEqual(["auto", 1]);
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
  expect(derived(scene, "lights.lamp.far")).toBe(4.04); // 3 m to the ball, 1 m more, 1 % room
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

const GOLD = {
  ...{ title: "Gold", source: "a table", base_color: [1, 0.8, 0.3], metalness: 1, roughness: 0.2 },
  ...{ f0: null, ior: null, eta: [0.2, 0.4, 1.4], k: [3, 2, 1], kd: null, ks: null, shininess: 9 },
} as LibraryMaterial;
const stocked = { ...manifest, materials: { gold: GOLD } };

test("a library material is the default of what it brings along", () => {
  const gold = { "materials.wall.library": "gold" };
  expect(defaultOf(stocked, scene, "materials.wall.roughness", {})).toBe(0.5);
  expect(defaultOf(stocked, scene, "materials.wall.roughness", gold)).toBe(0.2);
  expect(defaultOf(stocked, scene, "materials.wall.kd", gold)).toBe("auto");
  expect(defaultOf(stocked, scene, "materials.wall.opacity", gold)).toBe(1);
});

test("another library material replaces what was set of its fields, and nothing else", () => {
  const settings = { "materials.wall.roughness": 0.9, "materials.other.roughness": 0.9, fov: 3 };
  const store = new Store({ scene: "room", settings });
  put(store, { ...situation({}, {}), manifest: stocked }, "materials.wall.library", "gold");
  expect(store.state.settings).toEqual({
    ...{ "materials.other.roughness": 0.9, fov: 3, "materials.wall.library": "gold" },
  });
});

test("the two parts of a complex index are given together", () => {
  const name = "materials.wall.eta";
  const { "materials.wall.k": k } = coupled(scene, name, [1, 2, 3]);
  expect(k).toEqual([0, 0, 0]);
  expect(coupled(scene, name, "auto")).toEqual({ "materials.wall.k": "auto" });
  const wall = { ...scene.materials.wall!, eta: GOLD.eta, k: GOLD.k };
  expect(coupled({ ...scene, materials: { wall } }, name, [1, 2, 3])).toEqual({});
});

test("a scene is seen from its cameras and its lights", () => {
  const seats = seatsOf({ ...scene, views: { from_above: scene.camera } });
  expect(seats.map(({ title, of }) => `${of}: ${title}`)).toEqual([
    "Cameras: The scene's view",
    "Cameras: From above",
    "Lights: Light: Lamp",
  ]);
  expect(seats.map(({ name }) => lightOf(name))).toEqual([null, null, "lamp"]);
});

/** A head with an eye and an antenna. */
function jointed(settings = {}) {
  const part = { parent: null, position: [0, 0], rotation: 0, scale: [0.2, 0.1], width: 2 };
  const parts = {
    head: { ...part, shape: "square", color: [1, 1, 1] },
    eye: { ...part, shape: "circle", scale: [0.1, 0.1], parent: "head", color: [1, 0, 0] },
    antenna: { ...part, shape: "line", parent: "head", color: [1, 1, 1] },
  };
  const flat = { ...scene, materials: {}, objects: {}, lights: {}, parts } as unknown as Scene;
  return situation(settings, {}, flat);
}

test("a part shows what changes it, and its joint stands first", () => {
  const groups = content(jointed());
  expect(groups.slice(0, 4).map(({ id }) => id)).toEqual([
    ...["joints", "parts.head", "parts.eye", "parts.antenna"],
  ]);
  expect(names(groups, "joints")).toEqual(["parts.head.rotation"]);
  const fields = (name: string) =>
    names(groups, `parts.${name}`)?.map((field) => field.replace(`parts.${name}.`, ""));
  const place = ["positionx", "positiony"];
  const line = ["colorhue", "colorlevel", "width"];
  expect(fields("head")).toEqual(["rotation", ...place, "scalex", "scaley", ...line]);
  expect(fields("eye")).toEqual([...place, "scaleall", ...line]);
  expect(fields("antenna")).toEqual(["rotation", ...place, "scalex", ...line]);
  expect(groups.find(({ id }) => id === "parts.eye")?.about).toBe("Hangs on: Head.");
  expect(groups.some(({ tab }) => tab === "camera")).toBe(false);
});

test("a circle's radius is both of its factors", () => {
  expect(writePart([0.1, 0.1], "all", 0.3)).toEqual([0.3, 0.3]);
  expect(readPart([0.1, 0.1], "all")).toBe(0.1);
  expect(writePart([0.1, 0.2], "y", 0.3)).toEqual([0.1, 0.3]);
});

test("a link may give one factor for all", () => {
  const { manifest: menu, scene: flat } = jointed();
  expect(parse(menu, flat, "parts.eye.scale", "0.3")).toEqual([0.3, 0.3]);
  expect(parse(menu, flat, "parts.head.scale", "0.3,0.2")).toEqual([0.3, 0.2]);
  expect(parse(menu, flat, "parts.head.scale", "wide")).toBe("wide");
  expect(parse(menu, flat, "parts.head.rotation", "30")).toBe(30);
});
