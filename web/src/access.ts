// How a row of the panel reads and changes the state: parts of values, "auto", defaults.
import { toHex } from "./color";
import type { Control } from "./control";
import { coupled, derived } from "./derived";
import { AUTO, defaultOf, isLibraryField, same, type Value, type Values } from "./fields";
import { current, type Situation } from "./groups";
import { readPart, triple, writePart } from "./parts";
import { trim } from "./state";
import type { Store } from "./store";

/** What a widget shows: a number, a truth, a word, or a colour as #rrggbb. */
export type Plain = number | string | boolean;

// Changes that follow each other within this many milliseconds are undone as one.
const BURST = 600;

export class Access {
  constructor(
    private readonly control: Control,
    private readonly store: Store,
    private readonly now: () => Situation,
  ) {}

  get(): Plain {
    return this.plain(this.value());
  }

  set(value: Plain): void {
    const { part, kind } = this.control;
    const bare = kind === "color" ? `${value}`.replace("#", "") : value;
    const whole = part && value !== AUTO ? writePart(this.value(), part, `${bare}`) : bare;
    put(this.store, this.now(), this.control.name, whole);
  }

  /** The end of a drag, or of a key press that others may follow. */
  done(): void {
    this.store.release(BURST);
  }

  reset(): void {
    const { manifest, preset, settings } = this.now();
    const { name, part } = this.control;
    const standard = defaultOf(manifest, preset, name, settings);
    if (standard === AUTO || !part) put(this.store, this.now(), name, standard);
    else this.set(readPart(standard, part));
    this.done();
  }

  isAuto(): boolean {
    return this.raw() === AUTO;
  }

  setAuto(auto: boolean): void {
    put(this.store, this.now(), this.control.name, auto ? AUTO : this.value());
    this.done();
  }

  isModified(): boolean {
    const [value, standard] = [this.raw(), this.standard()];
    if (value === AUTO || standard === AUTO) return value !== standard;
    return !same(this.plain(value), this.plain(standard));
  }

  /** The default as a person reads it. */
  describeDefault(): string {
    const standard = this.standard();
    return standard === AUTO ? AUTO : `${this.plain(standard)}`;
  }

  /** The value that holds, followed through where it is "auto". */
  value(): Value {
    const value = this.raw();
    return value === AUTO ? derived(this.now().scene, this.control.name) : value;
  }

  private raw(): Value {
    return current(this.now(), this.control.name);
  }

  private standard(): Value {
    const { manifest, preset, settings } = this.now();
    return defaultOf(manifest, preset, this.control.name, settings);
  }

  private plain(value: Value): Plain {
    const { kind, part } = this.control;
    if (kind === "color") return `#${part ? readPart(value, part) : toHex(triple(value))}`;
    if (part) return readPart(value, part);
    if (kind === "bool") return ["true", "1"].includes(`${value}`);
    return Array.isArray(value) ? 0 : value;
  }
}

/** Change one setting, and what has to change with it; what is default leaves the state. */
export function put(store: Store, now: Situation, name: string, value: Value): void {
  const settings = withoutStale(store.state.settings, name);
  const next = { ...settings, ...coupled(now.scene, name, value), [name]: value };
  const trimmed = trim(now.manifest, now.preset, next);
  store.set({ ...store.state, settings: trimmed }, `panel ${name}`);
}

/** Another library material takes the place of all that was set of the one before. */
function withoutStale(settings: Values, name: string): Values {
  if (!/^materials\.\w+\.library$/.test(name)) return settings;
  const material = name.slice(0, -"library".length);
  return Object.fromEntries(
    Object.entries(settings).filter(([key]) => !key.startsWith(material) || !isLibraryField(key)),
  );
}
