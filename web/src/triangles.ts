// Where a ray meets a mesh, by its triangles.
import type { Mesh } from "./core/mesh";

type Vector = readonly number[];

/** A box along the axes. */
export interface Box {
  readonly low: Vector;
  readonly high: Vector;
}

/**
 * The smallest positive t at which `from + t along` meets a triangle; null where it meets none.
 *
 * Triangles whose back it meets count only if they are drawn from both sides. Moller and Trumbore
 * 1997, without dividing before a hit is certain.
 */
export function meetMesh(
  mesh: Mesh,
  from: Vector,
  along: Vector,
  bothSides: boolean,
): number | null {
  const { positions: p, indices } = mesh;
  const [ox, oy, oz] = from as [number, number, number];
  const [dx, dy, dz] = along as [number, number, number];
  let best = Number.POSITIVE_INFINITY;
  for (let at = 0; at < indices.length; at += 3) {
    const [a, b, c] = [3 * indices[at]!, 3 * indices[at + 1]!, 3 * indices[at + 2]!];
    const [ax, ay, az] = [p[a]!, p[a + 1]!, p[a + 2]!];
    const [ux, uy, uz] = [p[b]! - ax, p[b + 1]! - ay, p[b + 2]! - az];
    const [vx, vy, vz] = [p[c]! - ax, p[c + 1]! - ay, p[c + 2]! - az];
    const [nx, ny, nz] = [dy * vz - dz * vy, dz * vx - dx * vz, dx * vy - dy * vx];
    const volume = ux * nx + uy * ny + uz * nz;
    if (volume === 0 || (volume < 0 && !bothSides)) continue;
    const sign = Math.sign(volume);
    const size = Math.abs(volume);
    const [sx, sy, sz] = [ox - ax, oy - ay, oz - az];
    const u = sign * (sx * nx + sy * ny + sz * nz);
    if (u < 0 || u > size) continue;
    const [qx, qy, qz] = [sy * uz - sz * uy, sz * ux - sx * uz, sx * uy - sy * ux];
    const v = sign * (dx * qx + dy * qy + dz * qz);
    if (v < 0 || u + v > size) continue;
    const t = (sign * (vx * qx + vy * qy + vz * qz)) / size;
    if (t > 1e-6 && t < best) best = t;
  }
  return Number.isFinite(best) ? best : null;
}

/** The t at which `from + t along` enters a box, 0 from inside it; null where it does not. */
export function meetBox({ low, high }: Box, from: Vector, along: Vector): number | null {
  let [enter, leave] = [0, Number.POSITIVE_INFINITY];
  for (const axis of [0, 1, 2]) {
    const [at, step] = [from[axis]!, along[axis]!];
    if (step === 0 && (at < low[axis]! || at > high[axis]!)) return null;
    if (step === 0) continue;
    const [one, other] = [(low[axis]! - at) / step, (high[axis]! - at) / step];
    enter = Math.max(enter, Math.min(one, other));
    leave = Math.min(leave, Math.max(one, other));
  }
  return enter <= leave ? enter : null;
}
