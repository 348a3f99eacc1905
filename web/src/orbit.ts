// The camera's movements, as pure functions of where it is.
import { vec3 } from "gl-matrix";
import { clamp } from "./number";

export interface Pose {
  eye: readonly number[];
  target: readonly number[];
  up: readonly number[];
}

// Nearest to straight up or down, in radians, at which up still says what is left and right.
const POLE = 0.01;
const NEAREST = 1e-3;
const FARTHEST = 1e5;

const vector = (v: readonly number[]) => vec3.fromValues(v[0] ?? 0, v[1] ?? 0, v[2] ?? 0);

/** Distance from the eye to what it looks at. */
export function distance(pose: Pose): number {
  return vec3.distance(vector(pose.eye), vector(pose.target));
}

/** Turn about the target by two angles in radians, to the left and up. */
export function orbit(pose: Pose, left: number, above: number): Pose {
  const { right, forward, up } = axes(pose.up);
  const offset = vec3.subtract(vec3.create(), vector(pose.eye), vector(pose.target));
  const radius = vec3.length(offset);
  const azimuth = Math.atan2(vec3.dot(offset, right), vec3.dot(offset, forward)) - left;
  const height = Math.asin(clamp(vec3.dot(offset, up) / radius, -1, 1)) + above;
  const elevation = clamp(height, POLE - Math.PI / 2, Math.PI / 2 - POLE);
  const flat = radius * Math.cos(elevation);
  const eye = vector(pose.target);
  vec3.scaleAndAdd(eye, eye, right, flat * Math.sin(azimuth));
  vec3.scaleAndAdd(eye, eye, forward, flat * Math.cos(azimuth));
  vec3.scaleAndAdd(eye, eye, up, radius * Math.sin(elevation));
  return rounded({ ...pose, eye: [...eye] });
}

/** Move towards the target (factor below 1) or away from it. */
export function zoom(pose: Pose, factor: number): Pose {
  const now = distance(pose);
  const next = clamp(now * factor, NEAREST, FARTHEST) / now;
  const eye = vec3.lerp(vec3.create(), vector(pose.target), vector(pose.eye), next);
  return rounded({ ...pose, eye: [...eye] });
}

/** Move eye and target across the picture; 1 is its height. `fov` is vertical, in degrees. */
export function pan(pose: Pose, fov: number, rightward: number, upward: number): Pose {
  const { across, upright } = screenAxes(pose);
  const height = 2 * distance(pose) * Math.tan((fov * Math.PI) / 360);
  const shift = vec3.create();
  vec3.scaleAndAdd(shift, shift, across, rightward * height);
  vec3.scaleAndAdd(shift, shift, upright, upward * height);
  const eye = vec3.add(vec3.create(), vector(pose.eye), shift);
  const target = vec3.add(vec3.create(), vector(pose.target), shift);
  return rounded({ ...pose, eye: [...eye], target: [...target] });
}

/** Look at a point from the same side, `away` metres from it. */
export function focus(pose: Pose, point: readonly number[], away: number): Pose {
  const direction = vec3.subtract(vec3.create(), vector(pose.eye), vector(point));
  const length = vec3.length(direction);
  if (length === 0) return pose;
  const eye = vec3.scaleAndAdd(vec3.create(), vector(point), direction, away / length);
  return rounded({ ...pose, eye: [...eye], target: [...point] });
}

/** A pose between two others: 0 is the first, 1 the second. */
export function between(from: Pose, to: Pose, share: number): Pose {
  const mix = (a: readonly number[], b: readonly number[]) =>
    a.map((value, axis) => value + ((b[axis] ?? 0) - value) * share);
  return share >= 1
    ? to
    : rounded({ ...to, eye: mix(from.eye, to.eye), target: mix(from.target, to.target) });
}

/** Unit direction of the ray through a point of the picture: x and y from -1 to 1, y up. */
export function ray(pose: Pose, fov: number, aspect: number, x: number, y: number): number[] {
  const { across, upright, ahead } = screenAxes(pose);
  const tangent = Math.tan((fov * Math.PI) / 360);
  vec3.scaleAndAdd(ahead, ahead, across, x * tangent * aspect);
  vec3.scaleAndAdd(ahead, ahead, upright, y * tangent);
  return [...vec3.normalize(ahead, ahead)];
}

function axes(up: readonly number[]) {
  const unit = vec3.normalize(vec3.create(), vector(up));
  const other = Math.abs(unit[1]) < 0.9 ? [0, 1, 0] : [0, 0, 1];
  const right = vec3.cross(vec3.create(), unit, vector(other));
  vec3.normalize(right, right);
  return { right, up: unit, forward: vec3.cross(vec3.create(), right, unit) };
}

function screenAxes(pose: Pose) {
  const ahead = vec3.subtract(vec3.create(), vector(pose.target), vector(pose.eye));
  vec3.normalize(ahead, ahead);
  const across = vec3.cross(vec3.create(), ahead, vector(pose.up));
  vec3.normalize(across, across);
  return { ahead, across, upright: vec3.cross(vec3.create(), across, ahead) };
}

/** Numbers short enough for a link: a hundred-thousandth of the distance is no visible step. */
function rounded(pose: Pose): Pose {
  const digits = clamp(5 - Math.ceil(Math.log10(distance(pose))), 0, 9);
  const round = (v: readonly number[]) => v.map((c) => Number(c.toFixed(digits)) + 0);
  return { ...pose, eye: round(pose.eye), target: round(pose.target) };
}
