/** Images on the GPU: each uploaded once, however many materials share it. Twin of textures.py. */

import { GraphicsError } from "./errors";
import { decoded } from "./half";
import type { Plan, PlannedArray, PlannedTexture } from "./types";

/** An image whose bytes are those of its file: no colour conversion, alpha not multiplied in. */
export type ImageLoader = (key: string) => Promise<ImageBitmap>;

/** Bytes of all images kept between plans. */
const MAX_KEPT_BYTES = 2 ** 29;

/** An image, or images of one size as layers: how either is sampled is the sampler's. */
type Planned = PlannedTexture | PlannedArray;

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

  /** Whether the textures and arrays of a plan are there. */
  has(plan: Plan): boolean {
    return every(plan).every((planned) => this.images.has(keyOf(planned)));
  }

  /** Load and upload the images of a plan. Rejects as the loader does; it may be tried again. */
  async load(plan: Plan): Promise<void> {
    const wanted = new Map(every(plan).map((planned) => [keyOf(planned), planned]));
    this.makeRoom(wanted);
    await Promise.all([...wanted].map(([key, planned]) => this.loadOne(key, planned)));
  }

  private loadOne(key: string, planned: Planned): Promise<void> {
    const known = this.loading.get(key);
    if (known) return known;
    const uploaded = this.images.get(key);
    if (uploaded) {
      this.images.delete(key); // the last that may go
      this.images.set(key, uploaded);
      return Promise.resolve();
    }
    const loading = Promise.all(imagesOf(planned).map((image) => this.source(image)))
      .then((bitmaps) => void this.images.set(key, this.upload(planned, bitmaps)))
      .finally(() => this.loading.delete(key));
    this.loading.set(key, loading);
    return loading;
  }

  /** Row 0 of an image is at v = 0; sRGB texels are decoded before they are filtered. */
  private upload(planned: Planned, bitmaps: readonly ImageBitmap[]): Uploaded {
    const { gl } = this;
    const { width, height } = bitmaps[0]!;
    const limit = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
    if (Math.max(width, height) > limit) {
      const image = imagesOf(planned)[0];
      throw new GraphicsError(`${image}: ${width}x${height} is beyond this GL's ${limit} pixels`);
    }
    const handle = gl.createTexture();
    const target = targetOf(gl, planned);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(target, handle);
    const texel = isArray(planned)
      ? this.fillArray(planned.encoding, bitmaps)
      : this.fill(planned.encoding, bitmaps[0]!);
    gl.generateMipmap(target);
    for (const bitmap of bitmaps) bitmap.close();
    return { handle, bytes: Math.ceil((width * height * bitmaps.length * texel * 4) / 3) };
  }

  /** Fill the texture that is bound; answers the bytes of a texel. */
  private fill(encoding: string, bitmap: ImageBitmap): number {
    const { gl } = this;
    const { width, height } = bitmap;
    const format = encoding === "srgb" ? gl.SRGB8_ALPHA8 : gl.RGBA8;
    gl.texStorage2D(gl.TEXTURE_2D, levelsOf(bitmap), format, width, height);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
    return 4;
  }

  /** Fill the array that is bound: of sRGB texels there is none offline, and these are decoded here. */
  private fillArray(encoding: string, bitmaps: readonly ImageBitmap[]): number {
    const { gl } = this;
    const { width, height } = bitmaps[0]!;
    const [format, type, bytes] =
      encoding === "srgb"
        ? ([gl.RGBA16F, gl.HALF_FLOAT, 8] as const)
        : ([gl.RGBA8, gl.UNSIGNED_BYTE, 4] as const);
    const levels = levelsOf(bitmaps[0]!);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, levels, format, width, height, bitmaps.length);
    for (const [layer, bitmap] of bitmaps.entries()) {
      const codes = codesOf(gl, bitmap);
      const texels = encoding === "srgb" ? decoded(codes) : codes;
      const place = [0, 0, layer, width, height, 1] as const;
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, ...place, gl.RGBA, type, texels);
    }
    return bytes;
  }

  /** Release the images that were used the longest time ago, but none that is `wanted`. */
  private makeRoom(wanted: ReadonlyMap<string, Planned>): void {
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
  bind(unit: number, planned: Planned): void {
    const { gl } = this;
    const uploaded = this.images.get(keyOf(planned));
    if (!uploaded) {
      throw new GraphicsError(`the image ${imagesOf(planned).join(", ")} is not loaded yet`);
    }
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(targetOf(gl, planned), uploaded.handle);
    gl.bindSampler(unit, this.sampler(planned));
  }

  private sampler(planned: Planned): WebGLSampler {
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

function every({ textures, arrays }: Plan): readonly Planned[] {
  return [...Object.values(textures), ...Object.values(arrays)];
}

function isArray(planned: Planned): planned is PlannedArray {
  return "images" in planned;
}

function imagesOf(planned: Planned): readonly string[] {
  return isArray(planned) ? planned.images : [planned.image];
}

function targetOf(gl: WebGL2RenderingContext, planned: Planned): GLenum {
  return isArray(planned) ? gl.TEXTURE_2D_ARRAY : gl.TEXTURE_2D;
}

function keyOf(planned: Planned): string {
  const kind = isArray(planned) ? "array" : "image";
  return [kind, planned.encoding, ...imagesOf(planned)].join(" ");
}

function levelsOf({ width, height }: ImageBitmap): number {
  return Math.floor(Math.log2(Math.max(width, height))) + 1;
}

/** RGBA codes of an image, row 0 first: by way of a texture, which changes none. */
function codesOf(gl: WebGL2RenderingContext, bitmap: ImageBitmap): Uint8Array<ArrayBuffer> {
  const { width, height } = bitmap;
  const [texture, framebuffer] = [gl.createTexture(), gl.createFramebuffer()];
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  const codes = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, codes);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.deleteFramebuffer(framebuffer);
  gl.deleteTexture(texture);
  return codes;
}

/** Trilinear filtering, or the nearest texel of the image itself. */
function makeSampler(
  gl: WebGL2RenderingContext,
  { wrap, filter, anisotropy }: Planned,
): WebGLSampler {
  const sampler = gl.createSampler();
  const nearest = filter === "nearest";
  // A mirrored coordinate comes folded.
  const edge = (side: string | undefined) => (side === "repeat" ? gl.REPEAT : gl.CLAMP_TO_EDGE);
  const small = nearest ? gl.NEAREST : gl.LINEAR_MIPMAP_LINEAR;
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
