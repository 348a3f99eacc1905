/** Meshes on the GPU: loaded once, and of each no more than the programs read. */

import { GraphicsError } from "./errors";
import type { Mesh, MeshLoader } from "./mesh";
import type { CompiledProgram } from "./program";

/** Arrays of a mesh by attribute, with their components. */
const ATTRIBUTES = [
  ["a_position", "positions", 3],
  ["a_normal", "normals", 3],
  ["a_uv0", "uvs", 2],
  ["a_tangent", "tangents", 4],
  ["a_color", "colors", 4],
  ["a_uv1", "uvs1", 2],
] as const;

interface VertexArray {
  readonly handle: WebGLVertexArrayObject;
  readonly indices: number;
}

/** Owns buffers and vertex arrays. */
export class Geometry {
  private readonly meshes = new Map<string, Mesh>();
  private readonly loading = new Map<string, Promise<void>>();
  private readonly buffers = new Map<string, WebGLBuffer>();
  private readonly arrays = new Map<CompiledProgram, Map<string | null, VertexArray>>();

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly source: MeshLoader,
  ) {}

  has(key: string): boolean {
    return this.meshes.has(key);
  }

  /** Rejects as the loader does; a failed load may be tried again. */
  load(key: string): Promise<void> {
    if (this.meshes.has(key)) return Promise.resolve();
    const known = this.loading.get(key);
    if (known) return known;
    const loading = this.source(key)
      .then((mesh) => void this.meshes.set(key, mesh))
      .finally(() => this.loading.delete(key));
    this.loading.set(key, loading);
    return loading;
  }

  /** Draw a mesh with the program in use; null is the triangle that covers the screen. */
  draw(program: CompiledProgram, key: string | null): void {
    const { gl } = this;
    const { handle, indices } = this.array(program, key);
    gl.bindVertexArray(handle);
    if (key === null) gl.drawArrays(gl.TRIANGLES, 0, 3);
    else gl.drawElements(gl.TRIANGLES, indices, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }

  private array(program: CompiledProgram, key: string | null): VertexArray {
    const arrays = this.arrays.get(program) ?? new Map<string | null, VertexArray>();
    this.arrays.set(program, arrays);
    const array = arrays.get(key) ?? this.makeArray(program, key);
    arrays.set(key, array);
    return array;
  }

  private makeArray(program: CompiledProgram, key: string | null): VertexArray {
    const { gl } = this;
    const mesh = key === null ? null : this.meshes.get(key);
    if (mesh === undefined) throw new GraphicsError(`the mesh ${key} is not loaded yet`);
    const handle = gl.createVertexArray();
    if (!mesh) return { handle, indices: 0 };
    gl.bindVertexArray(handle);
    for (const [attribute, field, components] of ATTRIBUTES) {
      const location = program.attributes.get(attribute);
      if (location === undefined) continue;
      const data = mesh[field];
      if (!data) throw new GraphicsError(`the mesh ${key} has no ${field} for ${attribute}`);
      this.bind(gl.ARRAY_BUFFER, `${key} ${field}`, data);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, components, gl.FLOAT, false, 0, 0);
    }
    this.bind(gl.ELEMENT_ARRAY_BUFFER, `${key} indices`, mesh.indices);
    return { handle, indices: mesh.indices.length };
  }

  /** Bind a buffer, uploaded when it is first asked for. */
  private bind(target: GLenum, name: string, data: ArrayBufferView<ArrayBuffer>): void {
    const known = this.buffers.get(name);
    const buffer = known ?? this.gl.createBuffer();
    this.gl.bindBuffer(target, buffer);
    if (known) return;
    this.gl.bufferData(target, data, this.gl.STATIC_DRAW);
    this.buffers.set(name, buffer);
  }

  /** Release what was bound to programs. */
  forgetPrograms(): void {
    for (const arrays of this.arrays.values()) {
      for (const { handle } of arrays.values()) this.gl.deleteVertexArray(handle);
    }
    this.arrays.clear();
  }

  /** Release everything. */
  clear(): void {
    this.forgetPrograms();
    for (const buffer of this.buffers.values()) this.gl.deleteBuffer(buffer);
    this.buffers.clear();
    this.meshes.clear();
  }
}
