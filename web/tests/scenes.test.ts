import { expect, test } from "vitest";
import { presetAt, presetFolders } from "../src/scenes";

const scene = { title: "", about: "" };
const manifest = {
  scenes: Object.fromEntries(["box", "lab/shadows", "lab/deep/one", "room"].map((n) => [n, scene])),
};

test("presets stand by their folder, those in none first", () => {
  expect([...presetFolders(manifest)]).toEqual([
    ["", ["box", "room"]],
    ["lab", ["lab/shadows"]],
    ["lab/deep", ["lab/deep/one"]],
  ]);
});

test("digits count through the presets as the dialog shows them", () => {
  const names = [1, 2, 3, 4, 5].map((digit) => presetAt(manifest, digit));
  expect(names).toEqual(["box", "room", "lab/shadows", "lab/deep/one", undefined]);
});
