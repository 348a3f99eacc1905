// The dialog of scenes: the models that were opened here, the presets, and a way to open a model.
import type { App } from "./app";
import { words } from "./control";
import { openDialog } from "./dialog";
import { make } from "./dom";
import { openButton } from "./drop";
import { presetAt, presetFolders } from "./scenes";

/** A scene in the dialog. */
interface Card {
  name: string;
  title: string;
  about: string;
  /** The key that leads there too. */
  key?: string;
}

const DIGITS = [..."123456789"];

/** Presets and opened models with their pictures. */
export function chooseScene(app: App): void {
  const show = (cards: Card[]) => {
    const found = cards.map((card) => cardOf(app, card, () => dialog.close()));
    return make("div", { class: "grid" }, ...found);
  };
  const opened = app.scenes.opened.map(({ name, file, scene }) => ({
    ...{ name, title: file, about: scene.about },
  }));
  const models = [make("h3", {}, "Opened here, until this page is closed"), show(opened)];
  const presets = [...presetFolders(app.manifest)].flatMap(([folder, names]) => {
    const heading = folder ? words(folder) : opened.length ? "Presets" : "";
    const cards = show(names.map((name) => preset(app, name)));
    return heading ? [make("h3", {}, heading), cards] : [cards];
  });
  const content = [...(opened.length ? models : []), ...presets];
  const dialog = openDialog("Scenes", "scenes", ...content);
  const take: typeof app.open = (files) => {
    dialog.close();
    app.open(files);
  };
  dialog.querySelector("h2")!.after(openButton(take));
  dialog.querySelector<HTMLElement>("[aria-current]")?.focus();
}

function preset({ manifest }: App, name: string): Card {
  const { title, about } = manifest.scenes[name]!;
  const digit = DIGITS.find((key) => presetAt(manifest, Number(key)) === name);
  return { name, title: title || name, about, ...(digit ? { key: digit } : {}) };
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
  const text = make(
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
    text,
  );
}
