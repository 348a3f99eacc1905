// What the browser remembers between visits about the page itself; nothing of the picture.

const KEY = "lightbench";

/** The remembered value of a name. */
export function recall<T>(name: string, otherwise: T): T {
  return (all()[name] as T | undefined) ?? otherwise;
}

/** Remember a value, where the browser allows that. */
export function remember(name: string, value: unknown): void {
  try {
    localStorage.setItem(KEY, JSON.stringify({ ...all(), [name]: value }));
  } catch {
    // Private windows may refuse: then nothing is remembered.
  }
}

function all(): Record<string, unknown> {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(KEY) ?? "{}");
    return typeof found === "object" && found !== null ? (found as Record<string, unknown>) : {};
  } catch {
    return {};
  }
}
