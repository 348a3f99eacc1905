/**
 * The numbers of a plan: what a scene gives to uniforms, rounded to float32. Twin of values.py.
 *
 * Positions are relative to the viewpoint, so a scene far from the origin loses nothing. Rounding to
 * float32 here makes the two plans equal where libraries differ in the last bit of float64.
 */

import { boundingSphere, distance } from "./bounds";
import { type Library, parameters } from "./library";
import * as matrix from "./matrix";
import { modelMatrix, normalMatrix } from "./placement";
import type { Light } from "./scene";
import type { Resolved } from "./settings";
import type { Material, Scene, SceneObject, TextureMap } from "./types";
import { type LightMap, primaryRays, type Viewpoint } from "./viewpoint";

export type Values = Readonly<Record<string, number[]>>;
type Fields = Record<string, matrix.Vector>;

const DIELECTRIC_F0 = 0.04;
// Greatest reflectance at normal incidence that is given an index: a perfect mirror has none.
const F0_MAX = 0.999;
const MIN_ALPHA = 1e-3;
const MAX_SHININESS = 1e6;
// Brightest light, that of a scene's limit: a flux through no more than a ray would be infinite.
const MAX_CANDELA = 1e30;

/** Each value rounded to float32, -0 as 0. */
export function float32(values: matrix.Vector): number[] {
  return values.map((value) => Math.fround(value) + 0);
}

function uniforms(fields: Readonly<Fields>): Values {
  const found: Record<string, number[]> = {};
  for (const [name, value] of Object.entries(fields)) found[`u_${name}`] = float32(value);
  return found;
}

/** Uniforms of the menu's parameters. */
export function parameterValues({ values }: Resolved): Values {
  const fields: Fields = {};
  for (const [name, value] of Object.entries(values)) {
    fields[name] = typeof value === "number" ? [value] : value;
  }
  return uniforms(fields);
}

/** Uniforms of the camera and of the target's size. */
export function frameValues(viewpoint: Viewpoint, scene: Scene, size: readonly number[]): Values {
  const { camera, background } = scene;
  const back = matrix.normalize(matrix.subtract(camera.eye, camera.target));
  return uniforms({
    ...{ view_projection: viewpoint.matrix, to_eye: back, resolution: size, background },
    ...primaryRays(camera, size),
  });
}

/** Uniforms of a face of a light's map, while it is drawn. */
export function mapValues(viewpoint: Viewpoint, { far, axis }: LightMap): Values {
  return uniforms({ view_projection: viewpoint.matrix, map_far: [far], map_axis: axis });
}

/** Uniforms of the lights, and of the maps of those that cast shadows. */
export function lightValues(
  { scene, values }: Resolved,
  library: Library,
  maps: ReadonlyMap<number, LightMap>,
  eye: matrix.Triple,
): Values {
  const perLight = parameters(library).filter(
    ([name, parameter]) => parameter.per === "light" && Object.hasOwn(values, name),
  );
  const fields: Fields = { lights_total: total(scene) };
  for (const [index, light] of Object.values(scene.lights).entries()) {
    const own = lightFields(light, eye);
    for (const [name] of perLight) own[name] = [Number(light[name] ?? values[name])];
    const map = maps.get(index);
    if (map) Object.assign(own, mapFields(map, eye));
    for (const [name, value] of Object.entries(own)) fields[`light${index}_${name}`] = value;
  }
  return uniforms(fields);
}

/** What all lights have together, per channel. */
function total({ lights }: Scene): matrix.Vector {
  const parts = Object.values(lights).map(({ color, intensity }) =>
    color.map((c) => c * intensity),
  );
  return parts.reduce((sum, part) => sum.map((s, i) => s + part[i]!), [0, 0, 0]);
}

function mapFields({ far, texel, toClip, origin }: LightMap, eye: matrix.Triple): Fields {
  const fields: Fields = { far: [far], texel: [texel] };
  if (toClip) {
    const moved = matrix.translation(matrix.subtract(eye, origin));
    fields.map = matrix.multiply(toClip, moved);
  }
  return fields;
}

/** Names of the uniforms that each object has its own value of. */
export const DRAW_NAMES: readonly string[] = [
  ...[
    "u_model",
    "u_normal_matrix",
    "u_gap",
    "u_object",
    "u_base_color",
    "u_metalness",
    "u_roughness",
  ],
  ...["u_f0", "u_eta", "u_k", "u_kd", "u_ks", "u_shininess", "u_ambient", "u_dielectric_f0"],
  ...["u_emissive", "u_opacity", "u_alpha_cutoff", "u_normal_scale", "u_occlusion_strength"],
];

const materials = new WeakMap<Material, Values>();

/** Uniforms of a material, made once: the passes of a plan and the next plans share them. */
export function materialValues(material: Material): Values {
  const known = materials.get(material);
  if (known) return known;
  const made = uniforms(materialFields(material));
  materials.set(material, made);
  return made;
}

