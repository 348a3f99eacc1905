// The page's address: written as the state changes, read on load and when someone edits it.
import { resolve } from "./core/settings";
import type { Manifest, Scene } from "./core/types";
import type { Values } from "./fields";
import { accept, read, write } from "./state";
import type { Store } from "./store";

// Browsers refuse more than a hundred changes of the address in half a minute.
const WRITE_MILLISECONDS = 150;

export class Link {
  private timer: ReturnType<typeof setTimeout> | undefined;

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

  /** Put the state into the address, once it has settled. */
  write(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.flush(), WRITE_MILLISECONDS);
  }

  /** The link to the state as it is now. */
  flush(): string {
    clearTimeout(this.timer);
    const hash = `#${write(this.store.state)}`;
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
