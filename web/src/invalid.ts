// Pixels that no picture may hold, counted in the linear picture.

export interface Invalid {
  nan: number;
  inf: number;
  negative: number;
}

/**
 * Each pixel of RGBA data counts once: as NaN, else as infinite, else as negative. A `signed`
 * picture holds negative numbers by right.
 */
export function countInvalid(linear: Float32Array, signed = false): Invalid {
  const found: Invalid = { nan: 0, inf: 0, negative: 0 };
  for (let at = 0; at < linear.length; at += 4) {
    const [r, g, b] = [linear[at]!, linear[at + 1]!, linear[at + 2]!];
    const sum = r + g + b;
    if (r >= 0 && g >= 0 && b >= 0 && sum < Number.POSITIVE_INFINITY) continue;
    if (Number.isNaN(r) || Number.isNaN(g) || Number.isNaN(b)) found.nan += 1;
    else if (!Number.isFinite(r) || !Number.isFinite(g) || !Number.isFinite(b)) found.inf += 1;
    else if (!signed && (r < 0 || g < 0 || b < 0)) found.negative += 1;
  }
  return found;
}
