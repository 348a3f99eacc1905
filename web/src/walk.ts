// First person: the eye moves and turns, and takes what it looks at along. Pure functions.
import { vec3 } from "gl-matrix";
import { clamp } from "./number";
import { axes, distance, type Pose, shifted, vector } from "./orbit";

/** What moves the eye: shares from -1 to 1 of full speed, and of full speed of turning. */
export interface Stride {
  right: number;
  up: number;
  ahead: number;
  left: number;
  above: number;
}

/** |cos| of the angle between view and up stays below this: beyond, "up" says little. */
export const STEEPEST = 0.995;
// A link's rounded numbers turn the view by up to a ten-thousandth.
const HIGHEST = Math.asin(STEEPEST) - 1e-3;
// Three-point Gauss-Legendre quadrature on [0, 1] (Abramowitz and Stegun 1964, 25.4.30).
const NODES = [
  [0.5 - Math.sqrt(0.15), 5 / 18],
  [0.5, 8 / 18],
  [0.5 + Math.sqrt(0.15), 5 / 18],
] as const;

/** Azimuth counts from `forward` of the up vector's axes towards `right`. */
interface Heading {
  azimuth: number;
  elevation: number;
}

/** Turn the view by two angles in radians, to the left and up, short of straight up and down. */
export function look(pose: Pose, left: number, above: number): Pose {
  const { azimuth, elevation } = heading(pose);
  return facing(pose, { azimuth: azimuth + left, elevation: bounded(elevation + above) });
}

/** Move by so many metres to the right, along the up vector and as the view goes. */
export function step(pose: Pose, right: number, up: number, ahead: number): Pose {
  const level = look(pose, 0, 0);
  const at = heading(level);
  const by = vec3.scale(vec3.create(), across(level, at), right);
  vec3.scaleAndAdd(by, by, axes(level.up).up, up);
  return shifted(level, [...vec3.scaleAndAdd(by, by, direction(level, at), ahead)]);
}

/**
 * The eye after some seconds at `speed` metres a second and `turn` radians a second.
 *
 * Up is along the up vector, the rest as the view goes. Several directions at once are no faster
 * than one. The path of an eye that also turns is integrated, with an error below a nanometre
 * for steps up to a tenth of a second, so that it does not depend on how often this is called.
 */
export function stride(
  pose: Pose,
  move: Stride,
  speed: number,
  turn: number,
  seconds: number,
): Pose {
  const from = heading(pose);
  const start = { ...from, elevation: bounded(from.elevation) };
  const [left, above] = [move.left * turn, move.above * turn];
  const limit = Math.sign(above) * HIGHEST;
  const rising = above ? clamp((limit - start.elevation) / above, 0, seconds) : 0;
  const top = after(start, left, above, rising);
  const eye = vec3.create();
  const go = (at: Heading, up: number, duration: number) =>
    vec3.scaleAndAdd(
      eye,
      eye,
      mean(pose, move, at, left * duration, up * duration),
      speed * duration,
    );
  go(start, above, rising);
  go(top, 0, seconds - rising);
  return shifted(facing(pose, after(top, left, 0, seconds - rising)), [...eye]);
}

function after(at: Heading, left: number, above: number, seconds: number): Heading {
  return { azimuth: at.azimuth + left * seconds, elevation: at.elevation + above * seconds };
}

/** Mean over a turn of the unit vector of motion, or of less than that for half a push. */
function mean(pose: Pose, move: Stride, at: Heading, left: number, above: number): vec3 {
  const total = vec3.create();
  for (const [share, weight] of NODES) {
    const view = after(at, left, above, share);
    vec3.scaleAndAdd(total, total, motion(pose, move, view), weight);
  }
  return total;
}

function motion(pose: Pose, move: Stride, at: Heading): vec3 {
  const sum = vec3.scale(vec3.create(), across(pose, at), move.right);
  vec3.scaleAndAdd(sum, sum, axes(pose.up).up, move.up);
  vec3.scaleAndAdd(sum, sum, direction(pose, at), move.ahead);
  const share = Math.min(1, Math.hypot(move.right, move.up, move.ahead));
  return vec3.scale(sum, vec3.normalize(sum, sum), share);
}

function heading(pose: Pose): Heading {
  const { right, forward, up } = axes(pose.up);
  const view = vec3.subtract(vec3.create(), vector(pose.target), vector(pose.eye));
  vec3.normalize(view, view);
  return {
    azimuth: Math.atan2(vec3.dot(view, right), vec3.dot(view, forward)),
    elevation: Math.asin(clamp(vec3.dot(view, up), -1, 1)),
  };
}

function direction(pose: Pose, { azimuth, elevation }: Heading): vec3 {
  const { right, forward, up } = axes(pose.up);
  const found = vec3.scale(vec3.create(), right, Math.cos(elevation) * Math.sin(azimuth));
  vec3.scaleAndAdd(found, found, forward, Math.cos(elevation) * Math.cos(azimuth));
  return vec3.scaleAndAdd(found, found, up, Math.sin(elevation));
}

/** The level unit vector to the right. */
function across(pose: Pose, { azimuth }: Heading): vec3 {
  const { right, forward } = axes(pose.up);
  const found = vec3.scale(vec3.create(), right, -Math.cos(azimuth));
  return vec3.scaleAndAdd(found, found, forward, Math.sin(azimuth));
}

function facing(pose: Pose, at: Heading): Pose {
  const target = vec3.scaleAndAdd(
    vec3.create(),
    vector(pose.eye),
    direction(pose, at),
    distance(pose),
  );
  return { ...pose, target: [...target] };
}

function bounded(elevation: number): number {
  return clamp(elevation, -HIGHEST, HIGHEST);
}
