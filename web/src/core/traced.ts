/**
 * What rays need to know of a scene: each object's equation, its kind of surface and its values. Twin
 * of traced.py.
 */

import type { Lists, Record_, Source } from "./assemble";
import { boundingSphere } from "./bounds";
import * as matrix from "./matrix";
import { cornersOf, inverseMatrix } from "./placement";
import { ROOM, sphereTree } from "./sphere_tree";
import { type Pattern, type Surface, unsided } from "./surface";
import type { Material, Scene, SceneObject } from "./types";
import { DRAW_NAMES, float32, materialValues, textureTransform, type Values } from "./values";

type Surfaces = ReadonlyMap<SceneObject, Surface>;
type Numbers = Readonly<Record<string, number>>;

/** The file that says what a kind of surface sends to the eye, and the one that asks it. */
export const SURFACE = "stages/surface.glsl";
export const TRACING = "stages/shaded.glsl";
const DEFAULT_IOR = 1.5;
/** Texels of an object before its own values. */
const FIRST_VALUE = 5;
/** Layers that WebGL2 promises for an array. */
const MOST_LAYERS = 256;
/** What functions and constants of shapes are called. A ball is a sphere of one scale. */
const SHAPES = ["ball", "triangle", "plane", "cube", "cone", "round", "mesh"];
/**
 * Objects from which on rays ask a list. Fewer are faster by name (of balls under a lamp up to 16 or
 * 20), but each takes up to 14 of the 224 uniforms that WebGL2 promises to a shader.
 */
const LONG = 16;
/** What a ray may find where it meets an object. */
const FOUND = ["position", "normal", "to_eye", "front", "tangent", "uv0", "uv1", "color"];
const TEXTURE = /^u_texture\d+(?:_transform)?$/;

/** The kinds of surface that there are. */
export function patternsOf(scene: Scene, surfaces: Surfaces): readonly Pattern[] {
  const every = Object.values(scene.objects).map((thing) => unsided(surfaces.get(thing)!.pattern));
  return [...new Map(every.map((pattern) => [pattern.key, pattern])).values()];
}

function materialOf(scene: Scene, thing: SceneObject): Material {
  return scene.materials[thing.material]!;
}

/** What functions and constants of an object's shape are called. */
function shapeOf({ shape, scale }: SceneObject): string {
  if (shape !== "sphere") return shape;
  return scale[0] === scale[1] && scale[1] === scale[2] ? "ball" : "round";
}

/**
 * The number of each object's kind of surface. Whether both sides are seen is the object's affair: it
 * makes no kind of its own.
 */
function kindsOf(scene: Scene, surfaces: Surfaces): readonly number[] {
  const keys = patternsOf(scene, surfaces).map(({ key }) => key);
  const things = Object.values(scene.objects);
  return things.map((thing) => keys.indexOf(unsided(surfaces.get(thing)!.pattern).key));
}

/** The records of OBJECTS: how each is met, and the number of its kind of surface. */
export function objectRecords(scene: Scene, surfaces: Surfaces): readonly Record_[] {
  const kinds = kindsOf(scene, surfaces);
  return Object.values(scene.objects).map((thing, index) => {
    const material = materialOf(scene, thing);
    const shape = shapeOf(thing);
    const truth = (holds: boolean) => `${Number(holds)}`;
    return {
      index: `${index}`,
      shape: shape === "ball" ? "round" : shape,
      kind: `${kinds[index]}`,
      ball: truth(shape === "ball"),
      triangle: truth(shape === "triangle"),
      placed: truth(shape !== "ball" && shape !== "triangle"),
      plane: truth(shape === "plane"),
      double: truth(material.double_sided),
      open: truth(hasTwoSides(material)),
      solid: truth(material.alpha_mode !== "blend"),
      transmits: truth(material.transmittance > 0),
    };
  });
}

/** Whether rays meet its back, too: that of glass they do on their way out. */
function hasTwoSides({ double_sided, transmittance }: Material): boolean {
  return double_sided || transmittance > 0;
}

/** Whether rays find objects in a texture, by number, rather than by name. */
function isListed(things: readonly SceneObject[]): boolean {
  return things.length >= LONG || things.some(({ mesh }) => mesh !== null);
}

