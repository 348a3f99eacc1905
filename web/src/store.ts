// The one state of the page, who listens to it, and the way back.
import type { State } from "./state";

type Listener = (state: State) => void;

// Longest list of steps that undo keeps.
const DEPTH = 500;

/** Changes of one gesture (a drag, a burst of key presses) are undone as one. */
export class Store {
  private past: State[] = [];
  private future: State[] = [];
  private gesture: string | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly listeners = new Set<Listener>();

  constructor(private current: State) {}

  get state(): State {
    return this.current;
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** The state that there is no way back from. */
  start(state: State): void {
    this.current = state;
  }

  listen(listener: Listener): void {
    this.listeners.add(listener);
  }

  /** Change the state; changes with the gesture of the one before add no step of their own. */
  set(next: State, gesture: string | null = null): void {
    clearTimeout(this.timer);
    if (JSON.stringify(next) === JSON.stringify(this.current)) return;
    if (gesture === null || gesture !== this.gesture) {
      this.past = [...this.past, this.current].slice(-DEPTH);
    }
    this.gesture = gesture;
    this.future = [];
    this.show(next);
  }

  /** End the gesture, at once or when nothing more has come for so long. */
  release(milliseconds = 0): void {
    clearTimeout(this.timer);
    const end = () => {
      this.gesture = null;
    };
    if (milliseconds > 0) this.timer = setTimeout(end, milliseconds);
    else end();
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  private step(from: State[], to: State[]): void {
    const next = from.pop();
    if (!next) return;
    to.push(this.current);
    this.release();
    this.show(next);
  }

  private show(next: State): void {
    this.current = next;
    for (const listener of this.listeners) listener(next);
  }
}
