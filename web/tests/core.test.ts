import { describe, expect, test } from "vitest";
import { createContext } from "../src/core/context";
import { GraphicsError, general, shown } from "../src/core/errors";
import { unpack } from "../src/core/mesh";
import { Renderer } from "../src/core/render";

describe("values in messages", () => {
  test.each([
    [5, "5"],
    [-0, "0"],
    [1e-7, "1e-07"],
    [0.0001, "0.0001"],
    [1e15, "1000000000000000"],
    [1.5e300, "1.5e+300"],
    [Number.NaN, "nan"],
    [-Infinity, "-inf"],
    ["it's", `"it's"`],
    [`it's "x"\n`, `'it\\'s "x"\\n'`],
    [[1, "2", [true, null]], "[1, '2', [True, None]]"],
  ])("%o is shown as Python shows it", (value, text) => expect(shown(value)).toBe(text));

  test.each([
    [1234567, "1.23457e+06"],
    [123456.7, "123457"],
    [0.00001, "1e-05"],
    [35, "35"],
    [0.1 + 0.2, "0.3"],
  ])("%o with six digits", (value, text) => expect(general(value)).toBe(text));
});

describe("a packed mesh", () => {
  /** Of three vertices, whose numbers count up, and one triangle. */
  function packed(flags: number, components: number): ArrayBuffer {
    const numbers = 3 * components;
    const data = new ArrayBuffer(12 + 4 * (numbers + 3));
    new Uint32Array(data, 0, 3).set([3, 3, flags]);
    new Float32Array(data, 12, numbers).set(Array.from({ length: numbers }, (_, index) => index));
    new Uint32Array(data, 12 + 4 * numbers, 3).set([0, 1, 2]);
    return data;
  }

  test("gives its arrays", () => {
    const mesh = unpack(packed(0, 12));
    expect([...mesh.positions]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8]);
    expect(mesh.normals[0]).toBe(9);
    expect(mesh.uvs[0]).toBe(18);
    expect([...mesh.tangents.subarray(0, 4)]).toEqual([24, 25, 26, 27]);
    expect([...mesh.indices]).toEqual([0, 1, 2]);
    expect([mesh.colors, mesh.uvs1]).toEqual([null, null]);
  });

  test.each([
    [1, 16, 36, null],
    [2, 14, null, 36],
    [3, 18, 36, 48],
  ])("with flags %i gives its optional arrays", (flags, components, color, uv1) => {
    const mesh = unpack(packed(flags, components));
    expect(mesh.colors?.[0] ?? null).toBe(color);
    expect(mesh.colors?.length ?? 12).toBe(12);
    expect(mesh.uvs1?.[0] ?? null).toBe(uv1);
    expect(mesh.uvs1?.length ?? 6).toBe(6);
    expect([...mesh.indices]).toEqual([0, 1, 2]);
  });

  test("of a wrong length is refused", () => {
    expect(() => unpack(packed(0, 12).slice(0, 100))).toThrow(GraphicsError);
    expect(() => unpack(packed(1, 12))).toThrow("are no mesh of 3 vertices");
    expect(() => unpack(new ArrayBuffer(3))).toThrow("3 bytes are no mesh of 0 vertices");
  });
});

describe("a browser that lacks something", () => {
  const missing = () => Promise.reject(new Error("not there"));
  const assets = { mesh: missing, image: missing, hierarchy: missing };

  test("WebGL2", () => {
    const canvas = { getContext: () => null } as unknown as OffscreenCanvas;
    expect(() => createContext(canvas)).toThrow("WebGL2 is missing");
  });

  test("float targets", () => {
    const gl = { isContextLost: () => false, getExtension: () => null };
    const make = () => new Renderer(gl as unknown as WebGL2RenderingContext, assets);
    expect(make).toThrow(GraphicsError);
    expect(make).toThrow("EXT_color_buffer_float is missing");
  });

  test("the context itself", () => {
    const gl = { isContextLost: () => true };
    const make = () => new Renderer(gl as unknown as WebGL2RenderingContext, assets);
    expect(make).toThrow("the browser took the graphics context away");
  });
});
