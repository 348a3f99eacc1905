/**
 * The numbers of a plan: what a scene gives to uniforms, rounded to float32. Twin of values.py.
 *
 * Positions are relative to the eye, so a scene far from the origin loses nothing. Rounding to
 * float32 here makes the two plans equal where libraries differ in the last bit of float64.
 */

import { type Library, parameters } from "./library";
import * as matrix from "./matrix";
import type { Light } from "./scene";
import type { Resolved } from "./settings";
import type { Camera, Material, Scene, SceneObject } from "./types";

export type Values = Record<string, number[]>;
type Size = readonly number[];
type Fields = Record<string, matrix.Vector>;

/** Radius of each shape about its own origin. */
const BOUND = { plane: Math.sqrt(0.5), cube: Math.sqrt(0.75), sphere: 1, cone: 1 };
// Nearest depth kept, as a share of the farthest: 24 bits then resolve 6e-5 of the far distance.
const NEAREST = 1e-3;
const DIELECTRIC_F0 = 0.04;
const MIN_ALPHA = 1e-3;
const MAX_SHININESS = 1e6;
// Brightest light, that of a scene's limit: a flux through no more than a ray would be infinite.
const MAX_CANDELA = 1e30;

/** Each value rounded to float32, -0 as 0. */
export function float32(values: matrix.Vector): number[] {
  return values.map((value) => Math.fround(value) + 0);
}

/** Uniforms that all draws of a pass share: camera, lights, parameters. */
export function frameValues(resolved: Resolved, library: Library, size: Size): Values {
  const { scene, values } = resolved;
  const found: Values = { u_view_projection: float32(viewProjection(scene, size)) };
  for (const [name, value] of Object.entries(values)) {
    found[`u_${name}`] = float32(typeof value === "number" ? [value] : value);
  }
  const perLight = parameters(library).filter(
    ([name, parameter]) => parameter.per === "light" && Object.hasOwn(values, name),
  );
  for (const [index, light] of Object.values(scene.lights).entries()) {
    const own = lightFields(light, scene.camera.eye);
    for (const [name] of perLight) own[name] = [Number(light[name] ?? values[name])];
    for (const [name, value] of Object.entries(own)) {
      found[`u_light${index}_${name}`] = float32(value);
    }
  }
  return found;
}

/** Names of the uniforms that each object has its own value of. */
export const DRAW_NAMES: readonly string[] = [
  ...["u_model", "u_normal_matrix", "u_base_color", "u_metalness", "u_roughness"],
  ...["u_f0", "u_kd", "u_ks", "u_shininess"],
];

/** Uniforms of one object. */
export function drawValues(scene: Scene, thing: SceneObject): Values {
  const position = matrix.subtract(thing.position, scene.camera.eye);
  const own: Fields = {
    model: matrix.compose(position, thing.rotation, thing.scale),
    normal_matrix: matrix.normalMatrix(thing.rotation, thing.scale),
    ...materialFields(scene.materials[thing.material]!),
  };
  return Object.fromEntries(
    Object.entries(own).map(([name, value]) => [`u_${name}`, float32(value)]),
  );
}

/** Objects by distance, so that the depth test saves the shading of what is hidden. */
export function frontToBack(scene: Scene): readonly SceneObject[] {
  const things = Object.values(scene.objects);
  const far = new Map(things.map((thing) => [thing, distanceTo(thing, scene.camera)]));
  return things.sort((a, b) => far.get(a)! - far.get(b)!);
}

/** The mesh of an object; a sphere gets the coarsest level whose silhouette is good enough. */
export function meshKey(
  resolved: Resolved,
  library: Library,
  thing: SceneObject,
  size: Size,
): string {
  if (thing.shape === "cone") return `cone-${thing.stacks}x${thing.sectors}`;
  if (thing.shape !== "sphere") return thing.shape;
  let level = Number(resolved.values.subdivision);
  if (level < 0) level = sphereLevel(resolved, library, thing, size);
  return `icosphere-${level.toFixed(0)}`;
}

function sphereLevel(resolved: Resolved, library: Library, thing: SceneObject, size: Size): number {
  const { camera } = resolved.scene;
  const errors = library.icosphere_errors;
  const radius = boundOf(thing);
  const distance = distanceTo(thing, camera);
  if (distance <= radius) return errors.length - 1;
  const focal = size[1]! / (2 * Math.tan((camera.fov * Math.PI) / 180 / 2));
  const pixels = (focal * radius) / Math.sqrt(distance * distance - radius * radius);
  const allowed = Number(resolved.values.sphere_error);
  const good = errors.findIndex((error) => error * pixels <= allowed);
  return good < 0 ? errors.length - 1 : good;
}

