import { describe, expect, it } from "vitest";
import { compare, type Precision, step } from "../src/atlas_error";
import type { Axis } from "../src/atlas_gl";
import { scale, summary, ticks } from "../src/atlas_scale";

const SINGLE: Precision = {
  name: "float32",
  bits: 24,
  tiny: 2 ** -126,
  negligible: 1e-30,
  half: false,
  full: 2 ** 23,
};
const HALF: Precision = {
  name: "half",
  bits: 11,
  tiny: 2 ** -14,
  negligible: 0,
  half: true,
  full: 2 ** 10,
};

function panel(got: number[], want: number[], components = 1, precision = SINGLE) {
  const form = { file: "a.glsl", textbook: false, exact: true, components, precision };
  return compare(form, Float32Array.from(got), Float64Array.from(want));
}

describe("errors", () => {
  it("are counted in steps of the precision at the true value", () => {
    expect(step(1, SINGLE)).toBe(2 ** -23);
    expect(step(-1.5, SINGLE)).toBe(2 ** -23);
    expect(step(0.999, SINGLE)).toBe(2 ** -24);
    expect(step(0, SINGLE)).toBe(2 ** -149);
    expect(step(1, HALF)).toBe(2 ** -10);
    expect(step(0, HALF)).toBe(2 ** -24);
  });

  it("tell what is no valid value, and what is infinite in truth", () => {
    const got = [1, NaN, Infinity, -1, -1, 1, 2, 1e-35];
    const found = panel(got, [1, 1, 1, 1, -1, Infinity, 1, 0]);
    expect([...found.kind]).toEqual([0, 1, 2, 3, 0, 4, 0, 0]);
    expect([...found.ulp]).toEqual([0, 0, 0, 0, 0, 0, 2 ** 23, 0]);
    expect(found.shares.unknown).toBe(1 / 8);
    expect(found.shares.wrong).toBe(4 / 7);
    expect([found.median, found.largest]).toEqual([0, 2 ** 23]);
  });

  it("of a vector are its worst component's", () => {
    const found = panel([1, 2, 1, Infinity, 1, NaN], [1, 1, 1, 1, 1, 1], 2);
    expect([...found.kind]).toEqual([0, 2, 1]);
    expect(found.ulp[0]).toBe(2 ** 23);
  });
});

describe("words and marks", () => {
  const axis = { name: "a", label: "a", at: 1, unit: "", log: false, zero: false };

  it("sum a map up", () => {
    expect(summary(panel([1, 1], [1, 1]))).toBe(
      "Off by 0 ULP in the median and 0 at worst; every value is valid.",
    );
    expect(summary(panel([NaN, 1], [1, 1]))).toContain("not a valid value at 50\u202f%");
    expect(summary(panel([2], [1]))).toContain("no right digit at worst");
    expect(summary(panel([2], [Infinity]))).toBe("The true value is infinite everywhere.");
  });

  it("mark powers of ten, the zeros, and round steps", () => {
    const log: Axis = { ...axis, low: 1e-4, high: 1, log: true, zero: true, values: [0, 0, 1, 1] };
    expect(ticks(log).map(({ text }) => text)).toEqual(["0", "1", "0.1", "0.01", "10⁻³", "10⁻⁴"]);
    expect(ticks(log).map(({ at }) => at)).toEqual([0.25, 1, 0.875, 0.75, 0.625, 0.5]);
    const angle: Axis = { ...axis, low: 0, high: 90, unit: "°", values: [0, 90] };
    expect(ticks(angle).map(({ text }) => text)).toEqual(["0", "30", "60", "90"]);
    const plain: Axis = { ...axis, low: 0, high: 1, values: [0, 1] };
    expect(ticks(plain).map(({ text }) => text)).toEqual(["0", "0.2", "0.4", "0.6", "0.8", "1"]);
    expect(scale(HALF).map(({ text }) => text)).toEqual(["≤ 1", "10", "100", "10³"]);
  });
});
