/** Images on the GPU: each uploaded once, however many materials share it. Twin of textures.py. */

import { GraphicsError } from "./errors";
import type { PlannedTexture } from "./types";

/** An image whose bytes are those of its file: no colour conversion, alpha not multiplied in. */
export type ImageLoader = (key: string) => Promise<ImageBitmap>;

/** Bytes of all images kept between plans. */
const MAX_KEPT_BYTES = 2 ** 29;

interface Uploaded {
  readonly handle: WebGLTexture;
  readonly bytes: number;
}

/** Owns the images on the GPU, with their mip levels, and the samplers. */
export class Textures {
  private readonly images = new Map<string, Uploaded>();
  private readonly loading = new Map<string, Promise<void>>();
  private readonly samplers = new Map<string, WebGLSampler>();

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly source: ImageLoader,
  ) {}

  has(planned: PlannedTexture): boolean {
    return this.images.has(keyOf(planned));
  }

  /** Load and upload the images of a plan. Rejects as the loader does; it may be tried again. */
  async load(planned: readonly PlannedTexture[]): Promise<void> {
    const wanted = new Map(planned.map((texture) => [keyOf(texture), texture]));
    this.makeRoom(wanted);
    await Promise.all([...wanted].map(([key, texture]) => this.loadOne(key, texture)));
  }

  private loadOne(key: string, { image, encoding }: PlannedTexture): Promise<void> {
    const known = this.loading.get(key);
    if (known) return known;
    const uploaded = this.images.get(key);
    if (uploaded) {
      this.images.delete(key); // the last that may go
      this.images.set(key, uploaded);
      return Promise.resolve();
    }
    const loading = this.source(image)
      .then((bitmap) => void this.images.set(key, this.upload(image, bitmap, encoding)))
      .finally(() => this.loading.delete(key));
    this.loading.set(key, loading);
    return loading;
  }

  /** Row 0 of the image is at v = 0; sRGB texels are decoded before they are filtered. */
  private upload(key: string, bitmap: ImageBitmap, encoding: string): Uploaded {
    const { gl } = this;
    const { width, height } = bitmap;
    const limit = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
    if (Math.max(width, height) > limit) {
      throw new GraphicsError(`${key}: ${width}x${height} is beyond this GL's ${limit} pixels`);
    }
    const handle = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, handle);
    const format = encoding === "srgb" ? gl.SRGB8_ALPHA8 : gl.RGBA8;
    const levels = Math.floor(Math.log2(Math.max(width, height))) + 1;
    gl.texStorage2D(gl.TEXTURE_2D, levels, format, width, height);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
    gl.generateMipmap(gl.TEXTURE_2D);
    bitmap.close();
    return { handle, bytes: Math.ceil((width * height * 16) / 3) };
  }

  /** Release the images that were used the longest time ago, but none that is `wanted`. */
  private makeRoom(wanted: ReadonlyMap<string, PlannedTexture>): void {
    let held = [...this.images.values()].reduce((sum, { bytes }) => sum + bytes, 0);
    for (const [key, { handle, bytes }] of [...this.images]) {
      if (held <= MAX_KEPT_BYTES) return;
      if (wanted.has(key)) continue;
      this.gl.deleteTexture(handle);
      this.images.delete(key);
      held -= bytes;
    }
  }

  /** Bind a texture and how it is sampled to a unit. Throws GraphicsError where it is not loaded. */
  bind(unit: number, planned: PlannedTexture): void {
    const { gl } = this;
    const uploaded = this.images.get(keyOf(planned));
    if (!uploaded) throw new GraphicsError(`the image ${planned.image} is not loaded yet`);
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, uploaded.handle);
    gl.bindSampler(unit, this.sampler(planned));
  }

  private sampler(planned: PlannedTexture): WebGLSampler {
    const key = [...planned.wrap, planned.filter, planned.anisotropy].join();
    const sampler = this.samplers.get(key) ?? makeSampler(this.gl, planned);
    this.samplers.set(key, sampler);
    return sampler;
  }

  /** Release everything. */
  clear(): void {
    for (const { handle } of this.images.values()) this.gl.deleteTexture(handle);
    for (const sampler of this.samplers.values()) this.gl.deleteSampler(sampler);
    this.images.clear();
    this.samplers.clear();
  }
}

function keyOf({ image, encoding }: PlannedTexture): string {
  return `${image} ${encoding}`;
}

/** Trilinear filtering, or the nearest texel of the nearest level. */
function makeSampler(
  gl: WebGL2RenderingContext,
  { wrap, filter, anisotropy }: PlannedTexture,
): WebGLSampler {
  const sampler = gl.createSampler();
  const nearest = filter === "nearest";
  // A mirrored coordinate comes folded.
  const edge = (side: string | undefined) => (side === "repeat" ? gl.REPEAT : gl.CLAMP_TO_EDGE);
  const small = nearest ? gl.NEAREST_MIPMAP_NEAREST : gl.LINEAR_MIPMAP_LINEAR;
  gl.samplerParameteri(sampler, gl.TEXTURE_MIN_FILTER, small);
  gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, nearest ? gl.NEAREST : gl.LINEAR);
  gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_S, edge(wrap[0]));
  gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_T, edge(wrap[1]));
  const extension = gl.getExtension("EXT_texture_filter_anisotropic");
  if (extension && !nearest) {
    const most = gl.getParameter(extension.MAX_TEXTURE_MAX_ANISOTROPY_EXT) as number;
    const samples = Math.min(anisotropy, most);
    gl.samplerParameterf(sampler, extension.TEXTURE_MAX_ANISOTROPY_EXT, samples);
  }
  return sampler;
}

/** A loader of `KEY.png` files below an address. Rejects with GraphicsError. */
export function imagesFrom(address: string): ImageLoader {
  return async (key) => {
    const response = await fetch(`${address}/${key}.png`).catch(() => null);
    if (!response?.ok) {
      const status = response ? `status ${response.status}` : "no connection";
      throw new GraphicsError(`the image ${key} cannot be loaded (${status})`);
    }
    const options = { colorSpaceConversion: "none", premultiplyAlpha: "none" } as const;
    return createImageBitmap(await response.blob(), options).catch(() => {
      throw new GraphicsError(`the image ${key} cannot be decoded`);
    });
  };
}