const normals = new WeakMap<SceneObject, number[]>();

function normalValue(thing: SceneObject): number[] {
  const known = normals.get(thing);
  if (known) return known;
  const made = float32(normalMatrix(thing));
  normals.set(thing, made);
  return made;
}

/** A uniform of DRAW_NAMES but the gap and the number, of one object, its place relative to `origin`. */
export function drawValue(
  scene: Scene,
  thing: SceneObject,
  origin: matrix.Triple,
  name: string,
): number[] {
  if (name === "u_normal_matrix") return normalValue(thing);
  if (name !== "u_model") return materialValues(scene.materials[thing.material]!)[name]!;
  return float32(modelMatrix(thing, origin));
}

/** 3x3, column-major: scale, then rotate, then move (KHR_texture_transform). */
export function textureTransform({ scale, offset, rotation }: TextureMap): number[] {
  const [[x, y], [u, v]] = [scale, offset];
  const [c, s] = matrix.cosSin(rotation);
  return float32([...[c * x, -s * x, 0], ...[s * y, c * y, 0], ...[u, v, 1]]);
}

/** Objects by distance, so that the depth test saves the shading of what is hidden. */
export function frontToBack(scene: Scene, origin: matrix.Triple): readonly SceneObject[] {
  const things = Object.values(scene.objects);
  const far = new Map(things.map((thing) => [thing, distance(scene, thing, origin)]));
  return things.sort((a, b) => far.get(a)! - far.get(b)!);
}

/**
 * The mesh of an object, and how far it may lie inside a finer one of the same surface.
 *
 * A sphere gets the coarsest level whose silhouette is good enough, unless the level is set.
 */
export function meshKey(
  resolved: Resolved,
  library: Library,
  thing: SceneObject,
  viewpoint: Viewpoint,
): readonly [key: string, gap: number] {
  if (thing.mesh !== null) return [resolved.scene.meshes[thing.mesh]!.mesh, 0];
  if (thing.shape === "cone") return [`cone-${thing.stacks}x${thing.sectors}`, 0];
  if (thing.shape !== "sphere") return [thing.shape, 0];
  const set = Number(resolved.values.subdivision);
  if (set >= 0) return [`icosphere-${set.toFixed(0)}`, 0];
  const level = sphereLevel(resolved, library, thing, viewpoint);
  return [`icosphere-${level}`, library.icosphere_errors[level]! * Math.max(...thing.scale)];
}

function sphereLevel(
  { scene, values }: Resolved,
  { icosphere_errors: errors }: Library,
  thing: SceneObject,
  { focal, orthographic, origin }: Viewpoint,
): number {
  const radius = boundingSphere(scene, thing)[1];
  const away = distance(scene, thing, origin);
  if (!orthographic && away <= radius) return errors.length - 1;
  const seen = orthographic ? 1 : Math.sqrt(away * away - radius * radius);
  const pixels = (focal * radius) / seen;
  const allowed = Number(values.sphere_error);
  const good = errors.findIndex((error) => error * pixels <= allowed);
  return good < 0 ? errors.length - 1 : good;
}

function lightFields(light: Light, eye: matrix.Triple): Fields {
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
  const indices = f0.map((f) => indexOf(f, metalness));
  const kd = material.kd ?? base.map((b) => b * (1 - metalness));
  const ks = material.ks ?? f0.map((f) => (f * (shininess + 2)) / 8);
  return {
    base_color: base,
    metalness: [metalness],
    roughness: [material.roughness],
    f0,
    eta: material.eta ?? indices.map(([eta]) => eta),
    k: material.k ?? indices.map(([, k]) => k),
    kd: kd.map((k) => k / Math.PI),
    ks: ks.map((k) => k / Math.PI),
    shininess: [shininess],
    ambient: material.ambient.map((k) => k / Math.PI),
    dielectric_f0: given,
    emissive: material.emissive,
    opacity: [material.opacity],
    alpha_cutoff: [material.alpha_cutoff],
    normal_scale: [material.normal_scale],
    occlusion_strength: [material.occlusion_strength],
  };
}

/**
 * The complex index (eta, k) that reflects `f0` at normal incidence.
 *
 * Gulbrandsen 2014, Artist friendly metallic Fresnel, eqs. 11 and 13, its edge tint being the
 * metalness: a dielectric is clear, k = 0. As shaders/lib/conductor.glsl, which says why in this
 * form.
 */
function indexOf(f0: number, metalness: number): readonly [eta: number, k: number] {
  const r = Math.min(f0, F0_MAX);
  const s = Math.sqrt(r);
  const clear = ((1 + s) * (1 + s)) / (1 - r);
  const eta = clear * (1 - metalness) + ((1 - r) / (1 + r)) * metalness;
  const k = ((2 * s) / (1 + r)) * Math.sqrt(metalness * (1 + (1 - metalness) * clear * clear));
  return [eta, k];
}
