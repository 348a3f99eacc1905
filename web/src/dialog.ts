// Dialogs: scenes to choose from, the sources that run, the keys.
import type { Manifest, Plan } from "./core/types";
import { thumbnail } from "./data";
import { make } from "./dom";
import { address } from "./server";
import type { State } from "./state";

/** A modal dialog that is gone once it is closed; a click beside it closes it too. */
export function openDialog(title: string, kind: string, ...content: Node[]): HTMLDialogElement {
  const close = make(
    "button",
    { type: "button", class: "close", "aria-label": "Close", click: () => dialog.close() },
    "×",
  );
  const heading = make("h2", {}, title);
  const dialog = make(
    "dialog",
    { class: kind, "aria-label": title },
    make("header", {}, heading, close),
    ...content,
  );
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}

/** The presets with their pictures. */
export function chooseScene(
  manifest: Manifest,
  chosen: string,
  choose: (name: string) => void,
): void {
  const cards = Object.entries(manifest.scenes).map(([name, { title, about }], index) => {
    const picture = make("img", {
      src: thumbnail(name),
      alt: "",
      width: 192,
      height: 144,
      loading: "lazy",
    });
    const key = index < 9 ? make("kbd", {}, `${index + 1}`) : null;
    const words = make(
      "span",
      { class: "words" },
      make("strong", {}, title || name),
      key,
      make("span", {}, about),
    );
    const click = () => {
      dialog.close();
      choose(name);
    };
    return make(
      "button",
      {
        type: "button",
        class: "scene",
        "aria-current": name === chosen ? "true" : undefined,
        click,
      },
      picture,
      words,
    );
  });
  const dialog = openDialog("Scenes", "scenes", make("div", { class: "grid" }, ...cards));
  dialog.querySelector<HTMLElement>("[aria-current]")?.focus();
}

/** The specialised sources of the plan that is shown, with where each line comes from. */
export function showSources(plan: Plan): void {
  const entries = plan.passes.flatMap((pass) =>
    pass.batches.flatMap(({ program }) =>
      (["fragment", "vertex"] as const).map((stage) => ({
        name: `${pass.name}, ${stage}`,
        stage,
        program: plan.programs[program]!,
      })),
    ),
  );
  const select = make("select", { "aria-label": "Program", change: () => show() });
  for (const [index, { name }] of entries.entries())
    select.append(make("option", { value: index }, name));
  const facts = make("span", { class: "facts" });
  const gutter = make("pre", { class: "gutter", "aria-hidden": "true" });
  const code = make("pre", { class: "code", tabindex: 0, "aria-label": "Source" });
  const current = () => entries[Number(select.value)]!;
  const click = async () => {
    const { program, stage } = current();
    if (await copyText(program[stage])) facts.textContent = "Copied";
  };
  const copy = make("button", { type: "button", click }, "Copy");
  const show = () => {
    const { program, stage } = current();
    const lines = stage === "vertex" ? program.vertex_lines : program.fragment_lines;
    code.textContent = program[stage];
    gutter.textContent = lines.join("\n");
    facts.textContent = `${lines.length} lines, as compiled`;
  };
  show();
  openDialog(
    "GLSL of this picture",
    "sources",
    make("div", { class: "bar" }, select, facts, copy),
    make("div", { class: "listing" }, gutter, code),
  );
}

/** Put a text on the clipboard; where that is refused, offer it to copy by hand. */
export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const field = make("textarea", { readonly: true, rows: 4, "aria-label": "Text to copy" }, text);
    openDialog("Copy this", "copy", field);
    field.select();
    return false;
  }
}

const HANDS: [keys: string, what: string][] = [
  ["Drag", "orbit"],
  ["Wheel, pinch", "zoom"],
  ["Right drag, two fingers, Shift drag", "move sideways"],
  ["Click", "show the material of what is there"],
  ["Double-click", "go to what is there"],
  ["Arrow keys, + and -", "orbit and zoom"],
  ["Home", "camera back to its place"],
  ["1 to 9", "scenes"],
  ["H", "hide or show the panel"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
  ["On a slider: arrows, with Shift ten times", "change its value"],
  ["On a slider's name: double-click, Backspace", "back to its default"],
];

/** The keys, and the same picture by other means. */
export function showHelp(state: State): void {
  const keys = make(
    "table",
    {},
    ...HANDS.map(([key, what]) =>
      make("tr", {}, make("th", { scope: "row" }, key), make("td", {}, what)),
    ),
  );
  const about = make(
    "p",
    {},
    "Pick a scene, pick how its surfaces answer light, and see the picture and what it costs. Every choice in the panel is one small shader file; its formula and its source stand below its name. A control that the current choices do not use is not there.",
  );
  const set = Object.entries(state.settings).map(
    ([name, value]) => ` --set ${quoted(`${name}=${value}`)}`,
  );
  const command = `lightbench render ${state.scene}${set.join("")}`;
  const link = new URL(address(state, [640, 480]), location.href.split("#")[0]).href;
  openDialog(
    "Help",
    "help",
    about,
    keys,
    make("h3", {}, "This picture elsewhere"),
    make(
      "p",
      {},
      "The address of this page is the picture. The same names work on the command line and over HTTP:",
    ),
    make("pre", { tabindex: 0 }, command),
    make("pre", { tabindex: 0 }, link),
  );
}

function quoted(text: string): string {
  return /^[\w.,=+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}
