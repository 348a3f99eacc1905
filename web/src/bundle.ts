// A model of a person's own, from the files that were dropped, as one body to send.
import { LightbenchError } from "./core/errors";

/** A file that was dropped or chosen; `path` begins at the folder that it came with, if any. */
export interface Given {
  readonly path: string;
  readonly file: Blob;
}

export interface Model {
  readonly name: string;
  readonly body: Blob | string;
}

/** An entry of `buffers` or `images` that names a file beside the model. */
type Reference = { uri: string; mimeType?: unknown };

const MODEL = /\.(glb|gltf)$/i;
const MIME: Readonly<Record<string, string>> = {
  png: "image/png",
  jpg: "image/jpeg",
  jpeg: "image/jpeg",
  webp: "image/webp",
};
const OTHER = "application/octet-stream";
// Bytes that are turned into text at once: more would be too many arguments of a call.
const CHUNK = 0x8000;
// Names that a sentence lists before it only counts.
const LISTED = 4;

/**
 * The one model among the files; what a `.gltf` refers to is put into it as data URIs.
 *
 * Rejects with LightbenchError: no model or several, a file that is missing, or cannot be read.
 */
export async function bundle(files: readonly Given[]): Promise<Model> {
  const { path, file } = onlyModel(files);
  const name = base(path);
  if (!/\.gltf$/i.test(name)) return { name, body: file };
  return { name, body: await embedded(name, await readable(name, file.text()), path, files) };
}

function onlyModel(files: readonly Given[]): Given {
  const models = files.filter(({ path }) => MODEL.test(path));
  const names = (given: readonly Given[]) => listed(given.map(({ path }) => base(path)));
  if (models.length > 1)
    throw new LightbenchError(`Drop one model at a time; these are ${names(models)}.`);
  if (models[0]) return models[0];
  const what = files.length ? `There is no model in ${names(files)}` : "There is no file in it";
  throw new LightbenchError(`${what}: drop a .glb, or a .gltf with the files that it refers to.`);
}

/** The text of a model that needs nothing beside it; as it is where there is nothing to put in. */
async function embedded(
  name: string,
  text: string,
  path: string,
  files: readonly Given[],
): Promise<string> {
  const document = parsed(text);
  const found = references(document).map(
    (entry) => [entry, beside(entry.uri, path, files)] as const,
  );
  if (!found.length) return text;
  const missing = [...new Set(found.flatMap(([entry, given]) => (given ? [] : [entry.uri])))];
  if (missing.length) {
    const were = missing.length > 1 ? "which were" : "which was";
    throw new LightbenchError(
      `${name}: refers to ${listed(missing)}, ${were} not dropped: drop all its files together.`,
    );
  }
  for (const [entry, given] of found) entry.uri = await dataUri(entry, given!);
  return JSON.stringify(document);
}

/** What is no JSON is left to the server, which says where it breaks. */
function parsed(text: string): unknown {
  try {
    return JSON.parse(text.replace(/^\uFEFF/, ""));
  } catch {
    return null;
  }
}

function references(document: unknown): Reference[] {
  if (typeof document !== "object" || document === null) return [];
  const { buffers, images } = document as Record<string, unknown>;
  const entries = [buffers, images].flatMap((table): unknown[] =>
    Array.isArray(table) ? table : [],
  );
  return entries.filter(
    (entry): entry is Reference =>
      typeof (entry as Partial<Reference> | null)?.uri === "string" &&
      !/^data:/i.test((entry as Reference).uri),
  );
}

/** The file at a URI relative to the model, else the one of that name, wherever it was. */
function beside(uri: string, model: string, files: readonly Given[]): Given | undefined {
  const wanted = decoded(uri).replace(/^(\.\/)+/, "");
  const folder = model.slice(0, model.lastIndexOf("/") + 1);
  const exact = files.find(({ path }) => path === `${folder}${wanted}`);
  return exact ?? files.find(({ path }) => base(path) === base(wanted));
}

function decoded(uri: string): string {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

async function dataUri({ mimeType }: Reference, { path, file }: Given): Promise<string> {
  const ending = path.slice(path.lastIndexOf(".") + 1).toLowerCase();
  const kind = typeof mimeType === "string" ? mimeType : (MIME[ending] ?? OTHER);
  const bytes = new Uint8Array(await readable(base(path), file.arrayBuffer()));
  let binary = "";
  for (let at = 0; at < bytes.length; at += CHUNK)
    binary += String.fromCharCode(...bytes.subarray(at, at + CHUNK));
  return `data:${kind};base64,${btoa(binary)}`;
}

/** What a browser refuses to read is said by name: a folder, or a file changed since. */
async function readable<T>(name: string, content: Promise<T>): Promise<T> {
  return content.catch(() => {
    throw new LightbenchError(`${name}: cannot be read; is it still there?`);
  });
}

function base(path: string): string {
  return path.slice(path.lastIndexOf("/") + 1);
}

function listed(names: readonly string[]): string {
  const shown = names.length > LISTED ? names.slice(0, LISTED - 1) : names.slice(0, -1);
  const last = names.length > LISTED ? `${names.length - shown.length} more` : names.at(-1)!;
  return shown.length ? `${shown.join(", ")} and ${last}` : last;
}
