/** What a scene's parts must be beyond their fields. Twin of the checks in scene_parts.py. */

import { Problem } from "./scene_types";
import type { Part } from "./types";

/** Throws Problem for a part of no such shape. */
export function checkPart({ scale, shape }: Part, path: string): void {
  if (scale.some((s) => s < 1e-6)) {
    throw new Problem(path, "scale: each factor must be at least 1e-6");
  }
  if (shape === "circle" && scale[0] !== scale[1]) {
    throw new Problem(path, "scale: a circle has one factor for both axes");
  }
}

/** Throws Problem for a parent that is not there, or that hangs on its own child. */
export function checkParents(parts: Readonly<Record<string, Part>>): void {
  for (const [name, { parent }] of Object.entries(parts)) {
    if (parent === null || Object.hasOwn(parts, parent)) continue;
    const there = Object.keys(parts).join(", ");
    throw new Problem("", `parts.${name}.parent: no part '${parent}'; there is: ${there}`);
  }
  for (const name of Object.keys(parts)) {
    const chain = [name];
    for (let parent = parts[name]!.parent; parent !== null; parent = parts[parent]!.parent) {
      const met = chain.includes(parent);
      chain.push(parent);
      if (!met) continue;
      const circle = chain.join(" -> ");
      throw new Problem("", `parts.${name}.parent: goes in a circle: ${circle}`);
    }
  }
}
