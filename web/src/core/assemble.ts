/**
 * From an entry file and its settings to the one GLSL source that both runtimes compile.
 *
 * Resolves `#include`, `#if` and `#for`, so that what is left is live code only, then declares
 * exactly the defines, parameters and samplers that this code names. Twin of assemble.py.
 */

import { LightbenchError, ShaderError } from "./errors";
import { evaluate } from "./expression";
import { folderOf, GLSL_TYPES, type Library, perLight } from "./library";
import { live, type Output, type Stage } from "./prune";
import { type Pattern, patternLists, type Seen } from "./surface";

export type Record_ = Readonly<Record<string, string>>;
export type Lists = Readonly<Record<string, readonly Record_[]>>;

/**
 * What to assemble: one stage of one file, under fully resolved settings.
 *
 * `values` holds the int and bool parameters and other defines, `lists` the records that `#for`
 * repeats over, `pattern` how a surface varies. `varyings` are those that the fragment stage takes
 * in: the vertex stage's others go.
 */
export interface Request {
  readonly entry: string;
  readonly stage: Stage;
  readonly choices: Readonly<Record<string, string>>;
  readonly values: Readonly<Record<string, number>>;
  readonly lists: Lists;
  readonly pattern: Pattern;
  readonly varyings: readonly string[];
}

/** One specialised source. `lines[i]` says where the text's line i comes from, `file:line`. */
export interface Source {
  readonly text: string;
  readonly lines: readonly string[];
  readonly files: readonly string[];
  readonly settings: readonly string[];
  readonly uniforms: Readonly<Record<string, string>>;
  readonly attributes: Readonly<Record<string, string>>;
  readonly varyings: readonly string[];
}

type Line = readonly [number: number, text: string];

const DIRECTIVE = /^\s*#\s*(\w*)\s*(.*?)\s*$/;
const INCLUDE = /^(?:"([^"]+)"|<(\w+)>)$/;
const NAME = /[A-Za-z_]\w*/g;
export const UNIFORM = /^\s*uniform\s+(?:(?:high|medium|low)p\s+)?(\w+)\s+(u_\w+)\s*;/gm;
const TAKEN = /^\s*in\s+(\w+)\s+(v_\w+)\s*;/gm;
/** Fields that only the base under the facets has. */
const BASE_FIELDS = ["base_color", "kd"];
const ATTRIBUTE = /^\s*in\s+(\w+)\s+(a_\w+)\s*;/gm;

/**
 * The specialised source of one stage.
 *
 * Throws ShaderError naming file and line for a missing or cyclic include, an undefined name in
 * `#if` or an unbalanced directive.
 */
export function assemble(library: Library, request: Request): Source {
  const first = new Expansion(library, request, fieldLists(library, request, []));
  const expansion = new Expansion(library, request, fieldLists(library, request, first.files));
  const output = live(expansion.output, request.stage, request.varyings);
  const body = output.map(([text]) => text).join("\n");
  const head = prologue(library, expansion, new Set(body.match(NAME)));
  const text = [...head, body, ""].join("\n");
  return {
    text,
    lines: [
      ...head.map((_, index) => `prologue:${index + 1}`),
      ...output.map(([, file, line]) => `${file}:${line}`),
    ],
    files: expansion.files,
    settings: expansion.settings,
    uniforms: declarations(text, UNIFORM),
    attributes: declarations(text, ATTRIBUTE),
    varyings: Object.keys(declarations(text, TAKEN)).sort(),
  };
}

/** What a text declares by `pattern`, and its type. */
export function declarations(text: string, pattern: RegExp): Record<string, string> {
  return Object.fromEntries(Array.from(text.matchAll(pattern), ([, kind, name]) => [name!, kind!]));
}

