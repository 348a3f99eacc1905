/** One compiled program: compiled without waiting, its uniforms set only where they change. */

import { GraphicsError, ShaderError } from "./errors";
import { explain } from "./shader_log";
import type { Program } from "./types";

interface Uniform {
  readonly type: number;
  readonly location: WebGLUniformLocation;
  last: readonly number[] | null;
}

/** Owns a WebGLProgram; `finish` before anything else. */
export class CompiledProgram {
  /** Locations of the attributes that the compiler kept. */
  readonly attributes = new Map<string, number>();
  private readonly handle: WebGLProgram;
  private readonly shaders: readonly WebGLShader[];
  private readonly uniforms = new Map<string, Uniform>();
  private finished = false;

  /** Starts compiling and linking, and asks nothing: a question would wait for the answer. */
  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly source: Program,
  ) {
    const stages = [
      [gl.VERTEX_SHADER, source.vertex],
      [gl.FRAGMENT_SHADER, source.fragment],
    ] as const;
    this.handle = gl.createProgram();
    this.shaders = stages.flatMap(([stage, text]) => {
      const shader = gl.createShader(stage);
      if (!shader) return []; // only where the context is lost
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.handle, shader);
      return [shader];
    });
    gl.linkProgram(this.handle);
  }

  /** Whether `finish` would return at once; true also where the browser cannot tell. */
  get ready(): boolean {
    const parallel = this.gl.getExtension("KHR_parallel_shader_compile");
    if (this.finished || !parallel || this.gl.isContextLost()) return true;
    return this.gl.getProgramParameter(this.handle, parallel.COMPLETION_STATUS_KHR) as boolean;
  }

  /** Throws ShaderError naming file and line where a source does not compile. */
  finish(): void {
    if (this.finished) return;
    const { gl } = this;
    if (!gl.getProgramParameter(this.handle, gl.LINK_STATUS)) {
      const error = this.failure();
      this.dispose();
      throw error;
    }
    this.reflect();
    this.finished = true;
  }

  private failure(): ShaderError | GraphicsError {
    const { gl, source } = this;
    if (gl.isContextLost()) return new GraphicsError("the browser took the graphics context away");
    const texts = [
      [source.vertex, source.vertex_lines],
      [source.fragment, source.fragment_lines],
    ] as const;
    for (const [index, shader] of this.shaders.entries()) {
      if (gl.getShaderParameter(shader, gl.COMPILE_STATUS)) continue;
      const log = gl.getShaderInfoLog(shader) ?? "";
      return new ShaderError(explain(log.replaceAll("\0", ""), ...texts[index]!));
    }
    const log = (gl.getProgramInfoLog(this.handle) ?? "").replaceAll("\0", "").trim();
    return new ShaderError(log || "the program does not link");
  }

  private reflect(): void {
    const { gl, handle } = this;
    const attributes = gl.getProgramParameter(handle, gl.ACTIVE_ATTRIBUTES) as number;
    for (let index = 0; index < attributes; index += 1) {
      const name = gl.getActiveAttrib(handle, index)?.name ?? "";
      const location = gl.getAttribLocation(handle, name);
      if (location >= 0) this.attributes.set(name, location); // gl_VertexID has none
    }
    const uniforms = gl.getProgramParameter(handle, gl.ACTIVE_UNIFORMS) as number;
    for (let index = 0; index < uniforms; index += 1) {
      const info = gl.getActiveUniform(handle, index);
      const location = info && gl.getUniformLocation(handle, info.name);
      if (location) this.uniforms.set(info.name, { type: info.type, location, last: null });
    }
  }

  use(): void {
    this.gl.useProgram(this.handle);
  }

  /** Set a uniform of the program in use, where the compiler kept it. */
  set(name: string, value: readonly number[]): void {
    const uniform = this.uniforms.get(name);
    if (!uniform || (uniform.last && same(uniform.last, value))) return;
    upload(this.gl, uniform, value);
    uniform.last = value;
  }

  dispose(): void {
    for (const shader of this.shaders) this.gl.deleteShader(shader);
    this.gl.deleteProgram(this.handle);
  }
}

function same(a: readonly number[], b: readonly number[]): boolean {
  return a === b || (a.length === b.length && a.every((value, index) => value === b[index]));
}

function upload(gl: WebGL2RenderingContext, uniform: Uniform, value: readonly number[]): void {
  const { type, location } = uniform;
  if (type === gl.FLOAT) gl.uniform1fv(location, value);
  else if (type === gl.FLOAT_VEC2) gl.uniform2fv(location, value);
  else if (type === gl.FLOAT_VEC3) gl.uniform3fv(location, value);
  else if (type === gl.FLOAT_VEC4) gl.uniform4fv(location, value);
  else if (type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(location, false, value);
  else if (type === gl.FLOAT_MAT4) gl.uniformMatrix4fv(location, false, value);
  else gl.uniform1iv(location, value); // int, bool, sampler
}
