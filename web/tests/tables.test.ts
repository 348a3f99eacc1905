import { afterEach, expect, test, vi } from "vitest";
import { GraphicsError } from "../src/core/errors";
import { decoded } from "../src/core/half";
import { hierarchiesFrom, Tables } from "../src/core/tables";
import type { Plan, PlannedTable } from "../src/core/types";

/** Records its calls; constants are their names, and the largest texture has 2 rows. */
function fakeGl() {
  const calls: [name: string, ...rest: unknown[]][] = [];
  const get = (_: object, name: string) => {
    if (name === "TEXTURE0") return 0;
    if (/^[A-Z]/.test(name)) return name;
    return (...given: unknown[]) => {
      calls.push([name, ...given]);
      return name === "getParameter" ? 2 : {};
    };
  };
  const gl = new Proxy({}, { get }) as unknown as WebGL2RenderingContext;
  const uploads = () => calls.filter(([name]) => name === "texImage2D");
  return { calls, uploads, gl };
}

const meshes = (...keys: string[]): PlannedTable => ({ texels: [], meshes: keys });
const numbers = (...texels: number[]): PlannedTable => ({ texels, meshes: [] });
const planOf = (tables: Plan["tables"]) => ({ tables }) as Plan;

test("a table of texels fills rows of 1024, the rest 0", () => {
  const { calls, uploads, gl } = fakeGl();
  const texels = Array.from({ length: 4 * 1025 }, (_, index) => index);
  new Tables(gl, () => Promise.reject()).bind(3, "objects", numbers(...texels));
  const [, , , format, width, height, , layout, type, data] = uploads()[0]!;
  expect([format, width, height, layout, type]).toEqual(["RGBA32F", 1024, 2, "RGBA", "FLOAT"]);
  expect([...(data as Float32Array).subarray(4099, 4101)]).toEqual([4099, 0]);
  expect(calls).toContainEqual(["activeTexture", 3]);
  expect(calls).toContainEqual(["bindSampler", 3, null]);
  expect(calls).toContainEqual(["texParameteri", "TEXTURE_2D", "TEXTURE_MIN_FILTER", "NEAREST"]);
});

test("the same table is uploaded once, another in its place", () => {
  const { calls, uploads, gl } = fakeGl();
  const tables = new Tables(gl, () => Promise.reject());
  for (const first of [1, 1, 2]) tables.bind(0, "objects", numbers(first, 0, 0, 0));
  expect(uploads()).toHaveLength(2);
  expect(calls.filter(([name]) => name === "deleteTexture")).toHaveLength(1);
});

test("meshes are loaded once and follow a list of where each begins", async () => {
  const { uploads, gl } = fakeGl();
  const source = vi.fn((key: string) =>
    Promise.resolve(new Int32Array(key === "a" ? 8 : 4).fill(7)),
  );
  const tables = new Tables(gl, source);
  const planned = planOf({ meshes: meshes("a", "b") });
  expect(tables.has(planned)).toBe(false);
  expect(() => tables.bind(0, "meshes", meshes("a", "b"))).toThrow("the mesh a is not loaded");
  await Promise.all([tables.load(planned), tables.load(planned)]);
  expect(source.mock.calls.flat()).toEqual(["a", "b"]);
  expect(tables.has(planned)).toBe(true);
  tables.bind(0, "meshes", meshes("a", "b"));
  const [, , , format, width, height, , layout, type, data] = uploads()[0]!;
  expect([format, width, height, layout, type]).toEqual([
    "RGBA32I",
    2048,
    1,
    "RGBA_INTEGER",
    "INT",
  ]);
  const list = [2, 0, 0, 0, 4, 0, 0, 0];
  expect([...(data as Int32Array).subarray(0, 21)]).toEqual([...list, ...Array(12).fill(7), 0]);
});

test("a load that failed may be tried again", async () => {
  const source = vi.fn().mockRejectedValueOnce(new GraphicsError("no connection"));
  source.mockResolvedValue(new Int32Array(4));
  const tables = new Tables(fakeGl().gl, source);
  const planned = planOf({ meshes: meshes("a") });
  await expect(tables.load(planned)).rejects.toThrow("no connection");
  await tables.load(planned);
  expect(tables.has(planned)).toBe(true);
});

test("more than a texture holds is refused", () => {
  const tables = new Tables(fakeGl().gl, () => Promise.reject());
  const many = numbers(...Array<number>(4 * 2049).fill(0));
  expect(() => tables.bind(0, "objects", many)).toThrow("2049 texels are beyond this GL's 2048");
});

test("a table that was refused is no table that is there", () => {
  const tables = new Tables(fakeGl().gl, () => Promise.reject());
  const many = numbers(...Array<number>(4 * 2049).fill(0));
  for (const _ of [1, 2]) expect(() => tables.bind(0, "objects", many)).toThrow(GraphicsError);
});

test("what is cleared is not there", async () => {
  const { calls, gl } = fakeGl();
  const tables = new Tables(gl, () => Promise.resolve(new Int32Array(4)));
  const planned = planOf({ meshes: meshes("a") });
  await tables.load(planned);
  tables.bind(0, "meshes", meshes("a"));
  tables.clear();
  expect(tables.has(planned)).toBe(false);
  expect(calls.filter(([name]) => name === "deleteTexture")).toHaveLength(1);
});

afterEach(() => vi.unstubAllGlobals());

test.each([
  [
    () => Promise.reject(new TypeError("offline")),
    "the mesh a cannot be loaded for rays (no connection)",
  ],
  [() => Promise.resolve(new Response("", { status: 404 })), "for rays (status 404)"],
  [() => Promise.resolve(new Response(new Uint8Array(20))), "20 bytes are no hierarchy of a mesh"],
  [() => Promise.resolve(new Response(null)), "0 bytes are no hierarchy of a mesh"],
])("a file that is no hierarchy: %#", async (answer, message) => {
  vi.stubGlobal("fetch", answer);
  await expect(hierarchiesFrom("data/hierarchies")("a")).rejects.toThrow(message);
});

test("a file of texels is read as they are", async () => {
  const fetch = vi.fn(async () => new Response(new Int32Array([1, -2, 3, 4])));
  vi.stubGlobal("fetch", fetch);
  expect([...(await hierarchiesFrom("data/hierarchies")("a"))]).toEqual([1, -2, 3, 4]);
  expect(fetch.mock.calls.flat()).toEqual(["data/hierarchies/a.bin"]);
});

test("sRGB codes are the half floats that numpy makes of them", () => {
  const codes = Uint8Array.from({ length: 1024 }, (_, at) => at >> 2);
  const halves = decoded(codes);
  const sum = (channel: number) =>
    Array.from({ length: 256 }, (_, code) => halves[4 * code + channel]! * (code + 1)).reduce(
      (a, b) => a + b,
    );
  expect([0, 1, 2, 3].map(sum)).toEqual([450252201, 450252201, 450252201, 478988342]);
  const some = [1, 10, 11, 128, 255].map((code) => halves[4 * code]);
  expect(some).toEqual([3321, 6711, 6875, 13032, 15360]);
  expect(halves[4 * 128 + 3]).toBe(14340);
});