/** The lists and defines that follow from what the files say that they read. */
function fieldLists(library: Library, request: Request, files: readonly string[]): Seen {
  const metas = files.map((path) => library.files[path]!.meta);
  const read = new Set(metas.flatMap((meta) => meta.material));
  const parts = new Set<string>(metas.flatMap((meta) => meta.surface));
  const light = metas.flatMap((meta) =>
    Object.keys(meta.parameters).filter((name) => meta.parameters[name]!.per === "light"),
  );
  const material = Object.entries(library.material_fields).filter(([name]) => read.has(name));
  const base = (name: string) => `${Number(BASE_FIELDS.includes(name))}`;
  const { lists, defines } = patternLists(library, request.pattern, read, parts);
  const fields = {
    MATERIAL_FIELDS: material.map(([name, type]) => ({ type, name, base: base(name) })),
    LIGHT_FIELDS: [...new Set(light)].sort().map((name) => ({ type: "float", name })),
  };
  return { lists: { ...lists, ...fields }, defines };
}

/** Version, precision, and the declarations that the code asks for, in a fixed order. */
function prologue(library: Library, expansion: Expansion, used: ReadonlySet<string>): string[] {
  const uniforms = new Map<string, string>();
  const samplers = new Set<string>();
  const casters = (expansion.lists.CASTERS ?? []).map(({ index }) => index);
  for (const path of expansion.files) {
    const meta = library.files[path]!.meta;
    for (const name of meta.reads) {
      const several = perLight(library, name) ? casters : [""];
      for (const index of several) samplers.add(`u_${name}${index}`);
    }
    for (const [name, parameter] of Object.entries(meta.parameters)) {
      const type = GLSL_TYPES[parameter.kind];
      if (type && parameter.per === "frame") uniforms.set(`u_${name}`, type);
    }
  }
  const inUse = (names: Iterable<string>) => [...names].filter((name) => used.has(name)).sort();
  const { defines } = expansion;
  return [
    "#version 300 es",
    "precision highp float;",
    "precision highp int;",
    ...inUse(Object.keys(defines)).map((name) => `#define ${name} ${defines[name]!.toFixed(0)}`),
    ...inUse(uniforms.keys()).map((name) => `uniform ${uniforms.get(name)} ${name};`),
    ...inUse(samplers).map((name) => `uniform highp sampler2D ${name};`),
  ];
}

/** One run over the entry file and all it includes. */
class Expansion {
  readonly lists: Lists;
  readonly defines: Readonly<Record<string, number>>;
  readonly files: string[] = [];
  readonly settings: string[] = [];
  readonly output: Output[] = [];
  private readonly choices: Readonly<Record<string, string>>;

  constructor(
    private readonly library: Library,
    request: Request,
    { lists, defines }: Seen,
  ) {
    this.choices = request.choices;
    this.lists = { ...request.lists, ...lists };
    this.defines = { ...makeDefines(library, request, this.lists), ...defines };
    this.include(request.entry, [], request.entry, 0);
  }

  private include(path: string, chain: readonly string[], file: string, line: number): void {
    if (chain.includes(path)) {
      const cycle = [...chain.slice(chain.indexOf(path)), path].join(" -> ");
      throw problem(file, line, `include cycle: ${cycle}`);
    }
    if (this.files.includes(path)) return;
    if (!Object.hasOwn(this.library.files, path)) {
      throw problem(file, line, `no such file to include: ${path}`);
    }
    this.files.push(path);
    const text = this.library.files[path]!.code.split("\n");
    this.run(
      text.map((line, index): Line => [index + 1, line]),
      [...chain, path],
      false,
    );
  }

  /** Process lines of the file that ends `chain`; inside `#for`, `loop` forbids includes. */
  private run(lines: readonly Line[], chain: readonly string[], loop: boolean): void {
    const file = chain.at(-1)!;
    for (let at = 0; at < lines.length; at += 1) {
      const [number, text] = lines[at]!;
      const match = DIRECTIVE.exec(text);
      const word = match?.[1];
      if (word === undefined || word === "define") {
        this.emit(text, file, number);
      } else if (word === "if" || word === "for") {
        const end = blockEnd(lines, at, word, file);
        const block = lines.slice(at, end + 1);
        if (word === "if") this.run(this.branch(block, file), chain, loop);
        else this.repeat(match![2]!, block, chain);
        at = end;
      } else if (word === "include") {
        this.follow(match![2]!, chain, number, loop);
      } else {
        throw problem(file, number, `#${word} has no place here`);
      }
    }
  }

  private emit(text: string, file: string, number: number): void {
    if (text.includes("@{")) {
      throw problem(file, number, `no list around this line has the key of ${text.trim()}`);
    }
    if (text.trim()) this.output.push([text.trimEnd(), file, number]);
  }

