import { expect, test } from "vitest";
import type { Plan } from "../src/core/types";
import { linearOnly } from "../src/probe";

test("the linear part of a plan ends with the pass that draws the linear picture", () => {
  const passes = ["map", "radiance", "linear", "display"].map((target) => ({ target }));
  const plan = { passes, outputs: { linear: "linear", display: "display" } } as unknown as Plan;
  const targets = linearOnly(plan).passes.map(({ target }) => target);
  expect(targets).toEqual(["map", "radiance", "linear"]);
  expect(plan.passes).toHaveLength(4);
});
