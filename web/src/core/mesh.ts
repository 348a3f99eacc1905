/** Meshes as Python packs them: mesh.py, `pack`. */

import { GraphicsError } from "./errors";

/**
 * Triangles, counter-clockwise seen from outside; the w of a tangent is the bitangent's sign.
 * Colours (linear RGB and alpha) and a second set of texture coordinates are null where absent.
 */
export interface Mesh {
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Float32Array<ArrayBuffer>;
  readonly uvs: Float32Array<ArrayBuffer>;
  readonly tangents: Float32Array<ArrayBuffer>;
  readonly colors: Float32Array<ArrayBuffer> | null;
  readonly uvs1: Float32Array<ArrayBuffer> | null;
  readonly indices: Uint32Array<ArrayBuffer>;
}

/** Flags in a packed mesh's header. */
const [COLORS, UVS1] = [1, 2];
/** Bytes of the header, and numbers of a vertex without what is flagged. */
const [HEADER, ALWAYS] = [12, 12];

export type MeshLoader = (key: string) => Promise<Mesh>;

/**
 * The mesh in a packed file: little-endian uint32 counts of vertices and indices and flags
 * (1 colours, 2 second texture coordinates), then positions, normals, uvs, tangents and what is
 * flagged as float32, then the indices as uint32.
 *
 * Throws GraphicsError for a file of another length.
 */
export function unpack(packed: ArrayBuffer): Mesh {
  const header = packed.byteLength >= HEADER ? new Uint32Array(packed, 0, 3) : [0, 0, 0];
  const [vertices, indices, flags] = [header[0]!, header[1]!, header[2]!];
  const components = ALWAYS + (flags & COLORS ? 4 : 0) + (flags & UVS1 ? 2 : 0);
  if (packed.byteLength !== HEADER + 4 * (components * vertices + indices)) {
    throw new GraphicsError(`${packed.byteLength} bytes are no mesh of ${vertices} vertices`);
  }
  let at = HEADER;
  const floats = (width: number): Float32Array<ArrayBuffer> => {
    const array = new Float32Array(packed, at, width * vertices);
    at += array.byteLength;
    return array;
  };
  const [positions, normals, uvs, tangents] = [floats(3), floats(3), floats(2), floats(4)];
  const colors = flags & COLORS ? floats(4) : null;
  const uvs1 = flags & UVS1 ? floats(2) : null;
  const triangles = new Uint32Array(packed, at, indices);
  return { positions, normals, uvs, tangents, colors, uvs1, indices: triangles };
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
