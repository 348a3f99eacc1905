/** Lines of an assembled source that do nothing. Twin of prune.py. */

export type Stage = "VERTEX" | "FRAGMENT";
/** A line and where it comes from. */
export type Output = readonly [text: string, file: string, line: number];

const NAME = /[A-Za-z_]\w*/g;
const HANDED_ON = /^\s*(?:out\s+\w+\s+(v_\w+)\s*;|(v_\w+)\s*=[^=].*;)$/;
/** A uniform, an input, a variable in place of one, or a value that is given a name in one line. */
const NAMED =
  /^\s*(?:(?:uniform|in)\s+(?:(?:high|medium|low)p\s+)?\w+\s+(\w+)\s*;|\w+\s+(v_\w+)\s*;|(?:const\s+)?[A-Za-z]\w*\s+(\w+)\s*=[^=][^;]*;)$/;

/**
 * Without varyings that the fragment stage does not take in, and without names that nothing else
 * mentions.
 */
export function live(
  output: readonly Output[],
  stage: Stage,
  varyings: readonly string[],
): readonly Output[] {
  let lines = output.filter(([text]) => stage !== "VERTEX" || !dropped(text, varyings));
  for (;;) {
    const mentions = new Map<string, number>();
    for (const [text] of lines) {
      for (const name of text.match(NAME) ?? []) mentions.set(name, (mentions.get(name) ?? 0) + 1);
    }
    const kept = lines.filter(([text]) => {
      const match = NAMED.exec(text);
      return !match || mentions.get((match[1] ?? match[2] ?? match[3])!) !== 1;
    });
    if (kept.length === lines.length) return lines;
    lines = kept;
  }
}

function dropped(text: string, varyings: readonly string[]): boolean {
  const match = HANDED_ON.exec(text);
  return match !== null && !varyings.includes((match[1] ?? match[2])!);
}
