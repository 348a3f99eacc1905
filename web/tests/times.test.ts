import { expect, test } from "vitest";
import { PATIENCE_MILLISECONDS, Times } from "../src/times";

/** Times of one kind of frame, first drawn at 1000. */
function timed(...milliseconds: number[]): Times {
  const times = new Times();
  times.drawn("kind", 1000);
  for (const one of milliseconds) times.add(one);
  return times;
}

test("the first frame, which also compiles, leaves the median to those after it", () => {
  expect(timed().median).toBe(0);
  expect(timed(90).median).toBe(90);
  const times = timed(90, 5, 7, 4);
  expect([times.count, times.median, times.fastest, times.slowest]).toEqual([3, 5, 4, 7]);
});

test("three frames after the first are enough", () => {
  expect(timed(9, 9, 9).settled(1000)).toBe(false);
  expect(timed(9, 9, 9, 9).settled(1000)).toBe(true);
});

test("a dear frame is not drawn again for its median", () => {
  expect(timed(599).settled(1000)).toBe(false);
  expect(timed(601).settled(1000)).toBe(true);
});

test("frames that are never timed are drawn again for a while only", () => {
  const last = 1000 + PATIENCE_MILLISECONDS;
  expect(timed().settled(last)).toBe(false);
  expect(timed().settled(last + 1)).toBe(true);
});

test("another kind of frame begins anew, the same one goes on", () => {
  const times = timed(9, 9, 9, 9);
  times.drawn("kind", 5000);
  expect(times.settled(1000)).toBe(true);
  times.drawn("other", 5000);
  expect(times.count).toBe(0);
  expect(times.settled(5000 + PATIENCE_MILLISECONDS)).toBe(false);
});

test("the median is of the last 31 frames", () => {
  const times = timed(...Array(40).fill(50), ...Array(31).fill(2));
  expect([times.count, times.slowest]).toEqual([31, 2]);
});
