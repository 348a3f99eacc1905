// Colours: linear Rec. 709 in scenes and shaders, sRGB codes in pickers and links.
// IEC 61966-2-1.

export type Triple = [number, number, number];

const HEX = /^#?[0-9a-f]{6}$/i;

export function decodeSrgb(code: number): number {
  return code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
}

export function encodeSrgb(linear: number): number {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}

/** `rrggbb` of linear light; what a display cannot show is clamped. */
export function toHex(linear: readonly number[]): string {
  const codes = linear.map((c) => Math.round(encodeSrgb(Math.min(Math.max(c, 0), 1)) * 255));
  return codes.map((code) => code.toString(16).padStart(2, "0")).join("");
}

export function isHex(value: unknown): value is string {
  return typeof value === "string" && HEX.test(value);
}

/** Linear light of `rrggbb` or `#rrggbb`. */
export function fromHex(hex: string): Triple {
  const code = Number.parseInt(hex.replace("#", ""), 16);
  const channels = [code >> 16, code >> 8, code].map((c) => decodeSrgb((c & 255) / 255));
  return channels as Triple;
}

/** A colour above white is its brightest channel times a colour that a picker can show. */
export function level(linear: readonly number[]): number {
  return Math.max(...linear, 0);
}

/** The colour scaled so that its brightest channel is 1; black becomes white. */
export function hue(linear: readonly number[]): Triple {
  const top = level(linear);
  return (top > 0 ? linear.map((c) => c / top) : [1, 1, 1]) as Triple;
}