function boundOf(thing: SceneObject): number {
  return BOUND[thing.shape] * Math.max(...thing.scale);
}

function distanceTo(thing: SceneObject, camera: Camera): number {
  const offset = matrix.subtract(thing.position, camera.eye);
  return Math.sqrt(matrix.dot(offset, offset));
}

/** World directions about the eye to clip space; depth spans what there is to see. */
function viewProjection(scene: Scene, size: Size): matrix.Vector {
  const { camera } = scene;
  const aspect = size[0]! / size[1]!;
  const spans = Object.values(scene.objects).map(
    (thing) => [distanceTo(thing, camera), boundOf(thing)] as const,
  );
  const far = (spans.length ? Math.max(...spans.map(([d, r]) => d + r)) : 1) * 1.01;
  const tangent = Math.tan((camera.fov * Math.PI) / 180 / 2);
  const corner = Math.sqrt(1 + tangent * tangent * (1 + aspect * aspect));
  const nearest = spans.length ? Math.min(...spans.map(([d, r]) => d - r)) : 0;
  const near = Math.max((nearest / corner) * 0.99, far * NEAREST);
  const view = matrix.lookAt(matrix.subtract(camera.target, camera.eye), camera.up);
  return matrix.multiply(matrix.perspective(camera.fov, aspect, near, far), view);
}

function lightFields(light: Light, eye: matrix.Vector): Fields {
  if (light.type === "directional") {
    const toLight = matrix.normalize(light.direction).map((c) => -c);
    return { intensity: light.color.map((c) => c * light.intensity), direction: toLight };
  }
  const fields: Fields = { position: matrix.subtract(light.position, eye) };
  let solidAngle = 4 * Math.PI;
  if (light.type === "spot") {
    const inner = Math.cos((light.inner * Math.PI) / 180);
    const outer = Math.cos((light.outer * Math.PI) / 180);
    // The square of a ramp from outer to inner integrates to a third of their difference.
    const full = versine(light.inner);
    const edge = versine(light.outer);
    solidAngle = 2 * Math.PI * (full + (edge - full) / 3);
    fields.axis = matrix.normalize(light.direction);
    fields.cos_inner = [inner];
    fields.cos_outer = [outer];
  }
  let candela = light.intensity;
  if (light.unit === "lumen") {
    candela = solidAngle > 0 ? Math.min(candela / solidAngle, MAX_CANDELA) : 0;
  }
  fields.intensity = light.color.map((c) => c * candela);
  return fields;
}

/** 1 - cos without the digits that this loses for a narrow cone. */
function versine(degrees: number): number {
  const sine = Math.sin((degrees * Math.PI) / 180 / 2);
  return 2 * sine * sine;
}

/**
 * GLSL's material fields; classic ones follow from the physical ones unless given.
 *
 * kd and ks are reflectances in a scene and 1/sr in a shader, hence the division by pi. The derived
 * lobe has the exponent of the Blinn-Phong distribution of the same width and its height for a far
 * viewer (Real-Time Rendering, 4th ed., sec. 9.8.1): f0 (s + 2) / (8 pi).
 */
function materialFields(material: Material): Fields {
  const { base_color: base, metalness, ior } = material;
  const plain = ior === null ? DIELECTRIC_F0 : ((ior - 1) / (ior + 1)) * ((ior - 1) / (ior + 1));
  const given = material.f0 ?? [plain, plain, plain];
  const f0 = given.map((g, i) => g * (1 - metalness) + base[i]! * metalness);
  const alpha = Math.max(material.roughness * material.roughness, MIN_ALPHA);
  const shininess = material.shininess ?? Math.min(2 / (alpha * alpha) - 2, MAX_SHININESS);
  const kd = material.kd ?? base.map((b) => b * (1 - metalness));
  const ks = material.ks ?? f0.map((f) => (f * (shininess + 2)) / 8);
  return {
    base_color: base,
    metalness: [metalness],
    roughness: [material.roughness],
    f0,
    kd: kd.map((k) => k / Math.PI),
    ks: ks.map((k) => k / Math.PI),
    shininess: [shininess],
  };
}
