// What a thing is as a whole, for a camera that goes to it.
import { vec3 } from "gl-matrix";
import { boundingSphere } from "./core/bounds";
import type { Scene, SceneObject } from "./core/types";
import { matrix } from "./pick";

// A mesh thinner than this share of its size is a surface, not a solid.
const THIN = 0.05;

/** Middle and about the radius of a solid thing, in metres. */
export interface Solid {
  middle: number[];
  size: number;
}

export function middleOf(scene: Scene, object: SceneObject): Solid {
  const asset = scene.meshes[object.mesh ?? ""];
  if (asset) {
    const middle = asset.low.map((low, axis) => (low + asset.high[axis]!) / 2);
    const half = asset.low.map(
      (low, axis) => ((asset.high[axis]! - low) / 2) * object.scale[axis]!,
    );
    const place = vec3.transformMat4(vec3.create(), middle as vec3, matrix(object));
    return { middle: [...place], size: 0.8 * Math.hypot(...half) };
  }
  if (object.shape === "triangle") {
    const [middle, size] = boundingSphere(scene, object);
    return { middle: [...middle], size };
  }
  const height = object.shape === "cone" ? 0.45 * (object.scale[1] ?? 1) : 0;
  const middle = object.position.map((c, axis) => c + (axis === 1 ? height : 0));
  const size = Math.max(...object.scale) * (object.shape === "sphere" ? 1 : 0.6);
  return { middle, size };
}

/** Whether a thing is a surface, or stands around the eye: then a point of it is looked at. */
export function isBroad(scene: Scene, object: SceneObject): boolean {
  if (object.shape !== "mesh") return ["plane", "triangle"].includes(object.shape);
  const { low, high } = scene.meshes[object.mesh!]!;
  const sides = low.map((c, axis) => (high[axis]! - c) * object.scale[axis]!);
  const { middle, size } = middleOf(scene, object);
  const away = Math.hypot(...middle.map((c, axis) => c - scene.camera.eye[axis]!));
  return away < size || Math.min(...sides) < THIN * Math.max(...sides);
}
