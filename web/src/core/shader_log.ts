/** Compile logs in terms of the files in `shaders/`. Twin of shader_log.py. */

const ERROR = /(?:ERROR:\s*)?\b0[:(](\d+)\)?(?:\(\d+\))?\s*:\s*(.*)/;

/**
 * A GL compile log with every position turned into `file:line` and its excerpt.
 *
 * `lines[i]` says where line i of the specialised `text` comes from, as `file:line`.
 */
export function explain(log: string, text: string, lines: readonly string[]): string {
  const code = text.split("\n");
  const found = log.split(/\r\n|\r|\n/).flatMap((raw) => {
    const match = ERROR.exec(raw);
    const at = Number(match?.[1] ?? 0) - 1;
    if (!match || at < 0 || at >= lines.length) return [];
    return [`${lines[at]}: ${match[2]!.trim()}\n    ${code[at]!.trim()}`];
  });
  return found.join("\n") || log.trim();
}