/** Which kinds of object there are; whether rays are sent on, up to `bounces` times, and how. */
export function sceneDefines(scene: Scene, bounces: number): Numbers {
  const things = Object.values(scene.objects);
  const used = things.map((thing) => materialOf(scene, thing));
  const shapes = new Set(things.map(shapeOf));
  const blended = used.some(({ alpha_mode }) => alpha_mode !== "opaque");
  const transmits = used.some(({ transmittance }) => transmittance > 0);
  const refracts = transmits && bounces > 0;
  return {
    ...Object.fromEntries(SHAPES.map((shape) => [`any_${shape}`, Number(shapes.has(shape))])),
    any_placed: Number(["plane", "cube", "cone", "round"].some((shape) => shapes.has(shape))),
    listed: Number(isListed(things)),
    any_double: Number(used.some(({ double_sided }) => double_sided)),
    reflects: Number(bounces > 0 && used.some(({ reflectance }) => reflectance > 0)),
    transmits: Number(transmits),
    refracts: Number(refracts),
    blended: Number(blended),
    branches: Number(refracts || blended),
  };
}

/** Defines: what the surfaces ask of a point that a ray met. */
export function taken(parts: readonly Source[]): Numbers {
  const found = parts.flatMap(({ text }) => Array.from(text.matchAll(/\bv_(\w+)/g), (m) => m[1]!));
  const names = new Set(found);
  const takes = FOUND.map((name) => [`takes_${name}`, Number(names.has(name))] as const);
  return {
    ...Object.fromEntries(takes),
    takes_steps: Number(found.some((name) => name.endsWith("_steps"))),
    takes_own: Number(names.has("uv0") || names.has("tangent")),
  };
}

/** What a source is assembled with where no ray asks it for a surface. */
export const UNTRACED: Numbers = { draws_objects: 0, traced: 0, record: 0, ...taken([]) };
export const UNTRACED_LISTS: Lists = {
  ...{ OBJECTS: [], OBJECT_VALUES: [], SURFACES: [], IMAGE_ARRAYS: [] },
};

/** The records of OBJECT_VALUES: what each object has its own value of, and its type. */
export function ownValues(defines: Numbers, parts: readonly Source[]): readonly Record_[] {
  const every = parts.flatMap(({ uniforms }) => Object.entries(uniforms));
  const found = new Map(every.filter(([name]) => DRAW_NAMES.includes(name) || TEXTURE.test(name)));
  if (defines.reflects) found.set("u_reflectance", "float");
  if (defines.refracts) found.set("u_transmittance", "float").set("u_refraction", "float");
  let texel = FIRST_VALUE;
  return [...found.keys()].sort().map((name) => {
    const type = found.get(name)!;
    const isMatrix = type === "mat3";
    const record = {
      ...{ type, name: name.slice("u_".length), texel: `${texel}` },
      ...{ matrix: `${Number(isMatrix)}`, parts: type === "float" ? "x" : "xyz" },
    };
    texel += isMatrix ? 3 : 1;
    return record;
  });
}

/** How many texels an object takes in the list with these values of its own. */
export function texelsOf(values: readonly Record_[]): number {
  return values.reduce((sum, { matrix: wide }) => sum + (wide === "1" ? 3 : 1), FIRST_VALUE);
}

/**
 * The texels of every object (shaders/stages/list.glsl), as `given` in `objectValues`, and of the
 * tree about them. Throws SceneError.
 */
export function objectList(
  scene: Scene,
  surfaces: Surfaces,
  given: Values,
  values: readonly Record_[],
  meshes: readonly string[],
): number[] {
  const { eye } = scene.camera;
  const kinds = kindsOf(scene, surfaces);
  const texels: number[] = [];
  for (const [index, thing] of Object.values(scene.objects).entries()) {
    const [center, radius] = boundingSphere(scene, thing);
    const mesh = thing.mesh === null ? null : scene.meshes[thing.mesh]!.mesh;
    const size = mesh === null ? thing.scale[0] : meshes.indexOf(mesh);
    texels.push(...matrix.subtract(center, eye), radius * ROOM);
    const material = materialOf(scene, thing);
    const kind = 2 * kinds[index]! + Number(material.double_sided);
    texels.push(SHAPES.indexOf(shapeOf(thing)), kind, size);
    texels.push(stopsOf(material), ...rowsOf(thing, eye));
    for (const { name, matrix: wide } of values) {
      const value = given[`u_object${index}_${name}`] ?? [];
      for (let at = 0; at < (wide === "1" ? 9 : 3); at += 3) {
        texels.push(value[at] ?? 0, value[at + 1] ?? 0, value[at + 2] ?? 0, 0);
      }
    }
  }
  const made = float32(texels);
  return made.concat(sphereTree(chunks(made, 4 * texelsOf(values)).map((own) => own.slice(0, 4))));
}

