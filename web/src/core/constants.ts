/** Uniforms made constants: what a compiler knows, it folds. Twin of constants.py. */

import { UNIFORM } from "./assemble";
import { type Library, parameters } from "./library";
import type { Settings } from "./settings";
import type { Values } from "./values";

/** The parameter of techniques that makes a choice of it. */
export const CONSTANTS = "constants";

/**
 * A GLSL source with the uniforms that have a value here as constants, line for line: float32 by name,
 * matrices column by column, as uniforms take them.
 */
export function withConstants(source: string, values: Values): string {
  return source.replace(UNIFORM, (line: string, kind: string, name: string) => {
    const value = Object.hasOwn(values, name) ? values[name]! : null;
    if (!value) return line;
    const before = line.slice(0, line.indexOf("uniform"));
    // The shortest decimal that is each number: 2.5e-1.
    const numbers = value.map((one) => one.toExponential());
    return `${before}const ${kind} ${name} = ${kind}(${numbers.join(", ")});`;
  });
}

/** Settings for values that move: a program with constants would be compiled anew for each. */
export function withUniforms(library: Library, settings: Settings): Settings {
  const known = parameters(library).some(([name]) => name === CONSTANTS);
  return known ? { ...settings, [CONSTANTS]: false } : settings;
}
