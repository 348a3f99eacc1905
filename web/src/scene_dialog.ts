// The dialog of scenes: the models that were opened here, the presets, and a way to open a model.
import type { App } from "./app";
import { openDialog } from "./dialog";
import { make } from "./dom";
import { openButton } from "./drop";

/** A scene in the dialog. */
interface Card {
  name: string;
  title: string;
  about: string;
  /** The key that leads there too. */
  key?: string;
}

/** Presets and opened models with their pictures. */
export function chooseScene(app: App): void {
  const show = (cards: Card[]) => {
    const found = cards.map((card) => cardOf(app, card, () => dialog.close()));
    return make("div", { class: "grid" }, ...found);
  };
  const opened = app.scenes.opened.map(({ name, file, scene }) => ({
    ...{ name, title: file, about: scene.about },
  }));
  const presets = Object.entries(app.manifest.scenes).map(([name, { title, about }], index) => ({
    ...{ name, title: title || name, about },
    ...(index < 9 ? { key: `${index + 1}` } : {}),
  }));
  const models = [make("h3", {}, "Opened here, until this page is closed"), show(opened)];
  const content = [...(opened.length ? [...models, make("h3", {}, "Presets")] : []), show(presets)];
  const dialog = openDialog("Scenes", "scenes", ...content);
  const take: typeof app.open = (files) => {
    dialog.close();
    app.open(files);
  };
  dialog.querySelector("h2")!.after(openButton(take));
  dialog.querySelector<HTMLElement>("[aria-current]")?.focus();
}

function cardOf(app: App, card: Card, close: () => void): HTMLElement {
  const click = () => {
    close();
    app.choose(card.name);
  };
  const source = app.scenes.thumbnail(card.name);
  const picture = source
    ? make("img", { src: source, alt: "", width: 192, height: 144, loading: "lazy" })
    : make("span", { class: "blank" });
  const words = make(
    "span",
    { class: "words" },
    make("strong", {}, card.title),
    card.key ? make("kbd", {}, card.key) : null,
    make("span", { class: "about", title: card.about }, card.about),
  );
  const current = card.name === app.store.state.scene ? "true" : undefined;
  return make(
    "button",
    { type: "button", class: "scene", "aria-current": current, click },
    picture,
    words,
  );
}
