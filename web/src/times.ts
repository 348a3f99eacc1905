// What frames of one kind take: the median of the last ones, and when it is worth no more frames.

// The median is that of so many last frames.
const FRAMES = 31;
const ENOUGH = 3;
const DEAR_MILLISECONDS = 600;
/** Nothing is drawn again for the median alone once so much time has gone by. */
export const PATIENCE_MILLISECONDS = 2500;

export class Times {
  private kind = "";
  private since = 0;
  private warm = false;
  private last: readonly number[] = [];

  /** A frame was drawn; one of another kind (other programs, another size) begins anew. */
  drawn(kind: string, now: number): void {
    if (kind === this.kind) return;
    this.kind = kind;
    this.since = now;
    this.warm = false;
    this.last = [];
  }

  /** What a frame took. */
  add(milliseconds: number): void {
    if (!this.warm && this.last.length === 1) {
      this.last = []; // the first frame also made buffers and machine code
      this.warm = true;
    }
    this.last = [...this.last, milliseconds].slice(-FRAMES);
  }

  /**
   * Whether there are frames enough for a number that means something, or more are too dear: each
   * takes long, or time has gone by, as where the clock gives no answer.
   */
  settled(now: number): boolean {
    const [first = 0] = this.last;
    const late = now - this.since > PATIENCE_MILLISECONDS;
    return this.count >= ENOUGH || first > DEAR_MILLISECONDS || late;
  }

  get count(): number {
    return this.last.length;
  }

  get fastest(): number {
    return Math.min(...this.last);
  }

  get slowest(): number {
    return Math.max(...this.last);
  }

  /** 0 where nothing was timed. */
  get median(): number {
    const sorted = [...this.last].sort((a, b) => a - b);
    return sorted[Math.floor(sorted.length / 2)] ?? 0;
  }
}
