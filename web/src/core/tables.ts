/** Numbers on the GPU that shaders read by their place. Twin of tables.py. */

import { GraphicsError } from "./errors";
import { same } from "./same";
import type { Plan, PlannedTable } from "./types";

/** What rays read of a mesh: four numbers a texel, as bvh.py bakes them. */
export type HierarchyLoader = (key: string) => Promise<Int32Array<ArrayBuffer>>;

/** Columns of a table of texels, as in shaders/stages/listed.glsl. */
const WIDTH = 1024;
/** Columns of the texture of meshes, as in bvh.py. */
const MESH_WIDTH = 2048;

type Values = Float32Array<ArrayBuffer> | Int32Array<ArrayBuffer>;

interface Rows {
  readonly data: Values;
  readonly width: number;
  readonly height: number;
}

interface Uploaded {
  readonly handle: WebGLTexture;
  readonly content: PlannedTable;
}

/** Owns the tables on the GPU, the last of each name. */
export class Tables {
  private readonly tables = new Map<string, Uploaded>();
  private readonly hierarchies = new Map<string, Int32Array>();
  private readonly loading = new Map<string, Promise<void>>();

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly source: HierarchyLoader,
  ) {}

  /** Whether the meshes of a plan's tables are there. */
  has({ tables }: Plan): boolean {
    return meshesOf(tables).every((key) => this.hierarchies.has(key));
  }

  /** Load the meshes of a plan's tables. Rejects as the loader does; it may be tried again. */
  async load({ tables }: Plan): Promise<void> {
    await Promise.all(meshesOf(tables).map((key) => this.loadOne(key)));
  }

  private loadOne(key: string): Promise<void> {
    if (this.hierarchies.has(key)) return Promise.resolve();
    const known = this.loading.get(key);
    if (known) return known;
    const loading = this.source(key)
      .then((texels) => void this.hierarchies.set(key, texels))
      .finally(() => this.loading.delete(key));
    this.loading.set(key, loading);
    return loading;
  }

  /** Bind a table to a unit. Throws GraphicsError where a mesh of it is not loaded. */
  bind(unit: number, name: string, planned: PlannedTable): void {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindSampler(unit, null); // an image's would filter, and whole numbers read as none then
    const known = this.tables.get(name);
    if (known && same(known.content, planned)) {
      gl.bindTexture(gl.TEXTURE_2D, known.handle);
      return;
    }
    const rows = planned.meshes.length
      ? this.rows(this.joined(planned.meshes), MESH_WIDTH)
      : this.rows(Float32Array.from(planned.texels), WIDTH);
    if (known) gl.deleteTexture(known.handle);
    const handle = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, handle);
    upload(gl, rows);
    this.tables.set(name, { handle, content: planned });
  }

  /** Values row by row, four a texel, the last row filled up. */
  private rows(values: Values, width: number): Rows {
    const texels = values.length / 4;
    const height = Math.ceil(texels / width);
    const limit = this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE) as number;
    if (height > limit) {
      throw new GraphicsError(`${texels} texels are beyond this GL's ${limit * width}`);
    }
    const count = 4 * width * height;
    const data = values instanceof Float32Array ? new Float32Array(count) : new Int32Array(count);
    data.set(values);
    return { data, width, height };
  }

  /** Where each mesh begins, a texel each, and then the meshes. */
  private joined(keys: readonly string[]): Int32Array<ArrayBuffer> {
    const found = keys.map((key) => {
      const texels = this.hierarchies.get(key);
      if (!texels) throw new GraphicsError(`the mesh ${key} is not loaded for rays yet`);
      return texels;
    });
    const numbers = found.reduce((sum, { length }) => sum + length, 4 * keys.length);
    const every = new Int32Array(numbers);
    let begin = 4 * keys.length;
    for (const [index, texels] of found.entries()) {
      every[4 * index] = begin / 4;
      every.set(texels, begin);
      begin += texels.length;
    }
    return every;
  }

  /** Release everything. */
  clear(): void {
    for (const { handle } of this.tables.values()) this.gl.deleteTexture(handle);
    this.tables.clear();
    this.hierarchies.clear();
  }
}

/** Fill the texture that is bound: it is read texel by texel. */
function upload(gl: WebGL2RenderingContext, { data, width, height }: Rows): void {
  const size = [width, height, 0] as const;
  const target = gl.TEXTURE_2D;
  if (data instanceof Float32Array)
    gl.texImage2D(target, 0, gl.RGBA32F, ...size, gl.RGBA, gl.FLOAT, data);
  else gl.texImage2D(target, 0, gl.RGBA32I, ...size, gl.RGBA_INTEGER, gl.INT, data);
  gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
}

function meshesOf(tables: Plan["tables"]): readonly string[] {
  return Object.values(tables).flatMap(({ meshes }) => meshes);
}

/** A loader of `KEY.bin` files below an address. Rejects with GraphicsError. */
export function hierarchiesFrom(address: string): HierarchyLoader {
  return async (key) => {
    const response = await fetch(`${address}/${key}.bin`).catch(() => null);
    if (!response?.ok) {
      const status = response ? `status ${response.status}` : "no connection";
      throw new GraphicsError(`the mesh ${key} cannot be loaded for rays (${status})`);
    }
    const packed = await response.arrayBuffer();
    if (!packed.byteLength || packed.byteLength % 16) {
      throw new GraphicsError(`${packed.byteLength} bytes are no hierarchy of a mesh`);
    }
    return new Int32Array(packed);
  };
}
