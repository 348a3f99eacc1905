// A model on its way in: files to one body, to the server, to a scene. The latest drop counts.
import { bundle, type Given } from "./bundle";
import { LightbenchError } from "./core/errors";
import type { Scene } from "./core/types";
import { upload } from "./server";

/** What the page is told. */
export interface Hooks {
  /** What is being done; null once nothing is. */
  busy(what: string | null): void;
  opened(file: string, scene: Scene): void;
  refused(reason: string): void;
}

export class Opening {
  private request: AbortController | null = null;

  constructor(private readonly hooks: Hooks) {}

  /** Open the model among these files, in the place of one that is still under way. */
  async take(files: Promise<Given[]>): Promise<void> {
    this.request?.abort();
    const request = new AbortController();
    this.request = request;
    try {
      await this.open(files, request.signal);
    } catch (error) {
      if (request.signal.aborted) return;
      if (!(error instanceof LightbenchError)) throw error;
      this.hooks.refused(error.message);
    } finally {
      if (this.request === request) this.hooks.busy(null);
    }
  }

  private async open(files: Promise<Given[]>, signal: AbortSignal): Promise<void> {
    this.hooks.busy("Reading the files");
    const model = await bundle(await files);
    signal.throwIfAborted();
    this.hooks.busy(`Uploading ${model.name}`);
    const scene = await upload(model, signal);
    signal.throwIfAborted();
    this.hooks.opened(model.name, scene);
  }
}
