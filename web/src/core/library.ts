/** Questions to the shader library that the manifest holds. Twin of the methods in library.py. */

import type { Choice, Manifest, Parameter, Pass, ShaderFile } from "./types";

/** What planning reads of the manifest. */
export type Library = Omit<Manifest, "scenes" | "materials" | "schema">;

export type NamedParameter = readonly [name: string, parameter: Parameter];

/** Answers that hold as long as the library does. */
interface Index {
  readonly choices: ReadonlyMap<string, readonly string[]>;
  readonly passes: ReadonlyMap<string, Pass>;
  readonly parameters: readonly NamedParameter[];
  /** What passes write once for each light. */
  readonly perLight: ReadonlySet<string>;
  /** The settings that a material may make its own choice of, with their folders. */
  readonly ofMaterials: ReadonlyMap<string, string>;
}

export const GLSL_TYPES: Readonly<Record<string, string>> = { float: "float", color: "vec3" };

const indices = new WeakMap<Library, Index>();

/** Names of a folder's files, sorted. */
export function choices(library: Library, folder: string): readonly string[] {
  return indexOf(library).choices.get(folder) ?? [];
}

/** The folder that a choice setting picks from. */
export function folderOf(library: Library, setting: string): string {
  return Object.keys(library.folders).find((n) => library.folders[n]!.setting === setting)!;
}

/** Front matter of every pass by its name, sorted. */
export function passes(library: Library): ReadonlyMap<string, Pass> {
  return indexOf(library).passes;
}

/** The parameters of all files, in the order of the files. */
export function parameters(library: Library): readonly NamedParameter[] {
  return indexOf(library).parameters;
}

/** Whether there is one such texture for each light that casts shadows. */
export function perLight(library: Library, resource: string): boolean {
  return indexOf(library).perLight.has(resource);
}

/** The folder of each setting that a material may make its own choice of. */
export function ofMaterials(library: Library): ReadonlyMap<string, string> {
  return indexOf(library).ofMaterials;
}

function indexOf(library: Library): Index {
  let found = indices.get(library);
  if (!found) {
    found = makeIndex(library);
    indices.set(library, found);
  }
  return found;
}

function makeIndex(library: Library): Index {
  const paths = Object.keys(library.files).sort();
  const below = (folder: string) => paths.filter((path) => path.startsWith(`${folder}/`));
  const names = Object.keys(library.folders).map(
    (folder) => [folder, below(folder).map(nameOf).sort()] as const,
  );
  const found = paths.flatMap((path): [string, Pass][] => {
    const meta = library.files[path]!.meta;
    return isPass(meta) ? [[nameOf(path), meta]] : [];
  });
  const files = Object.values<ShaderFile>(library.files);
  return {
    choices: new Map(names),
    passes: new Map(found),
    parameters: files.flatMap((file) => Object.entries(file.meta.parameters)),
    perLight: new Set(
      found.flatMap(([, meta]) => (meta.each === "light" ? Object.keys(meta.writes) : [])),
    ),
    ofMaterials: new Map(
      Object.entries(library.folders).flatMap(([name, { setting, per }]) =>
        per === "material" ? [[setting, name] as const] : [],
      ),
    ),
  };
}

function isPass(meta: Pass | Choice): meta is Pass {
  return "draw" in meta;
}

/** A path without its folder and without `.glsl`. */
function nameOf(path: string): string {
  return path.slice(path.indexOf("/") + 1, -".glsl".length);
}
