// How large a scene is: the reach of sliders and the pace of a walk.
import type { Scene, SceneObject } from "./core/types";
import { niceCeiling } from "./number";

// More of a plane than this is only ground.
const LARGEST = 12;

interface Box {
  low: readonly number[];
  high: readonly number[];
}

/** Whether a camera has anything to look at: a scene's parts lie flat on the picture. */
export function isSolid({ objects }: Pick<Scene, "objects">): boolean {
  return Object.keys(objects).length > 0;
}

/** Half the size of what there is to light, and some room around it, in metres. */
export function extent(scene: Scene & { meshes?: Record<string, Box> }): number {
  const far = Object.values(scene.objects).flatMap(
    (thing: SceneObject & { mesh?: string | null }) => {
      const box = scene.meshes?.[thing.mesh ?? ""];
      const radius = box ? reach(box, thing.scale) : cornersReach(thing);
      return thing.position.map(
        (c, axis) => Math.abs(c) + (radius ?? Math.min(thing.scale[axis] ?? 1, LARGEST) / 2),
      );
    },
  );
  const lights = Object.values(scene.lights).flatMap((light) =>
    light.type === "directional" ? [] : light.position.map(Math.abs),
  );
  return niceCeiling(Math.max(1, ...far, ...lights));
}

/** Farthest that a triangle's corner comes from its origin; null for another shape. */
function cornersReach({ corners, scale }: SceneObject): number | null {
  const away = corners?.map((corner) => Math.hypot(...corner.map((c, axis) => c * scale[axis]!)));
  return away ? Math.max(...away) : null;
}

/** Farthest that a scaled box comes from its origin, however it is turned. */
function reach({ low, high }: Box, scale: readonly number[]): number {
  const farthest = low.map((c, axis) => Math.max(Math.abs(c), Math.abs(high[axis] ?? 0)));
  return Math.hypot(...farthest.map((c, axis) => c * (scale[axis] ?? 1)));
}
