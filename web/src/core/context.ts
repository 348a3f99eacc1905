/** WebGL2 contexts: how one is made, what it lacks, what is behind it. */

import { GraphicsError } from "./errors";
import type { Plan } from "./types";

/** A context of the canvas as the renderer needs it. Throws GraphicsError where there is none. */
export function createContext(canvas: HTMLCanvasElement | OffscreenCanvas): WebGL2RenderingContext {
  const options: WebGLContextAttributes = {
    alpha: false,
    antialias: false,
    depth: false,
    powerPreference: "high-performance",
  };
  const gl = canvas.getContext("webgl2", options) as WebGL2RenderingContext | null;
  if (!gl) throw new GraphicsError("WebGL2 is missing: this browser has none, or it is turned off");
  return gl;
}

/** What this context cannot do that every plan needs; null where nothing is missing. */
export function missing(gl: WebGL2RenderingContext): string | null {
  if (gl.isContextLost()) return "the browser took the graphics context away";
  if (gl.getExtension("EXT_color_buffer_float")) return null;
  return "EXT_color_buffer_float is missing: this device cannot draw to float32 pictures";
}

/** What this context cannot do that this plan needs; null where nothing is missing. */
export function missingFor(gl: WebGL2RenderingContext, plan: Plan): string | null {
  const blends = plan.passes.some(
    ({ target, batches }) =>
      plan.targets[target]!.format.endsWith("32f") && batches.some((batch) => batch.blend !== null),
  );
  if (!blends || gl.getExtension("EXT_float_blend")) return null;
  return "EXT_float_blend is missing: this device cannot blend into float32 pictures";
}

/** The name of the GL behind a context. */
export function rendererName(gl: WebGL2RenderingContext): string {
  const unmasked = gl.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL;
  return String(gl.getParameter(unmasked ?? gl.RENDERER));
}
