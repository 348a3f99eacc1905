// A choice in the panel: its menu, what it is, its formula, its source, what it breaks.
import { grouped, make } from "./dom";
import { Formula } from "./formula";
import type { Group } from "./groups";

export interface Card {
  select: HTMLSelectElement;
  content: HTMLElement[];
  formula: Formula | null;
}

/** The parts of a choice's fold. */
export function choiceCard(group: Group, symbols: string[], choose: (value: string) => void): Card {
  const { options, chosen, meta, setting } = group.choice!;
  const select = make("select", {
    class: "choice",
    "aria-label": group.title,
    "data-control": setting,
    change: () => choose(select.value),
  });
  for (const { value, title, hint } of options) {
    select.append(make("option", { value, title: hint, selected: value === chosen }, title));
  }
  grouped(
    select,
    options.map(({ kind }) => kind),
  );
  const formula = meta.equation ? new Formula(meta.equation, symbols) : null;
  const content: (HTMLElement | null)[] = [
    group.about ? make("p", { class: "what", title: group.about }, gist(group.about)) : null,
    formula?.element ?? null,
    meta.about ? make("p", { class: "about" }, meta.about) : null,
    ...Object.entries(meta.breaks).map(([law, why]) =>
      make("p", { class: "breaks" }, make("strong", {}, `Breaks ${law}: `), why),
    ),
    meta.source ? make("p", { class: "source" }, "Source: ", meta.source) : null,
  ];
  return { select, content: content.filter((part) => part !== null), formula };
}

/** The first clause: the rest says how it is computed, which can wait for a pointer at rest. */
function gist(about: string): string {
  return `${/^.*?(?=[.:;]\s|\.$|$)/s.exec(about)![0]}.`;
}
