// The camera's movements about what it looks at, as pure functions of where it is.
import { vec3 } from "gl-matrix";
import "./core/matrix"; // vectors of float64
import { clamp, shorten } from "./number";

/**
 * A camera, as far as hands move it: `fov` in degrees is that of the picture's height or width,
 * which is `aspect` times the height, `height` in metres. In a mirrored one right is left.
 */
export interface Pose {
  eye: readonly number[];
  target: readonly number[];
  up: readonly number[];
  fov: number;
  fov_of?: "height" | "width";
  aspect?: number;
  mirrored?: boolean;
  projection?: "perspective" | "orthographic";
  height?: number | null;
}

// Nearest to straight up or down, in radians, at which up still says what is left and right.
const POLE = 0.01;
const NEAREST = 1e-3;
const FARTHEST = 1e5;

export const vector = (v: readonly number[]) => vec3.fromValues(v[0] ?? 0, v[1] ?? 0, v[2] ?? 0);

/** Distance from the eye to what it looks at. */
export function distance(pose: Pose): number {
  return vec3.distance(vector(pose.eye), vector(pose.target));
}

export function isOrthographic(pose: Pose): boolean {
  return pose.projection === "orthographic";
}

/** Metres that the picture's height spans at the target. */
export function span(pose: Pose): number {
  if (isOrthographic(pose)) return pose.height ?? 1;
  return 2 * distance(pose) * tangent(pose);
}

/** Of half the angle that the picture's height takes. */
function tangent({ fov, fov_of, aspect = 1 }: Pose): number {
  const half = Math.tan((fov * Math.PI) / 360);
  return fov_of === "width" ? half / aspect : half;
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
  return { ...pose, eye: [...eye] };
}

/** Move towards the target (factor below 1) or away from it; without perspective, show less. */
export function zoom(pose: Pose, factor: number): Pose {
  if (isOrthographic(pose))
    return { ...pose, height: clamp(span(pose) * factor, NEAREST, FARTHEST) };
  const now = distance(pose);
  const next = clamp(now * factor, NEAREST, FARTHEST) / now;
  const eye = vec3.lerp(vec3.create(), vector(pose.target), vector(pose.eye), next);
  return { ...pose, eye: [...eye] };
}

/** Move eye and target across the picture; 1 is its height. */
export function pan(pose: Pose, rightward: number, upward: number): Pose {
  const { across, upright } = screenAxes(pose);
  const shift = vec3.create();
  vec3.scaleAndAdd(shift, shift, across, rightward * span(pose));
  vec3.scaleAndAdd(shift, shift, upright, upward * span(pose));
  return shifted(pose, [...shift]);
}

/** Eye and target moved by so many metres. */
export function shifted(pose: Pose, by: readonly number[]): Pose {
  const moved = (v: readonly number[]) => v.map((c, axis) => c + (by[axis] ?? 0));
  return { ...pose, eye: moved(pose.eye), target: moved(pose.target) };
}

/** Look at a point from the same side, from where the picture's height spans `height` metres. */
export function focus(pose: Pose, point: readonly number[], height: number): Pose {
  const direction = vec3.subtract(vec3.create(), vector(pose.eye), vector(point));
  const length = vec3.length(direction);
  if (length === 0) return pose;
  if (isOrthographic(pose)) return { ...centred(pose, point), height };
  const away = height / 2 / tangent(pose);
  const eye = vec3.scaleAndAdd(vec3.create(), vector(point), direction, away / length);
  return { ...pose, eye: [...eye], target: [...point] };
}

/** The same view of another target. */
function centred(pose: Pose, target: readonly number[]): Pose {
  return shifted(pose, [...vec3.subtract(vec3.create(), vector(target), vector(pose.target))]);
}

/** The same view, turning about another point of the middle axis, `away` metres from the eye. */
export function aimed(pose: Pose, away: number): Pose {
  const { ahead } = screenAxes(pose);
  return {
    ...pose,
    target: [...vec3.scaleAndAdd(vec3.create(), vector(pose.eye), ahead, away)],
  };
}

/** A pose between two others: 0 is the first, 1 the second. */
export function between(from: Pose, to: Pose, share: number): Pose {
  if (share >= 1) return to;
  const blend = (a: number, b: number) => a + (b - a) * share;
  const mix = (a: readonly number[], b: readonly number[]) =>
    a.map((v, at) => blend(v, b[at] ?? 0));
  const flat = isOrthographic(from) && isOrthographic(to);
  return {
    ...to,
    eye: mix(from.eye, to.eye),
    target: mix(from.target, to.target),
    ...(flat ? { height: blend(span(from), span(to)) } : {}),
  };
}

/** The ray through a point of the picture: x and y from -1 to 1, y up; `along` is a unit vector. */
export function ray(
  { aspect = 1, ...pose }: Pose,
  x: number,
  y: number,
): { from: number[]; along: number[] } {
  const { across, upright, ahead } = screenAxes(pose);
  const half = isOrthographic(pose) ? span(pose) / 2 : tangent({ ...pose, aspect });
  const wide = pose.mirrored ? -half * aspect : half * aspect;
  const offset = vec3.scale(vec3.create(), across, x * wide);
  vec3.scaleAndAdd(offset, offset, upright, y * half);
  if (isOrthographic(pose)) {
    return { from: [...vec3.add(offset, offset, vector(pose.eye))], along: [...ahead] };
  }
  vec3.add(ahead, ahead, offset);
  return { from: [...pose.eye], along: [...vec3.normalize(ahead, ahead)] };
}

/** Unit vectors of which `up` is the second: azimuths count from `forward` towards `right`. */
export function axes(up: readonly number[]) {
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

/** Numbers short enough for a link: a step of a hundred-thousandth is not seen. */
export function rounded(pose: Pose): Pose {
  const size = isOrthographic(pose) ? Math.min(distance(pose), span(pose)) : distance(pose);
  const digits = clamp(5 - Math.ceil(Math.log10(size)), 0, 9);
  const round = (v: readonly number[]) => v.map((c) => Number(c.toFixed(digits)) + 0);
  const height = pose.height ? { height: shorten(pose.height, 6) } : {};
  return { ...pose, eye: round(pose.eye), target: round(pose.target), ...height };
}
