// The page: loads the library and a scene, and ties state, picture and panel together.
import "./style/picture.css";
import "./style/page.css";
import "./style/walk.css";
import "./style/panel.css";
import "./style/dialog.css";
import { App } from "./app";
import { GraphicsError, LightbenchError } from "./core/errors";
import { byId, make } from "./dom";

const ADVICE =
  "Lightbench draws with WebGL2 into float32 pictures (EXT_color_buffer_float). " +
  "Update the browser, turn hardware acceleration on, or open this page on another device.";

/** Sentences in place of the picture, for what no change of a setting can mend. */
function fatal(error: unknown): void {
  const message = error instanceof Error ? error.message : String(error);
  const what = message.endsWith(".") ? message : `${message}.`;
  const advice = error instanceof GraphicsError ? make("p", {}, ADVICE) : null;
  byId("progress").hidden = true;
  byId("frame").replaceChildren(make("div", { class: "fatal" }, make("p", {}, what), advice));
  if (!(error instanceof LightbenchError)) throw error;
}

const app = new App();
app.start().catch((error: unknown) => {
  app.refuse(error);
  fatal(error);
});
