import { describe, expect, test } from "vitest";
import { fromHex, hue, isHex, level, toHex } from "../src/color";
import { countInvalid } from "../src/invalid";
import { decimals, niceCeiling, niceStep, shorten, snap, spell } from "../src/number";
import { readPart, writePart } from "../src/parts";
import { display, fromPosition, pretty, type Scale, stepped, toPosition } from "../src/scale";
import { address, compare } from "../src/server";
import { shortRenderer } from "../src/status";

test("numbers are as short as they can be", () => {
  expect(shorten(0.1 + 0.2)).toBe(0.3);
  expect([0.01, 1, 0.05, 1e-4, 2.5e-7].map(decimals)).toEqual([2, 0, 2, 4, 8]);
  expect(snap(0.3499, 0.01)).toBe(0.35);
  expect([1, 110, 100, 0.5].map((range) => niceStep(range))).toEqual([0.01, 1, 1, 0.001]);
  expect([0.9, 6.4, 56, 240, 1000].map(niceCeiling)).toEqual([1, 10, 100, 500, 1000]);
  expect([0, 20480, 2.34567, 1e-5, 3e8].map((n) => spell(n, 5))).toEqual([
    "0",
    "20\u202f480",
    "2.3457",
    "1e-5",
    "3e8",
  ]);
});

describe("colours", () => {
  test("every code comes back", () => {
    for (let code = 0; code < 256; code += 1) {
      const hex = code.toString(16).padStart(2, "0").repeat(3);
      expect(toHex(fromHex(hex))).toBe(hex);
    }
    expect(isHex("#C8503c")).toBe(true);
    expect(isHex("c8503")).toBe(false);
  });

  test("a bright colour is a hue and a strength", () => {
    expect(level([12, 6, 3])).toBe(12);
    expect(hue([12, 6, 3])).toEqual([1, 0.5, 0.25]);
    expect(hue([0, 0, 0])).toEqual([1, 1, 1]);
    expect(writePart([12, 6, 3], "level", 4)).toEqual([4, 2, 1]);
    expect(writePart([2, 0, 0], "hue", "00ff00")).toEqual([0, 2, 0]);
  });
});

test("a direction has two angles, and they come back", () => {
  expect(readPart([0, -1, 0], "elevation")).toBe(-90);
  for (const azimuth of [-170, -45, 0, 90, 180]) {
    const v = writePart(writePart([0, 0, 1], "azimuth", azimuth), "elevation", -40);
    expect(readPart(v, "azimuth")).toBeCloseTo(azimuth, 2);
    expect(readPart(v, "elevation")).toBeCloseTo(-40, 2);
  }
  const down = writePart([1, 0, 1], "elevation", -90);
  expect(readPart(down, "azimuth")).toBeCloseTo(45, 0);
  expect(writePart([1, 2, 3], "y", 7)).toEqual([1, 7, 3]);
});

describe("a slider", () => {
  const plain: Scale = {
    label: "",
    unit: "",
    low: 0,
    high: 1,
    min: 0,
    max: 1,
    step: 0.01,
    log: false,
  };
  const log: Scale = { ...plain, low: 0, high: 1e6, max: 1e6, step: 0.1, log: true };

  test("maps positions to values and back", () => {
    expect(fromPosition(plain, 0.352)).toBe(0.35);
    expect(toPosition(plain, 2)).toBe(1);
    expect(fromPosition(log, 0)).toBe(0);
    expect(fromPosition(log, 1)).toBe(1e6);
    for (const value of [0.2, 4, 250, 1e5]) {
      expect(fromPosition(log, toPosition(log, value))).toBeCloseTo(value, 6);
    }
  });

  test("steps by keys, ten at once with shift, never beyond its ends", () => {
    expect(stepped(plain, 0.35, 1)).toBe(0.36);
    expect(stepped(plain, 0.35, 10)).toBe(0.45);
    expect(stepped(plain, 0.95, 10)).toBe(1);
    expect(stepped(log, 4, 1)).toBeGreaterThan(4);
    expect(stepped(log, 4, -1)).toBeLessThan(4);
    expect(stepped(log, 1e6, 1)).toBe(1e6);
  });

  test("shows what was typed, however fine", () => {
    expect(display(plain, 0.35)).toBe("0.35");
    expect(display(plain, 0.00025)).toBe("0.00025");
    expect(display({ ...plain, step: 1 }, 45.5)).toBe("45.5");
    expect(display(log, 1234.56)).toBe("1235");
    expect([pretty("cd/m^2"), pretty("deg"), pretty("1/m")]).toEqual(["cd/m²", "°", "1/m"]);
  });
});

test("invalid pixels are counted once, by the worst of their channels", () => {
  const pixels = [
    [0, 1, 2],
    [Number.NaN, -1, 0],
    [Number.POSITIVE_INFINITY, -1, 0],
    [0, -1, 0],
    [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, 0],
    [3e38, 3e38, 3e38],
  ];
  const data = new Float32Array(pixels.flatMap((pixel) => [...pixel, 1]));
  expect(countInvalid(data)).toEqual({ nan: 1, inf: 2, negative: 1 });
  expect(countInvalid(data, true)).toEqual({ nan: 1, inf: 2, negative: 0 });
});

test("two pictures differ by pixels and codes; alpha does not count", () => {
  expect(compare([1, 2, 3, 255, 9, 9, 9, 255], [1, 2, 3, 0, 9, 4, 9, 255])).toEqual({
    pixels: 1,
    largest: 5,
  });
});

test("the server is asked for the state's names", () => {
  const state = { scene: "lab/shadows", settings: { "camera.eye": [1, 2, 3], model: "phong" } };
  expect(address(state, [640, 480])).toBe(
    "api/render/lab/shadows.png?width=640&height=480&camera.eye=1,2,3&model=phong",
  );
});

test.each([
  [
    "ANGLE (Mesa, llvmpipe (LLVM 15.0.6 256 bits), OpenGL ES 3.2)",
    "llvmpipe (LLVM 15.0.6 256 bits)",
  ],
  [
    "ANGLE (NVIDIA, NVIDIA GeForce RTX 3060 Direct3D11 vs_5_0 ps_5_0, D3D11)",
    "NVIDIA GeForce RTX 3060",
  ],
  ["Apple GPU", "Apple GPU"],
])("%s is %s", (name, short) => {
  expect(shortRenderer(name)).toBe(short);
});
