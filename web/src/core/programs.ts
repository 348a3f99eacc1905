/** The programs of plans, compiled once for as long as there is room. */

import { CompiledProgram } from "./program";
import type { Program } from "./types";

const MAX_PROGRAMS = 256;

/** Owns compiled programs; `forget` is called before all of them go. */
export class Programs {
  private readonly bySource = new Map<string, CompiledProgram>();
  /** A planner hands out the same objects again: a short way to what their sources lead to. */
  private known = new WeakMap<Program, CompiledProgram>();

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly forget: () => void,
  ) {}

  /** The program, compiling. */
  get(source: Program): CompiledProgram {
    const known = this.known.get(source);
    if (known) return known;
    const key = keyOf(source);
    const program = this.bySource.get(key) ?? this.compile(key, source);
    this.known.set(source, program);
    return program;
  }

  private compile(key: string, source: Program): CompiledProgram {
    if (this.bySource.size >= MAX_PROGRAMS) this.clear();
    const program = new CompiledProgram(this.gl, source);
    this.bySource.set(key, program);
    return program;
  }

  /** Whether `finished` would answer at once. */
  ready(source: Program): boolean {
    const program = this.known.get(source) ?? this.bySource.get(keyOf(source));
    return program?.ready ?? false;
  }

  /** The program, compiled. Throws ShaderError naming file and line. */
  finished(source: Program): CompiledProgram {
    const program = this.get(source);
    try {
      program.finish();
    } catch (error) {
      this.known.delete(source);
      this.bySource.delete(keyOf(source));
      throw error;
    }
    return program;
  }

  /** Release every program. */
  clear(): void {
    this.forget();
    for (const program of this.bySource.values()) program.dispose();
    this.bySource.clear();
    this.known = new WeakMap();
  }
}

function keyOf(program: Program): string {
  return `${program.vertex}\0${program.fragment}`;
}
