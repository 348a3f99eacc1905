// Fits every case on standard input, [[[level, luminance], ...], ...], and prints for each the fit, or
// the name and message of its error.
import { json } from "node:stream/consumers";
import { fileURLToPath } from "node:url";
import { runnerImport } from "vite";

const root = fileURLToPath(new URL("..", import.meta.url));
const { module } = await runnerImport(`${root}src/core/gamma.ts`, { root, configFile: false });

// JSON has no number that is not finite.
const number = (value) => (typeof value === "string" ? Number(value) : value);

function answer(measured) {
  try {
    return { fit: module.fitGamma(measured.map((point) => point.map(number))) };
  } catch (error) {
    return { error: [error.name, error.message] };
  }
}

process.stdout.write(JSON.stringify((await json(process.stdin)).map(answer)));
