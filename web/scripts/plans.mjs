// Plans every case on standard input, {manifest, scenes, cases: [[scene, settings, size, attachment?],
// ...]}, and prints for each the plan, or the name and message of its error.
import { json } from "node:stream/consumers";
import { fileURLToPath } from "node:url";
import { runnerImport } from "vite";

const root = fileURLToPath(new URL("..", import.meta.url));
const { module } = await runnerImport(`${root}src/core/plan.ts`, { root, configFile: false });
const { manifest, scenes, cases } = await json(process.stdin);

function answer([scene, settings, size, attachment]) {
  try {
    return { plan: module.plan(manifest, scenes[scene], settings, size, attachment) };
  } catch (error) {
    return { error: [error.name, error.message] };
  }
}

process.stdout.write(JSON.stringify(cases.map(answer)));
