// The page's address: written as the state changes, read on load and when someone edits it.
import { resolve } from "./core/settings";
import type { Manifest, Scene } from "./core/types";
import type { Values } from "./fields";
import { isOpened } from "./scenes";
import { accept, read, type State, write } from "./state";
import type { Store } from "./store";

// Browsers refuse more than a hundred changes of the address in half a minute.
const WRITE_MILLISECONDS = 150;

export class Link {
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** What the address says, or is about to: never a model opened here, which no link leads to. */
  private said: State | null = null;

  constructor(
    private readonly store: Store,
    private readonly say: (sentence: string) => void,
  ) {}

  /** The scene that the address names. */
  scene(): string | null {
    return read(location.hash).scene;
  }

  /** The settings of the address; what is wrong in them is said, and left out. */
  settings(manifest: Manifest, scene: Scene): Values {
    const check = (settings: Values) => void resolve(manifest, scene, settings);
    const { settings, problems } = accept(manifest, scene, read(location.hash).texts, check);
    for (const problem of problems) this.say(`In the link, ${problem}. It was left out.`);
    return settings;
  }

  /** The preset that the address names, or is about to. */
  get preset(): string {
    return this.said?.scene ?? "";
  }

  /** Put the state into the address, once it has settled; a model of a person's own stays out. */
  write(): void {
    if (isOpened(this.store.state.scene)) return;
    this.said = this.store.state;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.flush(), WRITE_MILLISECONDS);
  }

  /** The link to the preset as it is now, or as it was last. */
  flush(): string {
    clearTimeout(this.timer);
    if (!isOpened(this.store.state.scene)) this.said = this.store.state;
    const hash = this.said ? `#${write(this.said)}` : location.hash;
    if (location.hash !== hash) history.replaceState(null, "", hash);
    return location.href;
  }

  /** Hear of addresses that someone typed or came back to. */
  listen(changed: () => void): void {
    window.addEventListener("hashchange", () => {
      clearTimeout(this.timer);
      changed();
    });
  }
}
