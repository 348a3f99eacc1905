// One row of the panel: label, widget, reset, and "auto" where a value may follow from others.
import { BooleanController, ColorController, type Controller, type GUI } from "lil-gui";
import type { Access, Plain } from "./access";
import type { Control } from "./control";
import { make } from "./dom";
import { Slider } from "./slider";
import { symbolOf } from "./symbols";

// A label of more letters than this stands above its widget.
const LONG = 26;

export interface Row {
  update(): void;
}

/** What a row is called in the document, and who is told which symbol the hand is on. */
export interface Place {
  id: string;
  light(symbol: string | null): void;
}

/** Append a control to a fold. */
export function addRow(fold: GUI, control: Control, access: Access, place: Place): Row {
  const proxy = {
    get value() {
      return access.get();
    },
    set value(value: Plain) {
      access.set(value);
    },
  };
  const controller = makeController(fold, control, proxy).name(control.label);
  controller.onFinishChange(() => access.done());
  controller.reset = () => {
    access.reset();
    return controller.updateDisplay();
  };
  const row = controller.domElement;
  const reset = resetButton(control, controller);
  const auto = control.optional ? autoButton(control, access) : null;
  row.prepend(reset);
  if (auto) controller.$widget.append(auto);
  const symbol = symbolOf(control.name);
  for (const event of ["pointerenter", "focusin"]) {
    row.addEventListener(event, () => place.light(symbol));
  }
  for (const event of ["pointerleave", "focusout"]) {
    row.addEventListener(event, () => place.light(null));
  }
  row.classList.toggle("long", control.label.length > LONG && control.kind === "number");
  nameRow(controller, control, access, place.id);
  const hint = hintBelow(control, access, row);
  const update = () => {
    controller.updateDisplay();
    hint();
    const modified = access.isModified();
    row.classList.toggle("modified", modified);
    reset.hidden = !modified;
    auto?.setAttribute("aria-pressed", `${access.isAuto()}`);
    row.classList.toggle("auto", access.isAuto());
  };
  update();
  return { update };
}

/** Below a menu stands what there is to say about what is chosen. */
function hintBelow(control: Control, access: Access, row: HTMLElement): () => void {
  if (!control.options.some(({ hint }) => hint)) return () => {};
  const line = make("p", { class: "source" });
  row.after(line);
  return () => {
    const chosen = control.options.find(({ value }) => `${value}` === `${access.get()}`);
    line.textContent = chosen?.hint ?? "";
    line.hidden = !chosen?.hint;
  };
}

function makeController(fold: GUI, control: Control, proxy: { value: Plain }): Controller {
  if (control.kind === "bool") return new BooleanController(fold, proxy, "value");
  if (control.kind === "color") return new ColorController(fold, proxy, "value", 1);
  if (control.kind === "option") {
    const options = control.options.map(({ title, value }) => [title, value]);
    return fold.add(proxy, "value", Object.fromEntries(options));
  }
  return new Slider(fold, proxy, control);
}

/** The label focuses the widget, where Backspace resets; it says the setting's name. */
function nameRow(controller: Controller, control: Control, access: Access, id: string): void {
  const inputs = [...controller.domElement.querySelectorAll<HTMLElement>("input, select")];
  const first = inputs.find((input) => input.tabIndex >= 0);
  if (first) first.dataset.control = id;
  const label = controller.$name;
  const standard = `Default: ${access.describeDefault()} ${control.unit}`.trimEnd();
  label.title = `${control.name}\n${standard} (double-click or Backspace)`;
  label.addEventListener("click", () => first?.focus());
  label.addEventListener("dblclick", () => controller.reset());
}

function resetButton(control: Control, controller: Controller): HTMLButtonElement {
  const click = () => {
    controller.reset();
    controller.domElement.querySelector<HTMLElement>("[data-control]")?.focus();
  };
  return make("button", {
    type: "button",
    class: "reset",
    title: "Reset",
    "aria-label": `Reset ${control.label}`,
    click,
  });
}

function autoButton(control: Control, access: Access): HTMLButtonElement {
  return make(
    "button",
    {
      type: "button",
      class: "auto-button",
      title: "Follow from the other fields",
      "aria-label": `${control.label}: auto`,
      click: () => access.setAuto(!access.isAuto()),
    },
    "auto",
  );
}
