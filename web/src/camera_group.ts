// The camera's fold: what the scene is seen from, and the rows that this camera uses.
import { fieldControls, position } from "./control";
import { extent } from "./extent";
import { AUTO } from "./fields";
import { current, type Group, group, type Situation } from "./groups";
import { niceCeiling } from "./number";
import { seatsOf } from "./views";

/** A light's own view has its place and its angle from the light. */
export function cameraGroup(now: Situation): Group {
  const views = seatsOf(now.preset);
  const light = current(now, "camera.light");
  if (light !== AUTO) {
    const about = "Seen from the light, with all that it reaches in sight. Drag to leave it.";
    return { ...group("camera", "camera", "Camera", about, []), views };
  }
  const farthest = Math.max(...now.preset.camera.eye.map(Math.abs));
  const reach = Math.max(extent(now.preset), niceCeiling(farthest));
  const flat = current(now, "camera.projection") === "orthographic";
  const controls = [
    ...fieldControls(now, "camera.projection"),
    ...(flat ? fieldControls(now, "camera.height") : fieldControls(now, "camera.fov", "°")),
    ...position("camera.eye", "Eye", reach),
    ...position("camera.target", "Target", reach),
  ];
  return { ...group("camera", "camera", "Camera", "", controls), views };
}
