// Dialogs: scenes to choose from, the sources that run, the keys.
import type { Plan } from "./core/types";
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

const HANDS: [title: string, rows: [keys: string, what: string][]][] = [
  [
    "Orbit",
    [
      ["Drag", "turn about what is in the middle"],
      ["Wheel, pinch", "zoom"],
      ["Right drag, two fingers, Shift drag", "move sideways"],
      ["Arrow keys, + and -", "orbit and zoom"],
      ["F", "walk instead"],
    ],
  ],
  [
    "Walk",
    [
      ["W S, A D", "forward and back, left and right"],
      ["R F", "up and down"],
      ["Shift", "three times as fast"],
      ["Drag, arrow keys", "look around"],
      ["Wheel", "forward and back"],
      ["Right drag", "move sideways"],
      ["By touch", "one finger looks, two walk; or use the stick on the picture"],
      ["Escape", "back to orbit"],
    ],
  ],
  [
    "Either way",
    [
      ["Click", "show the material of what is there"],
      ["Double-click", "go to what is there"],
      ["Home", "camera back to its place"],
      ["1 to 9", "scenes, each as you left it"],
      ["Drop a file", "open a model: .glb, or .gltf with its files"],
      ["H", "hide or show the panel"],
      ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
      ["On a slider: arrows, with Shift ten times", "change its value"],
      ["On a slider's name: double-click, Backspace", "back to its default"],
    ],
  ],
];

/** The keys, and the same picture by other means; `file` is that of a model opened here. */
export function showHelp(state: State, file: string | null): void {
  const keys = make(
    "table",
    {},
    ...HANDS.map(([title, rows]) =>
      make(
        "tbody",
        {},
        make("tr", {}, make("th", { colspan: 2, scope: "rowgroup", class: "part" }, title)),
        ...rows.map(([key, what]) =>
          make("tr", {}, make("th", { scope: "row" }, key), make("td", {}, what)),
        ),
      ),
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
  const command = `lightbench render ${file ? quoted(file) : state.scene}${set.join("")}`;
  const link = new URL(address(state, [640, 480]), location.href.split("#")[0]).href;
  const elsewhere = file
    ? "The model is a file of your own, which no address leads to. The command line draws it too:"
    : "The address of this page is the picture. The same names work on the command line and over HTTP:";
  openDialog(
    "Help",
    "help",
    about,
    keys,
    make("h3", {}, "This picture elsewhere"),
    make("p", {}, elsewhere),
    make("pre", { tabindex: 0 }, command),
    ...(file ? [] : [make("pre", { tabindex: 0 }, link)]),
  );
}

function quoted(text: string): string {
  return /^[\w.,=+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}
