import { describe, expect, test } from "vitest";
import { GraphicsError, general, shown } from "../src/core/errors";
import { unpack } from "../src/core/mesh";
import { createContext, Renderer } from "../src/core/render";

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
  const packed = new ArrayBuffer(8 + 4 * (12 * 3 + 3));
  new Uint32Array(packed, 0, 2).set([3, 3]);
  new Float32Array(packed, 8, 36).set(Array.from({ length: 36 }, (_, index) => index));
  new Uint32Array(packed, 8 + 144, 3).set([0, 1, 2]);

  test("gives its arrays", () => {
    const mesh = unpack(packed);
    expect([...mesh.positions]).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8]);
    expect(mesh.normals[0]).toBe(9);
    expect(mesh.uvs[0]).toBe(18);
    expect([...mesh.tangents.subarray(0, 4)]).toEqual([24, 25, 26, 27]);
    expect([...mesh.indices]).toEqual([0, 1, 2]);
  });

  test("of a wrong length is refused", () => {
    expect(() => unpack(packed.slice(0, 100))).toThrow(GraphicsError);
    expect(() => unpack(new ArrayBuffer(3))).toThrow("3 bytes are no mesh of 0 vertices");
  });
});

describe("a browser that lacks something", () => {
  const meshes = () => Promise.reject(new Error("no mesh"));

  test("WebGL2", () => {
    const canvas = { getContext: () => null } as unknown as OffscreenCanvas;
    expect(() => createContext(canvas)).toThrow("WebGL2 is missing");
  });

  test("float targets", () => {
    const gl = { isContextLost: () => false, getExtension: () => null };
    const make = () => new Renderer(gl as unknown as WebGL2RenderingContext, meshes);
    expect(make).toThrow(GraphicsError);
    expect(make).toThrow("EXT_color_buffer_float is missing");
  });

  test("the context itself", () => {
    const gl = { isContextLost: () => true };
    const make = () => new Renderer(gl as unknown as WebGL2RenderingContext, meshes);
    expect(make).toThrow("the browser took the graphics context away");
  });
});
