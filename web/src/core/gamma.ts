// The gamma of a display from measured luminances: the power y = x^gamma nearest to them.
// server/lightbench/gamma.py is this module's twin.
import { LightbenchError, shown } from "./errors";

/** What was sent to the display, and what it shone with. */
export type Measured = readonly [level: number, luminance: number];

/**
 * `gamma` of y = x^gamma, and the root mean square of x^gamma - y over all points.
 *
 * `levels` as given, rising; `x` the levels and `y` the luminances, each over its largest.
 */
export interface Fit {
  gamma: number;
  residual: number;
  levels: readonly number[];
  x: readonly number[];
  y: readonly number[];
}

// No display is outside these.
const LOWEST = 0.1;
const HIGHEST = 10;
const WHITE = 255;
const STEPS = 200;
// Steps of float64 between two guesses that are taken for one.
const SAME = 4 * 2 ** -52;

const sum = (values: readonly number[]) => values.reduce((total, value) => total + value, 0);

/**
 * The gamma of luminances, in any unit, of levels 0 to 255 or 0 to 1, white among them.
 *
 * Luminances are divided by the largest (the lab script's normalisation). Nonlinear least squares on
 * y itself, by Gauss-Newton steps within a bracket, from the line through ln y over ln x.
 * Throws a LightbenchError for what is no such measurement.
 */
export function fitGamma(measured: readonly Measured[]): Fit {
  checkPoints(measured);
  const ordered = [...measured].sort(([a], [b]) => a - b);
  const top = checkLevels(ordered);
  const largest = Math.max(...ordered.map(([, luminance]) => luminance));
  const levels = ordered.map(([level]) => level);
  const x = levels.map((level) => level / top);
  const y = ordered.map(([, luminance]) => luminance / largest);
  const between = x.flatMap((value, index) => (value > 0 && value < 1 ? [index] : []));
  const gamma = least(
    between.map((index) => x[index]!),
    between.map((index) => y[index]!),
  );
  const squares = x.map((value, index) => (value ** gamma - y[index]!) ** 2);
  return { gamma, residual: Math.sqrt(sum(squares) / x.length), levels, x, y };
}

function checkPoints(measured: readonly Measured[]): void {
  for (const [level, luminance] of measured) {
    if (!(level >= 0 && level <= WHITE))
      throw new LightbenchError(`level ${shown(level)}: levels are 0 to 255, or 0 to 1`);
    if (!(luminance >= 0 && luminance < Infinity))
      throw new LightbenchError(
        `level ${shown(level)}: its luminance ${shown(luminance)} must be finite and not negative`,
      );
  }
}

/** The level of white. */
function checkLevels(ordered: readonly Measured[]): number {
  const levels = ordered.map(([level]) => level);
  for (const level of levels) {
    if (levels.indexOf(level) !== levels.lastIndexOf(level))
      throw new LightbenchError(`level ${shown(level)} is measured more than once`);
  }
  const top = levels.at(-1) ?? 0;
  if (levels.filter((level) => level > 0).length < 2)
    throw new LightbenchError(
      "too few points: measure white, 255 (or 1), and at least one level between black and it",
    );
  if (top !== 1 && top !== WHITE)
    throw new LightbenchError(
      `no luminance at the top: the highest level is ${shown(top)}; measure white, 255 (or 1), too`,
    );
  const broken = top === WHITE && levels.find((level) => !Number.isInteger(level));
  if (typeof broken === "number")
    throw new LightbenchError(`level ${shown(broken)}: levels to 255 are whole numbers`);
  if (ordered.every(([, luminance]) => luminance === 0))
    throw new LightbenchError("every luminance is 0: there is no light to fit");
  if (ordered.at(-1)?.[1] === 0)
    throw new LightbenchError(`no luminance at the top: level ${shown(top)} has 0`);
  return top;
}

/** Where the sum of (x^gamma - y)^2 is least, for x within 0 and 1. */
function least(x: readonly number[], y: readonly number[]): number {
  const logs = x.map(Math.log);
  // Half of the sum's derivative, and of its second one by Gauss and Newton.
  const slope = (gamma: number): [down: number, curvature: number] => {
    const power = x.map((value) => value ** gamma);
    const change = power.map((value, index) => value * logs[index]!);
    return [
      sum(change.map((value, index) => (power[index]! - y[index]!) * value)),
      sum(change.map((value) => value * value)),
    ];
  };
  let [low, high] = [LOWEST, HIGHEST];
  if (slope(low)[0] >= 0 || slope(high)[0] <= 0)
    throw new LightbenchError("no power from 0.1 to 10 fits these luminances");
  let gamma = Math.min(Math.max(logLog(logs, y), low), high);
  for (let step = 0; step < STEPS; step += 1) {
    const [down, curvature] = slope(gamma);
    [low, high] = down < 0 ? [gamma, high] : [low, gamma];
    let following = gamma - down / curvature;
    if (!(low <= following && following <= high)) following = 0.5 * (low + high);
    if (Math.abs(following - gamma) <= SAME * gamma) break;
    gamma = following;
  }
  return gamma;
}

/** Least squares of ln y = gamma ln x, where y is not 0. */
function logLog(logs: readonly number[], y: readonly number[]): number {
  const lit = logs.flatMap((_, index) => (y[index]! > 0 ? [index] : []));
  const products = lit.map((index) => logs[index]! * Math.log(y[index]!));
  return sum(products) / sum(lit.map((index) => logs[index]! ** 2));
}
