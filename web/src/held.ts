// What is held down, and what it does over time: the same on a slow screen and on a quick one.

// What a short press counts for, so that a tap between two frames is not lost.
const TAP_MILLISECONDS = 1000 / 30;
// Time of a frame that came late because the page was stopped, not slow.
const LONGEST_MILLISECONDS = 500;

/**
 * Pushes that act while they are held. `step` is told what was held for how long, cut where a push
 * came or went and not only at frames. Times are the page's, in milliseconds.
 */
export class Held<Push> {
  private readonly down = new Map<string, { push: Push; since: number }>();
  private last = 0;

  constructor(private readonly step: (pushes: Push[], seconds: number) => void) {}

  get idle(): boolean {
    return this.down.size === 0;
  }

  /** Hold something from now on, or hold it otherwise than before. */
  press(name: string, push: Push, now: number): void {
    if (this.idle) this.last = now;
    this.advance(now);
    this.down.set(name, { push, since: this.down.get(name)?.since ?? now });
  }

  lift(name: string, now: number): void {
    const found = this.down.get(name);
    if (!found) return;
    this.advance(now);
    this.down.delete(name);
    const missing = TAP_MILLISECONDS - Math.max(now - found.since, 0);
    if (missing > 0) this.step([found.push], missing / 1000);
  }

  /** Nothing is held any more: what was held since the last frame does not count. */
  clear(): void {
    this.down.clear();
  }

  /** Count what is held up to now. */
  advance(now: number): void {
    const passed = now - this.last;
    if (passed <= 0) return;
    this.last = now;
    const pushes = [...this.down.values()].map(({ push }) => push);
    if (pushes.length) this.step(pushes, Math.min(passed, LONGEST_MILLISECONDS) / 1000);
  }
}
