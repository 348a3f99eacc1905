/** The framebuffers that passes draw to, kept while they fit the plan. */

import { GraphicsError } from "./errors";
import type { PlannedTarget } from "./types";

/** Bytes of all framebuffers kept between plans. */
const MAX_KEPT_BYTES = 2 ** 29;
/** What a framebuffer counts for at least: its attachments cost something at any size. */
const LEAST_BYTES = 2 ** 22;
/** Bytes of a pixel by format. */
const BYTES: Readonly<Record<string, number>> = { rgba32f: 16, rgba16f: 8, rgba8: 4, r32f: 4 };

export interface Framebuffer {
  readonly handle: WebGLFramebuffer;
  readonly texture: WebGLTexture;
  readonly depth: WebGLRenderbuffer | null;
  readonly bytes: number;
}

/** Owns framebuffers with their textures and depth buffers. */
export class Targets {
  private readonly made = new Map<string, Framebuffer>();
  private readonly limit: number;

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.limit = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
  }

  /** The framebuffers of a plan's targets, and `only` those, or others too as there is room. */
  of(targets: Readonly<Record<string, PlannedTarget>>, only: boolean): Map<string, Framebuffer> {
    const entries = Object.entries(targets);
    const found = new Map(entries.map(([name, target]) => [name, this.get(name, target)]));
    const used = new Set(found.values());
    let held = [...this.made.values()].reduce((sum, { bytes }) => sum + bytes, 0);
    for (const [key, framebuffer] of [...this.made]) {
      if (used.has(framebuffer) || (!only && held <= MAX_KEPT_BYTES)) continue;
      held -= framebuffer.bytes;
      this.release(key);
    }
    return found;
  }

  private get(name: string, target: PlannedTarget): Framebuffer {
    const { size, format, depth } = target;
    const key = `${name} ${size.join("x")} ${format} ${depth}`;
    const framebuffer = this.made.get(key) ?? this.create(name, target);
    this.made.delete(key);
    this.made.set(key, framebuffer);
    return framebuffer;
  }

  private create(name: string, { size, format, depth }: PlannedTarget): Framebuffer {
    const { gl } = this;
    const [width, height] = [size[0]!, size[1]!];
    if (Math.max(width, height) > this.limit) {
      throw new GraphicsError(
        `${name}: ${width}x${height} is beyond this GL's ${this.limit} pixels`,
      );
    }
    const framebuffer: Framebuffer = {
      handle: gl.createFramebuffer(),
      texture: makeTexture(gl, format, width, height),
      depth: depth ? makeDepth(gl, width, height) : null,
      bytes: Math.max(width * height * (BYTES[format]! + (depth ? 4 : 0)), LEAST_BYTES),
    };
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer.handle);
    const [place, kind] = [gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D];
    gl.framebufferTexture2D(gl.FRAMEBUFFER, place, kind, framebuffer.texture, 0);
    if (framebuffer.depth) {
      const buffer = framebuffer.depth;
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, buffer);
    }
    const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
    if (status !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost()) {
      throw new GraphicsError(`${name}: this GL cannot draw to ${format} at ${width}x${height}`);
    }
    return framebuffer;
  }

  private release(key: string): void {
    const framebuffer = this.made.get(key)!;
    this.gl.deleteFramebuffer(framebuffer.handle);
    this.gl.deleteTexture(framebuffer.texture);
    this.gl.deleteRenderbuffer(framebuffer.depth);
    this.made.delete(key);
  }

  /** Release every framebuffer. */
  clear(): void {
    for (const key of [...this.made.keys()]) this.release(key);
  }
}

function makeTexture(
  gl: WebGL2RenderingContext,
  format: string,
  width: number,
  height: number,
): WebGLTexture {
  const formats: Record<string, number> = {
    rgba32f: gl.RGBA32F,
    rgba16f: gl.RGBA16F,
    rgba8: gl.RGBA8,
    r32f: gl.R32F,
  };
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, formats[format]!, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}

function makeDepth(gl: WebGL2RenderingContext, width: number, height: number): WebGLRenderbuffer {
  const buffer = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
  return buffer;
}
