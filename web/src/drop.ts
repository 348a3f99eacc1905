// Files that a person drops anywhere on the page, or chooses by hand.
import type { Given } from "./bundle";
import { byId, make } from "./dom";

export type Take = (files: Promise<Given[]>) => void;

// Browsers tell of a drag that goes on at least this often, and of its end not always.
const GONE_MILLISECONDS = 600;
// More files than a model has: the rest of a large folder that was dropped by mistake.
const MOST_FILES = 2000;
// What a .gltf refers to.
const KINDS = ".glb,.gltf,.bin,.png,.jpg,.jpeg,.webp";

/** Take what is dropped on the page, and say that it may be while it is dragged there. */
export function acceptDrops(take: Take): void {
  const sign = byId("drop");
  let timer: ReturnType<typeof setTimeout> | undefined;
  const show = (shown: boolean) => {
    clearTimeout(timer);
    sign.hidden = !shown;
    if (shown) timer = setTimeout(() => show(false), GONE_MILLISECONDS);
  };
  for (const kind of ["dragenter", "dragover"] as const) {
    window.addEventListener(kind, (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      event.dataTransfer!.dropEffect = "copy";
      show(true);
    });
  }
  window.addEventListener("drop", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    show(false);
    document.querySelector<HTMLDialogElement>("dialog[open]")?.close();
    take(dropped(event.dataTransfer!));
  });
}

function hasFiles(event: DragEvent): boolean {
  return event.dataTransfer?.types.includes("Files") ?? false;
}

/** A button that opens the system's choice of files. */
export function openButton(take: Take): HTMLElement {
  const change = () => {
    const files = [...(input.files ?? [])].map((file) => ({ path: file.name, file }));
    if (files.length) take(Promise.resolve(files));
  };
  const input = make("input", {
    type: "file",
    multiple: true,
    hidden: true,
    accept: KINDS,
    "aria-label": "Model files",
    change,
  });
  const click = () => input.click();
  const button = make("button", { type: "button", class: "open", click }, "Open a model\u2026");
  return make("span", {}, button, input);
}

/** The files of a drop, those of folders with their path. What is dropped is only there at once. */
function dropped(transfer: DataTransfer): Promise<Given[]> {
  const items = [...transfer.items].filter((item) => item.kind === "file");
  const found = items.map(async (item): Promise<Given[]> => {
    const entry = item.webkitGetAsEntry?.();
    const file = item.getAsFile();
    if (entry?.isDirectory) return filesOf(entry as FileSystemDirectoryEntry, `${entry.name}/`);
    return file ? [{ path: file.name, file }] : [];
  });
  return Promise.all(found).then((files) => files.flat().slice(0, MOST_FILES));
}

async function filesOf(folder: FileSystemDirectoryEntry, path: string): Promise<Given[]> {
  const reader = folder.createReader();
  const files: Given[] = [];
  while (files.length < MOST_FILES) {
    const entries = await new Promise<FileSystemEntry[]>((done) => {
      reader.readEntries(done, () => done([]));
    });
    if (!entries.length) break;
    const given = await Promise.all(entries.map((entry) => ofEntry(entry, path)));
    files.push(...given.flat());
  }
  return files;
}

async function ofEntry(entry: FileSystemEntry, path: string): Promise<Given[]> {
  if (entry.isDirectory) {
    return filesOf(entry as FileSystemDirectoryEntry, `${path}${entry.name}/`);
  }
  const file = await new Promise<File | null>((done) => {
    (entry as FileSystemFileEntry).file(done, () => done(null));
  });
  return file ? [{ path: `${path}${entry.name}`, file }] : [];
}
