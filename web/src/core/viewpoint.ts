/**
 * What a picture or a light's map is seen from: the camera, or the faces of a light. Twin of
 * viewpoint.py.
 *
 * A light's map is square, of one face for a directional or a spot light, of the six faces of a cube
 * for a point light (and for a spot too wide for one). Nothing of it depends on the camera.
 */

import { boundingSphere, distance, farthest, spanOf } from "./bounds";
import * as matrix from "./matrix";
import type { Light } from "./scene";
import type { Camera, DirectionalLight, Scene, SceneObject, SpotLight } from "./types";

type Triple = matrix.Triple;
type Tile = readonly [x: number, y: number, side: number];

// Nearest depth kept, as a share of the farthest: 24 bits then resolve 6e-5 of the far distance.
const NEAREST = 1e-3;
// Room around what is fitted, so that nothing lies on the border.
const MARGIN = 1.01;
/** Half angle in degrees from which a spot light's map is a cube. */
export const WIDEST_SPOT = 75;
/** Where the faces of a cube look and which way is up on them: +x -x +y -y +z -z. */
const FACES: readonly (readonly [look: Triple, up: Triple])[] = [
  [
    [1, 0, 0],
    [0, 1, 0],
  ],
  [
    [-1, 0, 0],
    [0, 1, 0],
  ],
  [
    [0, 1, 0],
    [0, 0, -1],
  ],
  [
    [0, -1, 0],
    [0, 0, 1],
  ],
  [
    [0, 0, 1],
    [0, 1, 0],
  ],
  [
    [0, 0, -1],
    [0, 1, 0],
  ],
];
const HERE: Triple = [0, 0, 0];

/**
 * `matrix`: from the world about `origin` to clip space. `tile`: x, y and side in pixels. `focal` is
 * in pixels: of a thing's size over its distance, or (orthographic) of a metre.
 */
export interface Viewpoint {
  readonly origin: Triple;
  readonly matrix: matrix.Vector;
  readonly focal: number;
  readonly orthographic: boolean;
  readonly tile: Tile | null;
  readonly look: Triple;
  readonly tangent: number;
}

/**
 * The map of a light: `tiles` across and down, and what its users need to read it.
 *
 * `texel` is the size of one, in metres at 1 m distance (directional: at any). `toClip` takes the
 * world about `origin` to the map's clip space; a cube has none. `axis` is where the map looks.
 */
export interface LightMap {
  readonly tiles: readonly [across: number, down: number];
  readonly origin: Triple;
  readonly far: number;
  readonly texel: number;
  readonly axis: Triple;
  readonly toClip: matrix.Vector | null;
  readonly faces: readonly Viewpoint[];
}

/** The objects that can throw a shadow: a blended one lets light through. */
export function casters(scene: Scene): readonly SceneObject[] {
  return Object.values(scene.objects).filter(
    ({ material }) => scene.materials[material]!.alpha_mode !== "blend",
  );
}

/** World directions about the eye to clip space; depth spans what there is to see. */
export function cameraViewpoint(scene: Scene, size: readonly number[]): Viewpoint {
  const { camera } = scene;
  const [width, height] = [size[0]!, size[1]!];
  const aspect = width / height;
  const spans = Object.values(scene.objects).map(
    (thing) => [distance(scene, thing, camera.eye), boundingSphere(scene, thing)[1]] as const,
  );
  const ends = spans.map(([d, r]) => d + r);
  const far = (ends.length ? Math.max(...ends) : 1) * MARGIN;
  const view = matrix.lookAt(matrix.subtract(camera.target, camera.eye), camera.up);
  const plain = { origin: camera.eye, tile: null, look: HERE, tangent: 0 };
  if (camera.projection === "orthographic") {
    const projection = matrix.orthographic(camera.height, aspect, 0, far);
    const whole = matrix.multiply(projection, view);
    return { ...plain, matrix: whole, focal: height / camera.height, orthographic: true };
  }
  const tangent = tangentOf(camera, aspect);
  const corner = Math.sqrt(1 + tangent * tangent * (1 + aspect * aspect));
  const nearest = spans.length ? Math.min(...spans.map(([d, r]) => d - r)) : 0;
  const near = Math.max((nearest / corner) * 0.99, far * NEAREST);
  const [across = 0, ...rest] = matrix.squarePerspective(tangent, near, far);
  const wide = across / aspect;
  const projection = [camera.mirrored ? -wide : wide, ...rest];
  const whole = matrix.multiply(projection, view);
  return { ...plain, matrix: whole, focal: height / (2 * tangent), orthographic: false };
}

/** Of half the angle that the picture's height takes. */
function tangentOf({ fov, fov_of }: Camera, aspect: number): number {
  const tangent = Math.tan((fov * Math.PI) / 180 / 2);
  return fov_of === "width" ? tangent / aspect : tangent;
}

/** What the rays of a picture are made of: right and up to its border, forward. */
export function primaryRays(
  camera: Camera,
  size: readonly number[],
): Readonly<Record<"ray_right" | "ray_up" | "ray_forward", matrix.Vector>> {
  const aspect = size[0]! / size[1]!;
  const z = matrix.normalize(matrix.subtract(camera.eye, camera.target));
  const x = matrix.normalize(matrix.cross(camera.up, z));
  const y = matrix.cross(z, x);
  const orthographic = camera.projection === "orthographic";
  const half = orthographic ? camera.height / 2 : tangentOf(camera, aspect);
  const across = camera.mirrored ? -half * aspect : half * aspect;
  return {
    ray_right: x.map((c) => c * across),
    ray_up: y.map((c) => c * half),
    ray_forward: z.map((c) => -c),
  };
}

