/** sRGB codes as linear half floats, rounded as numpy does. Twin of `_decoded` in textures.py. */

/** A half float's bits by code, of colours and of alpha. */
const COLORS = Uint16Array.from({ length: 256 }, (_, code) => half(decode(code / 255)));
const ALPHAS = Uint16Array.from({ length: 256 }, (_, code) => half(code / 255));

/** sRGB RGBA codes to linear values (IEC 61966-2-1), alpha as it is. */
export function decoded(codes: Uint8Array): Uint16Array<ArrayBuffer> {
  return Uint16Array.from(codes, (code, at) => (at % 4 === 3 ? ALPHAS : COLORS)[code]!);
}

function decode(level: number): number {
  return level <= 0.04045 ? level / 12.92 : ((level + 0.055) / 1.055) ** 2.4;
}

/** The bits of the half float nearest to a value: 0, or one from 2^-14 to 1. */
function half(value: number): number {
  if (value === 0) return 0;
  const exponent = Math.floor(Math.log2(value));
  return ((exponent + 15) << 10) + toEven(1024 * (value / 2 ** exponent - 1));
}

/** The nearest whole number; of two, the even one. */
function toEven(value: number): number {
  const below = Math.floor(value);
  const rest = value - below;
  return below + Number(rest > 0.5 || (rest === 0.5 && below % 2 === 1));
}
