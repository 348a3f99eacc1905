// What the panel shows of flat parts: the joints together, then each part by itself.
import { type Control, fieldControls, onAxes, words } from "./control";
import type { Part } from "./core/types";
import { defaultOf } from "./fields";
import { type Group, group, type Situation } from "./groups";
import { niceCeiling, niceStep } from "./number";

/** A fold with the angle of every joint, and one for each part. */
export function partGroups(now: Situation): Group[] {
  const parts = Object.entries(now.scene.parts);
  const joints = new Set(parts.map(([, { parent }]) => parent));
  const own = parts.map(([name, part]) => {
    const about = part.parent === null ? "" : `Hangs on: ${words(part.parent)}.`;
    const controls = partControls(now, name, part, joints.has(name));
    return group(`parts.${name}`, "parts", words(name), about, controls);
  });
  const turns = parts
    .filter(([name]) => joints.has(name))
    .flatMap(([name]) => angle(now, name, words(name)));
  const about = "What hangs on a joint turns with it.";
  return turns.length ? [group("joints", "parts", "Joints", about, turns), ...own] : own;
}

function angle(now: Situation, name: string, label: string): Control[] {
  return fieldControls(now, `parts.${name}.rotation`, "°").map((row) => ({ ...row, label }));
}

/** A circle looks the same however it is turned, unless something hangs on it. */
function partControls(now: Situation, name: string, part: Part, joint: boolean): Control[] {
  const at = `parts.${name}`;
  return [
    ...(part.shape === "circle" && !joint ? [] : angle(now, name, "Rotation")),
    ...onAxes(`${at}.position`, "Position", 1, ["x", "y"], ""),
    ...size(now, `${at}.scale`, part),
    ...fieldControls(now, `${at}.color`),
    ...fieldControls(now, `${at}.width`),
  ];
}

/** The factors that show, up to about four times the preset's. */
function size(now: Situation, path: string, { shape }: Part): Control[] {
  const preset = defaultOf(now.manifest, now.preset, path, now.settings);
  const largest = Math.max(...(Array.isArray(preset) ? preset : [1]));
  const high = niceCeiling(4 * largest);
  const step = niceStep(high, 1000);
  const axes = { square: ["x", "y"], circle: ["all"], line: ["x"] } as const;
  const rows = onAxes(path, "Scale", high, axes[shape], "");
  const label = { circle: "Radius", line: "Half length", square: null }[shape];
  return rows.map((row) => ({
    ...{ ...row, label: label ?? row.label, step },
    ...{ low: step, min: 1e-6 },
  }));
}
