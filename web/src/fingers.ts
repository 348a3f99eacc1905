// Pointers that are down on the picture, and what they do together.

interface Point {
  x: number;
  y: number;
}

/** A move of the pointers' middle in pixels; `factor` is below 1 where they spread. */
export interface Shift {
  dx: number;
  dy: number;
  factor: number;
}

export class Fingers {
  private readonly down = new Map<number, Point>();
  /** Pixels gone since the first came down. */
  wandered = 0;

  get count(): number {
    return this.down.size;
  }

  press({ pointerId, clientX, clientY }: PointerEvent): void {
    if (!this.count) this.wandered = 0;
    this.down.set(pointerId, { x: clientX, y: clientY });
  }

  /** Whether it was down. */
  lift({ pointerId }: PointerEvent): boolean {
    return this.down.delete(pointerId);
  }

  /** What one of them did; null where it is not down. */
  move({ pointerId, clientX, clientY }: PointerEvent): Shift | null {
    const finger = this.down.get(pointerId);
    if (!finger) return null;
    const before = this.grip();
    this.wandered += Math.abs(clientX - finger.x) + Math.abs(clientY - finger.y);
    this.down.set(pointerId, { x: clientX, y: clientY });
    const after = this.grip();
    const factor = before.spread > 0 && after.spread > 0 ? before.spread / after.spread : 1;
    return { dx: after.x - before.x, dy: after.y - before.y, factor };
  }

  /** Their middle and their mean distance from it. */
  private grip(): Point & { spread: number } {
    const all = [...this.down.values()];
    const mean = (of: (finger: Point) => number) =>
      all.reduce((sum, finger) => sum + of(finger), 0) / all.length;
    const [x, y] = [mean((f) => f.x), mean((f) => f.y)];
    return { x, y, spread: mean((f) => Math.hypot(f.x - x, f.y - y)) };
  }
}
