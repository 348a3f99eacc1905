// Tabs of the panel: one page shown at a time, the last one remembered.

import { make } from "./dom";
import { TABS, type Tab } from "./groups";
import { recall, remember } from "./memory";

export class Tabs {
  readonly pages = new Map<Tab, HTMLElement>();
  private readonly buttons = new Map<Tab, HTMLButtonElement>();
  private shown: Tab = "model";
  /** The one that was asked for, shown wherever it has content. */
  private wanted: Tab;

  constructor(
    root: HTMLElement,
    private readonly changed: () => void,
  ) {
    const bar = make("div", { role: "tablist", "aria-label": "Settings", class: "tabs" });
    root.replaceChildren(bar);
    for (const tab of Object.keys(TABS) as Tab[]) {
      const button = make("button", { type: "button", role: "tab", id: `tab-${tab}` }, TABS[tab]);
      const page = make("div", { role: "tabpanel", id: `page-${tab}` });
      button.setAttribute("aria-controls", page.id);
      page.setAttribute("aria-labelledby", button.id);
      button.addEventListener("click", () => this.select(tab));
      button.addEventListener("keydown", (event) => this.key(event, tab));
      bar.append(button);
      root.append(page);
      this.buttons.set(tab, button);
      this.pages.set(tab, page);
    }
    const last = recall<Tab>("tab", "model");
    this.wanted = this.buttons.has(last) ? last : "model";
    this.show(this.wanted);
  }

  get selected(): Tab {
    return this.shown;
  }

  /** A page without content has no tab. */
  offer(tab: Tab, offered: boolean): void {
    this.buttons.get(tab)!.hidden = !offered;
  }

  /** Show the tab that was asked for; where it has no content, the first that has. */
  settle(): void {
    const offered = [...this.buttons.keys()].filter((tab) => !this.buttons.get(tab)!.hidden);
    const tab = offered.includes(this.wanted) ? this.wanted : offered[0];
    if (tab && tab !== this.shown) this.show(tab);
  }

  private select(tab: Tab): void {
    this.wanted = tab;
    this.show(tab);
    remember("tab", tab);
    this.changed();
  }

  private show(tab: Tab): void {
    this.shown = tab;
    for (const [name, button] of this.buttons) {
      button.setAttribute("aria-selected", `${name === tab}`);
      button.tabIndex = name === tab ? 0 : -1;
      this.pages.get(name)!.hidden = name !== tab;
    }
  }

  private key(event: KeyboardEvent, tab: Tab): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const names = [...this.buttons.keys()].filter((name) => !this.buttons.get(name)!.hidden);
    const next = names[(names.indexOf(tab) + step + names.length) % names.length]!;
    this.select(next);
    this.buttons.get(next)!.focus();
    event.preventDefault();
  }
}