  private follow(target: string, chain: readonly string[], number: number, loop: boolean): void {
    const file = chain.at(-1)!;
    const match = INCLUDE.exec(target);
    if (!match || loop) {
      const allowed = '#include "lib/file.glsl" or #include <setting>, outside of #for';
      throw problem(file, number, `write ${allowed}`);
    }
    const path = match[1] ?? this.chosen(match[2]!, file, number);
    this.include(path, chain, file, number);
  }

  private chosen(setting: string, file: string, number: number): string {
    if (!Object.hasOwn(this.choices, setting)) {
      const known = Object.keys(this.choices).sort().join(", ");
      throw problem(file, number, `no setting <${setting}>; there is: ${known}`);
    }
    if (!this.settings.includes(setting)) this.settings.push(setting);
    return `${folderOf(this.library, setting)}/${this.choices[setting]}.glsl`;
  }

  /** The lines of the first branch of `#if … #endif` whose condition holds. */
  private branch(block: readonly Line[], file: string): readonly Line[] {
    let depth = 0;
    let begin = 0;
    let live = this.holds(block[0]!, file);
    for (const [at, line] of block.entries()) {
      const word = DIRECTIVE.exec(line[1])?.[1] ?? "";
      if (depth === 1 && (word === "elif" || word === "else" || word === "endif")) {
        if (live) return block.slice(begin + 1, at);
        begin = at;
        live = word === "else" || (word === "elif" && this.holds(line, file));
      }
      depth += Number(word === "if") - Number(word === "endif");
    }
    return [];
  }

  private holds([number, text]: Line, file: string): boolean {
    try {
      return Boolean(evaluate(DIRECTIVE.exec(text)?.[2] ?? "", this.defines));
    } catch (error) {
      if (!(error instanceof LightbenchError)) throw error;
      throw problem(file, number, error.message);
    }
  }

  private repeat(name: string, block: readonly Line[], chain: readonly string[]): void {
    if (!Object.hasOwn(this.lists, name)) {
      const known = Object.keys(this.lists).sort().join(", ");
      throw problem(chain.at(-1)!, block[0]![0], `no list ${name}; there is: ${known}`);
    }
    for (const record of this.lists[name]!) {
      const body = block.slice(1, -1).map(([number, text]): Line => [number, bind(text, record)]);
      this.run(body, chain, true);
    }
  }
}

function problem(file: string, number: number, what: string): ShaderError {
  return new ShaderError(`${file}:${number}: ${what}`);
}

function blockEnd(lines: readonly Line[], start: number, opener: string, file: string): number {
  let depth = 0;
  for (let at = start; at < lines.length; at += 1) {
    const word = DIRECTIVE.exec(lines[at]![1])?.[1];
    depth += Number(word === opener) - Number(word === `end${opener}`);
    if (word !== undefined && depth === 0) return at;
  }
  throw problem(file, lines[start]![0], `#${opener} without #end${opener}`);
}

function bind(text: string, record: Record_): string {
  return Object.entries(record).reduce((t, [key, value]) => t.split(`@{${key}}`).join(value), text);
}

/** Every name that `#if` may use: stages, counts, parameters, optional functions. */
function makeDefines(library: Library, request: Request, lists: Lists): Record<string, number> {
  const defines: Record<string, number> = { VERTEX: 0, FRAGMENT: 0, [request.stage]: 1 };
  for (const [name, records] of Object.entries(lists)) {
    defines[`${name.slice(0, -1)}_COUNT`] = records.length;
  }
  for (const [name, value] of Object.entries(request.values)) defines[name.toUpperCase()] = value;
  for (const [name, folder] of Object.entries(library.folders)) {
    const file = library.files[`${name}/${request.choices[folder.setting]}.glsl`]!;
    for (const signature of folder.optional) {
      const called = signature.split("(")[0]!.trim().split(/\s+/).at(-1)!;
      const define = called.replace(/([a-z0-9])(?=[A-Z])/g, "$1_").toUpperCase();
      defines[define] = Number(Object.hasOwn(file.functions, called));
    }
  }
  return defines;
}
