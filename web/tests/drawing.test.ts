import { expect, test } from "vitest";
import { Drawing, type Equipment } from "../src/core/drawing";
import type { Geometry } from "../src/core/geometry";
import type { CompiledProgram } from "../src/core/program";
import { same } from "../src/core/same";
import type { Tables } from "../src/core/tables";
import type { Framebuffer } from "../src/core/targets";
import type { Textures } from "../src/core/textures";
import type { Batch, Plan, PlannedPass } from "../src/core/types";

/** Records its calls; everything else of it is 0. */
function fakeGl() {
  const calls: [name: string, ...rest: unknown[]][] = [];
  const get = (_: object, name: string) =>
    /^[A-Z]/.test(name) ? name : (...given: unknown[]) => void calls.push([name, ...given]);
  return { calls, gl: new Proxy({}, { get }) as unknown as WebGL2RenderingContext };
}

const batch: Batch = {
  ...{ program: 0, tile: null, cull: true, blend: null, uniforms: { u_far: [1, 2] } },
  draws: [{ mesh: "cube", uniforms: {}, textures: {}, arrays: {}, tables: {} }],
};

function pass(given: Partial<PlannedPass> = {}): PlannedPass {
  const plain = { name: "map", target: "map", clear: [0, 0, 0, 1], keep: true, samplers: {} };
  return structuredClone({ ...plain, batches: [batch], ...given });
}

function bench() {
  const { calls, gl } = fakeGl();
  const bound: unknown[][] = [];
  const bind = (...given: unknown[]) => void bound.push(given);
  const nothing = { draw: () => {}, use: () => {}, set: () => {}, bind };
  const [geometry, textures] = [nothing as unknown as Geometry, nothing as unknown as Textures];
  const drawing = new Drawing(gl, geometry, textures, nothing as unknown as Tables);
  const target = { size: [8, 4], format: "r32f", depth: true };
  const read = { textures: {}, arrays: {}, tables: {} };
  const plan = { targets: { map: target, picture: target }, ...read } as unknown as Plan;
  const program = nothing as unknown as CompiledProgram;
  const framebuffer = {} as Framebuffer;
  const equipment: Equipment = {
    plan,
    programs: [program],
    framebuffers: new Map([["map", framebuffer]]),
  };
  const runs = (planned: PlannedPass, given: Partial<Equipment> = {}) => {
    drawing.pass(planned, { ...equipment, ...given });
    return drawing.runs[planned.name];
  };
  return { calls, bound, plan, program, runs, framebuffer };
}

test("a pass to keep runs again only when it has changed", () => {
  const { runs } = bench();
  expect(runs(pass())).toBe(1);
  expect(runs(pass())).toBe(1);
  expect(runs(pass({ batches: [{ ...batch, uniforms: { u_far: [1, 3] } }] }))).toBe(2);
  expect(runs(pass())).toBe(3);
});

test("and for another program or another target", () => {
  const { runs, program } = bench();
  expect(runs(pass())).toBe(1);
  expect(runs(pass(), { programs: [{ ...program } as CompiledProgram] })).toBe(2);
  expect(runs(pass(), { framebuffers: new Map([["map", {} as Framebuffer]]) })).toBe(3);
});

test.each(["textures", "arrays", "tables"] as const)("and for other %s that it reads", (kind) => {
  const { runs, plan } = bench();
  const draws = [{ ...batch.draws[0]!, [kind]: { u_read: "mine" } }];
  const reading = () => pass({ batches: [{ ...batch, draws }] });
  const having = (all: object) => ({ plan: { ...plan, [kind]: all } as unknown as Plan });
  expect(runs(reading(), having({ mine: { texels: [1] } }))).toBe(1);
  expect(runs(reading(), having({ mine: { texels: [1] }, other: {} }))).toBe(1);
  expect(runs(reading(), having({ mine: { texels: [2] } }))).toBe(2);
});

test("tables take the first units after the targets, then textures and arrays", () => {
  const { bound, runs, plan } = bench();
  const named = { textures: { u_t: "t" }, arrays: { u_a: "a" }, tables: { u_o: "o", u_m: "m" } };
  const there = { textures: { t: 1 }, arrays: { a: 2 }, tables: { o: 3, m: 4 } };
  const draws = [{ ...batch.draws[0]!, ...named }];
  const equipment = {
    plan: { ...plan, ...there } as unknown as Plan,
    framebuffers: new Map([["map", { texture: {} } as Framebuffer]]),
  };
  runs(pass({ samplers: { u_map: "map" }, batches: [{ ...batch, draws }] }), equipment);
  expect(bound).toEqual([
    [1, "o", 3],
    [2, "m", 4],
    [3, 1],
    [4, 2],
  ]);
});

test("and where something else has drawn since, or to the canvas", () => {
  const { runs } = bench();
  expect(runs(pass())).toBe(1);
  expect(runs(pass({ name: "other", keep: false }))).toBe(1);
  expect(runs(pass())).toBe(2);
  expect(runs(pass({ target: "picture" }))).toBe(3);
  expect(runs(pass({ target: "picture" }))).toBe(4);
});

test("a pass that fails has drawn nothing to keep", () => {
  const { runs, program } = bench();
  expect(runs(pass())).toBe(1);
  const broken = {
    ...program,
    use: () => {
      throw new Error("lost");
    },
  };
  const changed = pass({ clear: null });
  expect(() => runs(changed, { programs: [broken as unknown as CompiledProgram] })).toThrow();
  expect(runs(pass())).toBe(3);
});

test("what blends leaves the depth buffer as it is, and clearing does not", () => {
  const { calls, runs } = bench();
  const clear = { ...batch, blend: "over", cull: false, tile: [2, 3, 4] };
  runs(pass({ batches: [batch, clear] }));
  const order = calls.filter(([name]) => ["depthMask", "clearBufferfv", "viewport"].includes(name));
  expect(order.map((call) => call.slice(0, 2))).toEqual([
    ["depthMask", true],
    ["clearBufferfv", "COLOR"],
    ["clearBufferfv", "DEPTH"],
    ["depthMask", true],
    ["viewport", 0],
    ["depthMask", false],
    ["viewport", 2],
  ]);
  expect(calls).toContainEqual(["disable", "CULL_FACE"]);
  expect(calls).toContainEqual(["blendFunc", "SRC_ALPHA", "ONE_MINUS_SRC_ALPHA"]);
});

test.each([
  [1, 1, true],
  [[1, [2, { a: null }]], [1, [2, { a: null }]], true],
  [{ a: 1, b: [2] }, { b: [2], a: 1 }, true],
  [[1, 2], [1, 3], false],
  [[1], [1, undefined], false],
  [{ a: undefined }, { b: undefined }, false],
  [[], {}, false],
  [null, {}, false],
  ["1", 1, false],
])("%o and %o are the same: %s", (a, b, alike) => {
  expect(same(a, b)).toBe(alike);
  expect(same(b, a)).toBe(alike);
});
