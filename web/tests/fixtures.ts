/** The cases that tests/test_assembly.py runs on the Python twins. */

import { readFileSync } from "node:fs";
import type { Request } from "../src/core/assemble";
import type { Library } from "../src/core/library";
import { NO_PATTERN } from "../src/core/surface";
import type { Choice, Folder, Parameter, ShaderFile } from "../src/core/types";

export interface ExpressionCase {
  readonly text: string;
  readonly names?: Record<string, number | string>;
  readonly value?: number | string;
  readonly error?: string;
}

type Lines = readonly string[];

/** A file as a case gives it: its lines, or its front matter with `code`. */
interface GivenFile extends Partial<Omit<Choice, "parameters">> {
  readonly code: Lines;
  readonly functions?: Record<string, number>;
  readonly parameters?: Record<string, Partial<Parameter>>;
}

export interface AssemblyCase {
  readonly name: string;
  readonly files: Record<string, GivenFile | Lines>;
  readonly folders?: Record<string, Partial<Folder>>;
  readonly request?: Partial<Request>;
  readonly prologue?: Lines;
  readonly body?: readonly (readonly [where: string, line: string])[];
  readonly settings?: Lines;
  readonly used?: Lines;
  readonly uniforms?: Record<string, string>;
  readonly attributes?: Record<string, string>;
  readonly error?: string;
}

export interface LogCase {
  readonly name: string;
  readonly log: string;
  readonly text: string;
  readonly lines: Lines;
  readonly explained: string;
}

interface Assembly {
  readonly cases: readonly AssemblyCase[];
  readonly logs: readonly LogCase[];
}

function read(name: string): unknown {
  const path = new URL(`../../tests/fixtures/${name}.json`, import.meta.url);
  return JSON.parse(readFileSync(path, "utf8"));
}

export const expressions = read("expressions") as readonly ExpressionCase[];
export const assembly = read("assembly") as Assembly;

const MATERIAL_FIELDS = {
  base_color: "vec3",
  metalness: "float",
  roughness: "float",
  f0: "vec3",
  eta: "vec3",
  k: "vec3",
  kd: "vec3",
  ks: "vec3",
  shininess: "float",
  ambient: "vec3",
};

export function libraryOf(test: AssemblyCase): Library {
  const files = Object.entries(test.files).map(([path, given]) => [path, fileOf(given)]);
  const folders = Object.entries(test.folders ?? {}).map(([name, folder]) => [
    name,
    { title: "", default: "", about: "", optional: [], per: "frame", ...folder },
  ]);
  return {
    files: Object.fromEntries(files),
    folders: Object.fromEntries(folders),
    material_fields: MATERIAL_FIELDS,
    icosphere_errors: [],
  };
}

function fileOf(given: GivenFile | Lines): ShaderFile {
  const { code, functions = {}, ...meta } = "code" in given ? given : { code: given };
  const parameters = Object.entries(meta.parameters ?? {}).map(([name, parameter]) => [
    name,
    { kind: "float", per: "frame", ...parameter },
  ]);
  return {
    code: code.join("\n"),
    functions,
    meta: {
      ...{ title: "", equation: "", source: "", domain: {}, unit: "", about: "", breaks: {} },
      ...{ textbook_of: "", material: [], surface: [], reads: [], signed: false },
      ...meta,
      parameters: Object.fromEntries(parameters),
    },
  };
}

export function requestOf(test: AssemblyCase): Request {
  const given = { entry: "passes/p.glsl", stage: "FRAGMENT" as const, choices: {}, values: {} };
  return { ...given, lists: {}, pattern: NO_PATTERN, varyings: [], ...test.request };
}
