// Numbers as people and links write them.

/** The value with as few digits as `digits` significant ones need: 0.30000000000000004 is 0.3. */
export function shorten(value: number, digits = 7): number {
  return Number(value.toPrecision(digits));
}

export function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}

/** Digits after the point that a step of this size needs. */
export function decimals(step: number): number {
  const [, fraction = "", exponent = "0"] = /^[\d.]*?(?:\.(\d+))?(?:e([+-]\d+))?$/.exec(`${step}`)!;
  return Math.max(0, fraction.length - Number(exponent));
}

/** The multiple of `step` (counted from 0) nearest to a value. */
export function snap(value: number, step: number): number {
  return Number((Math.round(value / step) * step).toFixed(Math.min(decimals(step), 20)));
}

/** A value for a person: no more digits than it has, thousands apart, exponents for extremes. */
export function spell(value: number, digits = 4): string {
  const short = shorten(value, digits);
  const size = Math.abs(short);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) return short.toExponential().replace("e+", "e");
  return short.toLocaleString("en", { maximumFractionDigits: 6 }).replaceAll(",", "\u202f");
}

/** A power of ten that divides a range into about `parts` steps. */
export function niceStep(range: number, parts = 100): number {
  return Number(`1e${Math.floor(Math.log10(range / parts) + 1e-9)}`);
}

/** The next of 1, 2, 5, 10, 20 ... that is not below the value. */
export function niceCeiling(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const factor = [1, 2, 5, 10].find((f) => f * power >= value * (1 - 1e-9)) ?? 10;
  return shorten(factor * power);
}
