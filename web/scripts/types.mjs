// Writes src/core/types.ts from the JSON schema on standard input; with --check, compares instead.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { json } from "node:stream/consumers";
import { compile } from "json-schema-to-typescript";

const path = new URL("../src/core/types.ts", import.meta.url);
const banner = `// Made by \`npm run types\` from server/lightbench/schema.py. Do not edit: run it again instead.`;

const schema = await json(process.stdin);
schema.$defs.Map.title = "TextureMap"; // TypeScript has a Map of its own
const options = { additionalProperties: false, bannerComment: banner };
const raw = await compile(bare(schema), "Contracts", options);
const biome = new URL("../node_modules/.bin/biome", import.meta.url).pathname;
const made = execFileSync(biome, ["format", "--stdin-file-path=src/core/types.ts"], {
  input: raw.replace(/\/\*\*\s*\* @minItems \d+\s*\* @maxItems \d+\s*\*\/\s*/g, ""),
  cwd: new URL("..", import.meta.url),
  encoding: "utf8",
});

/** Without what stands beside a reference (a default, a title): it would make a type of its own. */
function bare(node) {
  if (typeof node !== "object" || node === null) return node;
  if (Array.isArray(node)) return node.map(bare);
  if (typeof node.$ref === "string") return { $ref: node.$ref };
  return Object.fromEntries(Object.entries(node).map(([key, value]) => [key, bare(value)]));
}

if (!process.argv.includes("--check")) writeFileSync(path, made);
else if (readFileSync(path, "utf8") !== made) {
  console.error("web/src/core/types.ts does not match the models: run `npm run types` in web/");
  process.exit(1);
}
