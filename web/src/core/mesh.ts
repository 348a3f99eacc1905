/** Meshes as Python packs them: shapes.py, `pack`. */

import { GraphicsError } from "./errors";

/** Triangles, counter-clockwise seen from outside; the w of a tangent is the bitangent's sign. */
export interface Mesh {
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Float32Array<ArrayBuffer>;
  readonly uvs: Float32Array<ArrayBuffer>;
  readonly tangents: Float32Array<ArrayBuffer>;
  readonly indices: Uint32Array<ArrayBuffer>;
}

export type MeshLoader = (key: string) => Promise<Mesh>;

/**
 * The mesh in a packed file: little-endian uint32 counts of vertices and indices, then positions,
 * normals, uvs and tangents as float32, then the indices as uint32.
 *
 * Throws GraphicsError for a file of another length.
 */
export function unpack(packed: ArrayBuffer): Mesh {
  const counts = packed.byteLength >= 8 ? new Uint32Array(packed, 0, 2) : [0, 0];
  const [vertices, indices] = [counts[0]!, counts[1]!];
  if (packed.byteLength !== 8 + 4 * (12 * vertices + indices)) {
    throw new GraphicsError(`${packed.byteLength} bytes are no mesh of ${vertices} vertices`);
  }
  let at = 8;
  const floats = (components: number): Float32Array<ArrayBuffer> => {
    const array = new Float32Array(packed, at, components * vertices);
    at += array.byteLength;
    return array;
  };
  const [positions, normals, uvs, tangents] = [floats(3), floats(3), floats(2), floats(4)];
  return { positions, normals, uvs, tangents, indices: new Uint32Array(packed, at, indices) };
}

/** A loader of `KEY.bin` files below an address. Rejects with GraphicsError. */
export function meshesFrom(address: string): MeshLoader {
  return async (key) => {
    const response = await fetch(`${address}/${key}.bin`).catch(() => null);
    if (!response?.ok) {
      const status = response ? `status ${response.status}` : "no connection";
      throw new GraphicsError(`the mesh ${key} cannot be loaded (${status})`);
    }
    return unpack(await response.arrayBuffer());
  };
}
