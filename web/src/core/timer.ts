/** How long drawing takes, by the best clock that the browser offers. */

export interface Timing {
  readonly milliseconds: number;
  readonly source: "GPU timer" | "wall clock";
}

/** EXT_disjoint_timer_query_webgl2, which TypeScript's library does not describe. */
interface TimerQueries {
  readonly TIME_ELAPSED_EXT: GLenum;
  readonly GPU_DISJOINT_EXT: GLenum;
}

const POLL_MILLISECONDS = 2;

/**
 * The time of `draw`, completion included. Null where the GPU was disturbed (it changed its clock, or
 * was lost): measure again.
 */
export function measure(gl: WebGL2RenderingContext, draw: () => void): Promise<Timing | null> {
  const queries = gl.getExtension("EXT_disjoint_timer_query_webgl2") as TimerQueries | null;
  return queries ? byQuery(gl, queries, draw) : Promise.resolve(byClock(gl, draw));
}

async function byQuery(
  gl: WebGL2RenderingContext,
  queries: TimerQueries,
  draw: () => void,
): Promise<Timing | null> {
  const query = gl.createQuery();
  gl.getParameter(queries.GPU_DISJOINT_EXT); // forgets what happened before
  gl.beginQuery(queries.TIME_ELAPSED_EXT, query);
  try {
    draw();
  } finally {
    gl.endQuery(queries.TIME_ELAPSED_EXT);
  }
  gl.flush();
  while (!gl.isContextLost() && !gl.getQueryParameter(query, gl.QUERY_RESULT_AVAILABLE)) {
    await new Promise((resolve) => setTimeout(resolve, POLL_MILLISECONDS));
  }
  const spoiled = gl.isContextLost() || gl.getParameter(queries.GPU_DISJOINT_EXT);
  const nanoseconds = Number(gl.getQueryParameter(query, gl.QUERY_RESULT));
  gl.deleteQuery(query);
  return spoiled ? null : { milliseconds: nanoseconds / 1e6, source: "GPU timer" };
}

function byClock(gl: WebGL2RenderingContext, draw: () => void): Timing | null {
  complete(gl);
  const start = performance.now();
  draw();
  complete(gl);
  if (gl.isContextLost()) return null;
  return { milliseconds: performance.now() - start, source: "wall clock" };
}

/** Reading one pixel waits for all that was asked to be drawn to it. */
function complete(gl: WebGL2RenderingContext): void {
  gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
}
