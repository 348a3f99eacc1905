/**
 * Several assembled sources made one, as a linker does it: what they share is there once.
 *
 * GLSL ES compiles a stage from one text. Each part is whole by itself; a name that means something
 * else in another part gets the part's number. Twin of link.py.
 */

import { declarations, type Source, UNIFORM } from "./assemble";

type Line = readonly [text: string, where: string];
/** The lines of a declaration, and where each comes from. */
type Block = readonly Line[];
/** The texts of every name, and of each of a function's signatures. */
type Meanings = Map<string, Set<string>>;
type Names = Map<string, string>;

const NAME = /[A-Za-z_]\w*/g;
/** The name that a declaration gives: of a macro, a struct, a function or a variable. */
const GIVEN =
  /^(?:#define (\w+)|struct (\w+)|(?:(?:const|uniform|out|in) )?(?:(?:high|medium|low)p )?\w+ (\w+)\s*[(;=[])/;
const HEAD = /^(?:#version|precision)/;

/**
 * `parts` before `main`; the function `entry` of part i is called `entry`_i there.
 *
 * Uniforms that `variables` names become variables, which `main` sets.
 */
export function link(
  parts: readonly Source[],
  entry: string,
  main: Source,
  variables: ReadonlySet<string>,
): Source {
  const own = declared(main, variables);
  const meanings: Meanings = new Map();
  note(own, meanings);
  const linked = new Map<string, Block>();
  for (const [number, part] of parts.entries()) {
    const blocks = declared(part, variables);
    const names = renames(blocks, meanings, entry, number);
    const made = blocks.map((block) => renamed(block, names));
    add(made, linked);
    note(made, meanings);
  }
  add(own, linked);
  const lines = [...blocksOf(main).filter(isHead), ...linked.values()].flat();
  const text = `${lines.map(([line]) => line).join("\n")}\n`;
  const every = [...parts, main];
  return {
    ...main,
    text,
    lines: lines.map(([, where]) => where),
    files: [...new Set(every.flatMap(({ files }) => files))],
    settings: [...new Set(every.flatMap(({ settings }) => settings))],
    uniforms: declarations(text, UNIFORM),
  };
}

/** New names for what means something else already, and so for all that mentions it. */
function renames(
  blocks: readonly Block[],
  meanings: Meanings,
  entry: string,
  number: number,
): Names {
  const names: Names = new Map([[entry, `${entry}_${number}`]]);
  for (;;) {
    const before = names.size;
    for (const block of blocks) {
      const { name, key } = given(block);
      const known = meanings.get(key);
      if (names.has(name) || !known || known.has(textOf(renamed(block, names)))) continue;
      names.set(name, `${name}_${number}`);
    }
    if (names.size === before) return names;
  }
}

function note(blocks: readonly Block[], meanings: Meanings): void {
  for (const block of blocks) {
    const { key } = given(block);
    meanings.set(key, (meanings.get(key) ?? new Set()).add(textOf(block)));
  }
}

function add(blocks: readonly Block[], linked: Map<string, Block>): void {
  for (const block of blocks) {
    const text = textOf(block);
    if (!linked.has(text)) linked.set(text, block);
  }
}

/** The declarations of a source but its head, some of its uniforms as variables. */
function declared(source: Source, variables: ReadonlySet<string>): readonly Block[] {
  const blocks = blocksOf(source).filter((block) => !isHead(block));
  return blocks.map((block) => withVariables(block, variables));
}

function isHead(block: Block): boolean {
  return HEAD.test(block[0]![0]);
}

/** The declarations of a source: up to the line where no bracket is open and a statement ends. */
function blocksOf({ text, lines }: Source): readonly Block[] {
  const texts = text.split("\n");
  const blocks: Line[][] = [[]];
  let depth = 0;
  for (const [index, where] of lines.entries()) {
    const line = texts[index]!;
    blocks.at(-1)!.push([line, where]);
    depth += (line.match(/[{(]/g)?.length ?? 0) - (line.match(/[})]/g)?.length ?? 0);
    if (depth === 0 && (line.startsWith("#") || /[;}]$/.test(line.trimEnd()))) blocks.push([]);
  }
  return blocks.filter((block) => block.length);
}

function textOf(block: Block): string {
  return block.map(([text]) => text).join("\n");
}

/** The name that a declaration gives; the key of a function also says which types it takes. */
function given(block: Block): { readonly name: string; readonly key: string } {
  const text = block.map(([line]) => line).join(" ");
  const match = GIVEN.exec(text)!;
  const name = (match[1] ?? match[2] ?? match[3])!;
  if (!match[0].endsWith("(")) return { name, key: name };
  const taken = text.slice(match[0].length, text.indexOf(")")).split(",");
  const types = taken.map((argument) => argument.trim().replace(/ ?\S*$/, ""));
  return { name, key: `${name}(${types.join()})` };
}

function renamed(block: Block, names: Names): Block {
  return block.map(([text, where]) => [
    text.replace(NAME, (name) => names.get(name) ?? name),
    where,
  ]);
}

function withVariables(block: Block, variables: ReadonlySet<string>): Block {
  const [text, where] = block[0]!;
  if (!text.startsWith("uniform ") || !variables.has(given(block).name)) return block;
  return [[text.slice("uniform ".length), where]];
}
