// The page: loads the library and a scene, and ties state, picture and panel together.
import "./style/page.css";
import "./style/panel.css";
import "./style/dialog.css";
import { App } from "./app";
import { GraphicsError, LightbenchError } from "./core/errors";
import { byId, make } from "./dom";

/** One sentence in place of everything, for what no reload of a setting can mend. */
function fatal(error: unknown): void {
  if (!(error instanceof LightbenchError)) throw error;
  const advice =
    error instanceof GraphicsError
      ? "Lightbench draws with WebGL2 into float32 pictures (EXT_color_buffer_float). Update the browser, turn hardware acceleration on, or open this page on another device."
      : null;
  byId("progress").hidden = true;
  byId("frame").replaceChildren(
    make(
      "div",
      { class: "fatal" },
      make("p", {}, `${error.message}.`.replace("..", ".")),
      advice && make("p", {}, advice),
    ),
  );
}

const app = new App();
app.start().catch(fatal);