/** 1 and the share of light that a material stops, negative where both its sides are seen. */
function stopsOf(material: Material): number {
  const stopped = material.alpha_mode === "blend" ? 0 : 1 - material.transmittance;
  return hasTwoSides(material) ? -1 - stopped : 1 + stopped;
}

/** Three texels: where an object is. */
function rowsOf(thing: SceneObject, eye: matrix.Triple): readonly number[] {
  if (thing.shape === "triangle") {
    const [a, b, c] = cornersOf(thing, eye);
    return [...a, 0, ...matrix.subtract(b, a), 0, ...matrix.subtract(c, a), 0];
  }
  const inverse = inverseMatrix(thing, eye);
  const row = (i: number) => [0, 4, 8, 12].map((column) => inverse[column + i]!);
  return [...row(0), ...row(1), ...row(2)];
}

/**
 * Names of the textures that the surfaces read: those of one array are alike, but the image.
 *
 * `parts` are what is read of each kind of surface, in order.
 */
export function imageArrays(
  scene: Scene,
  surfaces: Surfaces,
  parts: readonly Source[],
): readonly (readonly string[])[] {
  const arrays = new Map<string, Set<string>>();
  const kinds = kindsOf(scene, surfaces);
  for (const [index, thing] of Object.values(scene.objects).entries()) {
    const { uniforms } = parts[kinds[index]!]!;
    for (const [i, { texture: name }] of surfaces.get(thing)!.texels.entries()) {
      if (!Object.hasOwn(uniforms, `u_texture${i}`)) continue;
      const { image, encoding, wrap, filter } = scene.textures[name]!;
      const alike = [image.split("-")[1], encoding, ...wrap, filter].join();
      arrays.set(alike, (arrays.get(alike) ?? new Set()).add(name));
    }
  }
  return [...arrays.values()].flatMap((names) => chunks([...names], MOST_LAYERS));
}

function chunks<T>(values: readonly T[], most: number): T[][] {
  const count = Math.ceil(values.length / most);
  return Array.from({ length: count }, (_, i) => values.slice(i * most, (i + 1) * most));
}

/** What shaders know textures by: 256 times the array, and the layer in it. */
export function imageNumbers(arrays: readonly (readonly string[])[]): ReadonlyMap<string, number> {
  return new Map(
    arrays.flatMap((names, index) =>
      names.map((name, layer) => [name, MOST_LAYERS * index + layer] as const),
    ),
  );
}

/** Uniforms of every object, positions about the eye; `numbers` are those of the images. */
export function objectValues(
  scene: Scene,
  surfaces: Surfaces,
  numbers: ReadonlyMap<string, number>,
  eye: matrix.Triple,
): Values {
  const found: Record<string, number[]> = {};
  for (const [index, thing] of Object.values(scene.objects).entries()) {
    const at = `u_object${index}_`;
    const material = materialOf(scene, thing);
    const own = { ...place(thing, eye), ...sentOn(material), object: [index], gap: [0] };
    for (const [name, value] of Object.entries(own)) found[at + name] = float32(value);
    for (const [name, value] of Object.entries(materialValues(material))) {
      found[at + name.slice("u_".length)] = value;
    }
    for (const [i, used] of surfaces.get(thing)!.texels.entries()) {
      found[`${at}texture${i}`] = [numbers.get(used.texture) ?? 0];
      found[`${at}texture${i}_transform`] = textureTransform(used);
    }
  }
  return found;
}

function sentOn({ reflectance, transmittance, ior }: Material): Record<string, matrix.Vector> {
  return {
    reflectance: [reflectance],
    transmittance: [transmittance],
    refraction: [ior ?? DEFAULT_IOR],
  };
}

function place(thing: SceneObject, eye: matrix.Triple): Record<string, matrix.Vector> {
  if (thing.shape === "triangle") {
    const [a, b, c] = cornersOf(thing, eye);
    return { v0: a, e1: matrix.subtract(b, a), e2: matrix.subtract(c, a) };
  }
  return {
    ball: [...matrix.subtract(thing.position, eye), thing.scale[0]],
    inverse: inverseMatrix(thing, eye),
  };
}
