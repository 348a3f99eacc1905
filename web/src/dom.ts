// Elements in one line.

type Content = Node | string | null | undefined;
type Attributes = Record<string, string | number | boolean | undefined | ((event: Event) => void)>;

/** An element; attributes that are functions are listeners, `false` and undefined are left out. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...content: Content[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== undefined && value !== false)
      element.setAttribute(name, `${value === true ? "" : value}`);
  }
  element.append(
    ...content.filter((part): part is Node | string => part !== null && part !== undefined),
  );
  return element;
}

/** The one element of an id, which index.html has. */
export function byId<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`index.html has no #${id}`);
  return found as T;
}

/** Whether keys belong to what is focused, because text is typed or chosen there. */
export function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return !["checkbox", "range"].includes(target.type);
  return target.isContentEditable || ["SELECT", "TEXTAREA"].includes(target.tagName);
}

/** Put the options of a menu under headings, each option under its own; one heading is none. */
export function grouped(select: HTMLSelectElement, headings: readonly string[]): void {
  if (new Set(headings).size < 2) return;
  const options = [...select.options];
  const chosen = select.value;
  const groups = [...new Set(headings)].map((label) =>
    make("optgroup", { label }, ...options.filter((_, index) => headings[index] === label)),
  );
  select.replaceChildren(...groups);
  select.value = chosen;
}