/** The map of a light, each face of it `side` pixels wide. */
export function lightMap(scene: Scene, light: Light, side: number): LightMap {
  if (light.type === "directional") return parallelMap(scene, light, side);
  const { position: origin } = light;
  const far = light.far ?? farthest(scene, casters(scene), origin) * MARGIN;
  if (light.type === "spot" && light.outer <= WIDEST_SPOT) return coneMap(light, far, side);
  const faces = FACES.map(([look, up], index) => {
    const tile: Tile = [(index % 3) * side, Math.floor(index / 3) * side, side];
    return face(origin, look, up, 1, far, tile);
  });
  return { tiles: [3, 2], origin, far, texel: 2 / side, axis: HERE, toClip: null, faces };
}

function face(
  origin: Triple,
  look: Triple,
  up: Triple,
  tangent: number,
  far: number,
  tile: Tile,
): Viewpoint {
  const projection = matrix.squarePerspective(tangent, far * NEAREST, far * MARGIN);
  const whole = matrix.multiply(projection, matrix.lookAt(look, up));
  const focal = tile[2] / (2 * tangent);
  return { origin, matrix: whole, focal, orthographic: false, tile, look, tangent };
}

function anyUp(axis: Triple): Triple {
  return Math.abs(axis[1]) > 0.9 ? [0, 0, 1] : [0, 1, 0];
}

function coneMap(light: SpotLight, far: number, side: number): LightMap {
  const axis = matrix.normalize(light.direction);
  // The cone of light inside a square, with a texel of room.
  const angle = (Math.max(light.outer, 0.1) * Math.PI) / 180;
  const tangent = (Math.tan(angle) * side) / (side - 2);
  const only = face(light.position, axis, anyUp(axis), tangent, far, [0, 0, side]);
  const texel = (2 * tangent) / side;
  const { origin, matrix: toClip } = only;
  return { tiles: [1, 1], origin, far, texel, axis, toClip, faces: [only] };
}

/** A box along a directional light about all that casts shadows. */
interface Frame {
  readonly axis: Triple;
  /** The middle of the near side. */
  readonly origin: Triple;
  readonly width: number;
  readonly depth: number;
}

function parallelFrame(scene: Scene, light: DirectionalLight): Frame {
  const axis = matrix.normalize(light.direction);
  const right = matrix.normalize(matrix.cross(axis, anyUp(axis)));
  const up = matrix.cross(right, axis);
  const things = casters(scene);
  const [x0, x1] = spanOf(scene, things, right);
  const [y0, y1] = spanOf(scene, things, up);
  const [z0, z1] = spanOf(scene, things, axis);
  const width = Math.max(x1 - x0, y1 - y0, 1e-6) * MARGIN;
  const depth = Math.max(z1 - z0, 1e-6);
  const room = depth * (MARGIN - 1);
  const [x, y, z] = [(x0 + x1) / 2, (y0 + y1) / 2, z0 - room];
  const middle = (i: 0 | 1 | 2) => right[i] * x + up[i] * y + axis[i] * z;
  const origin: Triple = [middle(0), middle(1), middle(2)];
  return { axis, origin, width, depth: light.far ?? depth + 2 * room };
}

function parallelMap(scene: Scene, light: DirectionalLight, side: number): LightMap {
  const { axis, origin, width: fitted, depth: far } = parallelFrame(scene, light);
  const width = (fitted * side) / (side - 2);
  const projection = matrix.orthographic(width, 1, 0, far);
  const toClip = matrix.multiply(projection, matrix.lookAt(axis, anyUp(axis)));
  const only: Viewpoint = {
    ...{ origin, matrix: toClip, focal: side / width, orthographic: true },
    ...{ tile: [0, 0, side], look: axis, tangent: 0 },
  };
  return { tiles: [1, 1], origin, far, texel: width / side, axis, toClip, faces: [only] };
}

/** Whether a face of a light's map may show an object. */
export function inSight(scene: Scene, viewpoint: Viewpoint, thing: SceneObject): boolean {
  if (viewpoint.tangent === 0) return true;
  const [center, radius] = boundingSphere(scene, thing);
  const offset = matrix.subtract(center, viewpoint.origin);
  const depth = matrix.dot(offset, viewpoint.look);
  const across = Math.sqrt(Math.max(matrix.dot(offset, offset) - depth * depth, 0));
  // The cone about the square face; its corner is sqrt(2) from the middle.
  const corner = viewpoint.tangent * Math.sqrt(2);
  return across - corner * depth <= radius * Math.sqrt(1 + corner * corner);
}

/**
 * The camera that stands where a light is and has all of its map in sight.
 *
 * A point light has no one direction: it looks at what the scene's camera looks at.
 */
export function lightCamera(scene: Scene, light: Light): Camera {
  if (light.type === "directional") {
    const { axis, origin, width } = parallelFrame(scene, light);
    return { ...toward(origin, axis, 45), projection: "orthographic", height: width };
  }
  if (light.type === "spot") {
    const fov = Math.min(Math.max(2 * light.outer, 1), 170);
    return toward(light.position, matrix.normalize(light.direction), fov);
  }
  const look = matrix.subtract(scene.camera.target, light.position);
  const at: Triple = matrix.dot(look, look) === 0 ? [0, -1, 0] : look;
  return toward(light.position, matrix.normalize(at), 90);
}

function toward(eye: Triple, axis: Triple, fov: number): Camera {
  const up = anyUp(axis);
  return {
    ...{ eye: [...eye], target: [eye[0] + axis[0], eye[1] + axis[1], eye[2] + axis[2]] },
    ...{ up: [...up], fov, fov_of: "height", mirrored: false },
    ...{ projection: "perspective", height: 5, light: null },
  };
}
