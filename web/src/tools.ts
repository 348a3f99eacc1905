// The bar's buttons and the page's keys.
import type { App } from "./app";
import type { Use } from "./calibration";
import { copyText, showHelp, showSources } from "./dialog";
import { byId, isTyping } from "./dom";
import { recall, remember } from "./memory";
import { chooseScene } from "./scene_dialog";
import { presetAt } from "./scenes";
import { canvasOf } from "./snapshot";

const UNSHARED = "No link leads to this picture: the model is a file of your own";

/** Connect buttons and keys to the page. */
export function addTools(app: App): void {
  const button = (id: string, click: (button: HTMLButtonElement) => void) => {
    const found = byId<HTMLButtonElement>(id);
    found.addEventListener("click", () => click(found));
    return found;
  };
  button("scene", () => chooseScene(app));
  const undo = button("undo", () => app.store.undo());
  const redo = button("redo", () => app.store.redo());
  button("server", () => app.wipe.show(!app.wipe.shown));
  button("sources", () => app.view.plan && showSources(app.view.plan));
  button("atlas", () => {
    import("./atlas").then(
      ({ showAtlas }) => showAtlas(),
      () => app.notices.fail("The atlas could not be loaded. Reload the page to try again."),
    );
  });
  button("display", () => {
    import("./calibration").then(
      ({ showCalibration }) => showCalibration(useOf(app)),
      () => app.notices.fail("The calibration could not be loaded. Reload the page to try again."),
    );
  });
  button("save", () => void save(app));
  const share = button("share", async () => {
    const copied = await copyText(app.link.flush());
    if (copied) app.notices.say("The link to this picture is on the clipboard.", 4);
  });
  share.hidden = location.protocol === "file:"; // a link that nobody else could open
  const shareable = share.title;
  button("help", () => showHelp(app.store.state, app.file));
  const follow = () => {
    share.disabled = app.file !== null;
    share.title = app.file === null ? shareable : UNSHARED;
    undo.disabled = !app.store.canUndo;
    redo.disabled = !app.store.canRedo;
  };
  app.store.listen(follow);
  follow();
  hidePanel(recall("hidden", false));
  window.addEventListener("keydown", (event) => key(app, event), { capture: true });
}

/** What a gamma is for: the transfer of that name, where the menu has it. */
function useOf(app: App): Use {
  const { range } = app.manifest.files["transfers/gamma.glsl"]?.meta.parameters.gamma ?? {};
  const use = (gamma: number) => {
    const { scene, settings } = app.store.state;
    app.store.set({ scene, settings: { ...settings, transfer: "gamma", gamma } });
  };
  return { range: range ?? [0, 0], use };
}

function key(app: App, event: KeyboardEvent): void {
  const command = event.ctrlKey || event.metaKey;
  const letter = event.key.toLowerCase();
  if (isTyping(event.target) || document.querySelector("dialog[open]")) return;
  if (command && letter === "z") {
    if (event.shiftKey) app.store.redo();
    else app.store.undo();
  } else if (command && letter === "y") app.store.redo();
  else if (command || event.altKey) return;
  else if (/^[1-9]$/.test(letter)) {
    const name = presetAt(app.manifest, Number(letter));
    if (name) app.choose(name);
  } else if (letter === "h") hidePanel(!document.body.classList.contains("no-panel"));
  else if (letter === "?") showHelp(app.store.state, app.file);
  else if (letter === "home" && !(event.target as HTMLElement).closest("aside"))
    app.viewpoint.show("");
  else return;
  event.preventDefault();
}

function hidePanel(hidden: boolean): void {
  document.body.classList.toggle("no-panel", hidden);
  remember("hidden", hidden);
}

/** The display codes as they are, through no other encoding. */
async function save(app: App): Promise<void> {
  const { plan, renderer } = app.view;
  if (!plan || !renderer) return;
  const canvas = canvasOf(renderer.readDisplay(), plan.size);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await canvas.convertToBlob({ type: "image/png" }));
  const name = app.file?.replace(/\.\w+$/, "") ?? app.store.state.scene;
  link.download = `${name.replaceAll("/", "-")}.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
