/** The one exception tree: every error a caller can cause says what was wrong and what is allowed. */

/** Anything that Lightbench refuses; the message is one sentence for a person. */
export class LightbenchError extends Error {
  override name = "LightbenchError";
}

/** A shader file that cannot be used; the message begins with `file:line`. */
export class ShaderError extends LightbenchError {
  override name = "ShaderError";
}

/** A scene that cannot be used; the message names the offending field. */
export class SceneError extends LightbenchError {
  override name = "SceneError";
}

/** A setting with an unknown name or a value outside what is allowed. */
export class SettingError extends LightbenchError {
  override name = "SettingError";
}

/** No WebGL2 context, or one that cannot do what a plan asks for. */
export class GraphicsError extends LightbenchError {
  override name = "GraphicsError";
}

/** `value` as a message shows it: the notation of Python's `shown`. */
export function shown(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(shown).join(", ")}]`;
  if (typeof value === "string") return quoted(value);
  if (typeof value === "number") return decimal(value);
  if (typeof value === "boolean") return value ? "True" : "False";
  return value === null || value === undefined ? "None" : JSON.stringify(value);
}

function quoted(text: string): string {
  const quote = text.includes("'") && !text.includes('"') ? '"' : "'";
  const escaped = text
    .replaceAll("\\", "\\\\")
    .replaceAll("\n", "\\n")
    .replaceAll("\r", "\\r")
    .replaceAll("\t", "\\t");
  return quote + (quote === "'" ? escaped.replaceAll("'", "\\'") : escaped) + quote;
}

/** The shortest decimal that reads back as `value`, with Python's rules for an exponent. */
function decimal(value: number): string {
  if (!Number.isFinite(value)) return special(value);
  const size = Math.abs(value);
  return size >= 1e16 || (size > 0 && size < 1e-4) ? padded(value.toExponential()) : `${value}`;
}

/** `value` with six significant digits, as Python's format `g`. */
export function general(value: number): string {
  if (!Number.isFinite(value)) return special(value);
  const rounded = Number(value.toPrecision(6));
  const size = Math.abs(rounded);
  return size >= 1e6 || (size > 0 && size < 1e-4) ? padded(rounded.toExponential()) : `${rounded}`;
}

function special(value: number): string {
  if (Number.isNaN(value)) return "nan";
  return value > 0 ? "inf" : "-inf";
}

function padded(text: string): string {
  return text.replace(/e([+-])(\d)$/, "e$10$2");
}
