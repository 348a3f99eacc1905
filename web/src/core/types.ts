// Made by `npm run types` from server/lightbench/schema.py. Do not edit: run it again instead.

export type JsonValue = unknown;

/**
 * All that the browser loads or makes.
 */
export interface Contracts {
  manifest: Manifest;
  scene: Scene;
  plan: Plan;
}
/**
 * The shader library, the presets, the material library and the JSON schema of a scene.
 */
export interface Manifest {
  folders: {
    [k: string]: Folder;
  };
  files: {
    [k: string]: ShaderFile;
  };
  material_fields: {
    [k: string]: string;
  };
  icosphere_errors: number[];
  scenes: {
    [k: string]: SceneSummary;
  };
  materials: {
    [k: string]: LibraryMaterial;
  };
  schema: SchemaNode;
}
/**
 * `_choice.toml`: what every file of a choice folder promises.
 *
 * Of one `per` material, a material may make its own choice.
 */
export interface Folder {
  setting: string;
  title: string;
  function: string;
  optional: string[];
  default: string;
  about: string;
  per: "frame" | "material";
}
/**
 * One file of `shaders/`: `code` is free of comments and keeps the file's line numbers.
 */
export interface ShaderFile {
  meta: Pass | Choice;
  code: string;
  functions: {
    [k: string]: number;
  };
}
/**
 * Front matter of a render pass.
 */
export interface Pass {
  title: string;
  equation: string;
  source: string;
  domain: {
    [k: string]: [number, number];
  };
  unit: string;
  about: string;
  breaks: {
    [k: string]: string;
  };
  textbook_of: string;
  material: string[];
  surface: ("normal" | "emission" | "occlusion" | "opacity" | "mirror")[];
  reads: string[];
  signed: boolean;
  parameters: {
    [k: string]: Parameter;
  };
  draw: "screen" | "objects";
  each: "frame" | "light";
  writes: {
    [k: string]: Target;
  };
  when: string;
  blend: "none" | "over" | "add";
  keep: boolean;
}
/**
 * A value that a file's front matter offers: a slider, an option, a uniform or a define.
 */
export interface Parameter {
  kind: "float" | "int" | "bool" | "color";
  default: number | boolean | string | [number, number, number];
  range: [number, number] | null;
  step: number | null;
  unit: string;
  label: string;
  scale: "linear" | "log";
  per: "frame" | "light";
}
/**
 * What a pass writes: a texture of the output's size times `scale` (an expression).
 *
 * For each light it is instead made of square tiles, one a face of the light's map, of `side`
 * pixels (an expression). `clear` is its colour beforehand, or the scene's background.
 */
export interface Target {
  format: "rgba32f" | "rgba16f" | "rgba8" | "r32f";
  scale: string;
  side: string;
  depth: boolean;
  clear: "background" | [number, number, number, number];
}
/**
 * Front matter of a choice or of a lib file.
 */
export interface Choice {
  title: string;
  equation: string;
  source: string;
  domain: {
    [k: string]: [number, number];
  };
  unit: string;
  about: string;
  breaks: {
    [k: string]: string;
  };
  textbook_of: string;
  material: string[];
  surface: ("normal" | "emission" | "occlusion" | "opacity" | "mirror")[];
  reads: string[];
  signed: boolean;
  parameters: {
    [k: string]: Parameter;
  };
}
/**
 * A preset in the list of scenes.
 */
export interface SceneSummary {
  title: string;
  about: string;
}
/**
 * One material: its name for people, where its numbers come from, and values of a scene's.
 *
 * Colours are linear Rec. 709; kd and ks reflectances; eta and k for red, green and blue. A value
 * that is null follows from the others, as in a scene.
 */
export interface LibraryMaterial {
  title: string;
  source: string;
  base_color: [number, number, number];
  metalness: number;
  roughness: number;
  f0: [number, number, number] | null;
  ior: number | null;
  eta: [number, number, number] | null;
  k: [number, number, number] | null;
  kd: [number, number, number] | null;
  ks: [number, number, number] | null;
  shininess: number | null;
}
export interface SchemaNode {
  $ref?: string;
  $defs?: {
    [k: string]: SchemaNode;
  };
  type?: string;
  title?: string;
  description?: string;
  default?: JsonValue;
  minimum?: number;
  maximum?: number;
  const?: string;
  enum?: string[];
  pattern?: string;
  prefixItems?: SchemaNode[];
  anyOf?: SchemaNode[];
  oneOf?: SchemaNode[];
  discriminator?: {
    [k: string]: JsonValue;
  };
  properties?: {
    [k: string]: SchemaNode;
  };
  patternProperties?: {
    [k: string]: SchemaNode;
  };
  additionalProperties?: boolean | SchemaNode;
  required?: string[];
  kind?: string;
  unit?: string;
  slider?: [number, number];
  scale?: string;
}
/**
 * A whole scene. `settings` are its own defaults; a caller's settings stand above them.
 *
 * `size` is that of its picture in pixels, width and height, where nobody asks for another.
 *
 * `units = "classic"` marks intensities in which a light of 1 lights a white surface to 1:
 * they are multiplied by pi once, here, and the scene is physical from then on.
 */
export interface Scene {
  title: string;
  about: string;
  units: "physical" | "classic";
  camera: Camera;
  views: {
    [k: string]: Camera;
  };
  background: [number, number, number];
  size: [number, number] | null;
  textures: {
    [k: string]: Texture;
  };
  meshes: {
    [k: string]: MeshAsset;
  };
  materials: {
    [k: string]: Material;
  };
  objects: {
    [k: string]: SceneObject;
  };
  lights: {
    [k: string]: PointLight | DirectionalLight | SpotLight;
  };
  parts: {
    [k: string]: Part;
  };
  settings: {
    [k: string]: number | boolean | string;
  };
}
/**
 * A perspective camera whose `fov` is that of the picture's height or width, or an orthographic
 * one of `height` metres. In a `mirrored` one, right is left: a left-handed world.
 *
 * `light` names a light that the picture is taken from instead, with all that it reaches in sight.
 */
export interface Camera {
  eye: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
  fov: number;
  fov_of: "height" | "width";
  mirrored: boolean;
  projection: "perspective" | "orthographic";
  height: number;
  light: string | null;
}
/**
 * An image on surfaces: row 0 at v = 0. `image` is the key of a PNG in the asset store.
 */
export interface Texture {
  image: string;
  encoding: "srgb" | "linear";
  wrap: ["repeat" | "clamp" | "mirror", "repeat" | "clamp" | "mirror"];
  filter: "linear" | "nearest";
}
/**
 * A mesh in the asset store, the box it fills and the optional attributes it has.
 */
export interface MeshAsset {
  mesh: string;
  low: [number, number, number];
  high: [number, number, number];
  colors: boolean;
  uv1: boolean;
}
/**
 * Physical parameters, and classic ones that follow from them unless given (null).
 *
 * What a map holds is multiplied with the value of its slot. Beside these fields a material may
 * choose, for itself alone, what the menu marks as a material's own, such as its model. What is
 * not given and `library` has comes from that: from then on it is the scene's own.
 */
export interface Material {
  base_color: [number, number, number];
  metalness: number;
  roughness: number;
  f0: [number, number, number] | null;
  ior: number | null;
  eta: [number, number, number] | null;
  k: [number, number, number] | null;
  kd: [number, number, number] | null;
  ks: [number, number, number] | null;
  shininess: number | null;
  ambient: [number, number, number];
  reflectance: number;
  transmittance: number;
  emissive: [number, number, number];
  opacity: number;
  alpha_mode: "opaque" | "mask" | "blend";
  alpha_cutoff: number;
  double_sided: boolean;
  unlit: boolean;
  normal_scale: number;
  occlusion_strength: number;
  maps: {
    [k: string]: TextureMap;
  };
  library: string | null;
  [k: string]:
    | string
    | [number, number, number]
    | number
    | null
    | "opaque"
    | "mask"
    | "blend"
    | boolean
    | {
        [k: string]: TextureMap;
      };
}
/**
 * A texture over a surface, through u' = R (S u) + offset as in KHR_texture_transform.
 */
export interface TextureMap {
  texture: string;
  channels: "rgba" | "r" | "g" | "b" | "a";
  uv: 0 | 1;
  offset: [number, number];
  rotation: number;
  scale: [number, number];
}
/**
 * A shape under scale, then rotation (Euler x, y, z in degrees), then position.
 */
export interface SceneObject {
  shape: "plane" | "cube" | "sphere" | "cone" | "triangle" | "mesh";
  mesh: string | null;
  corners: [[number, number, number], [number, number, number], [number, number, number]] | null;
  material: string;
  position: [number, number, number];
  rotation: [number, number, number];
  scale: [number, number, number];
  stacks: number;
  sectors: number;
}
/**
 * Isotropic; `intensity` in candela, or the whole flux in lumen.
 */
export interface PointLight {
  color: [number, number, number];
  intensity: number;
  casts: boolean;
  far: number | null;
  type: "point";
  position: [number, number, number];
  unit: "candela" | "lumen";
  [k: string]: number | [number, number, number] | boolean | null | "point" | "candela" | "lumen";
}
/**
 * Parallel light along `direction`; `intensity` is the illuminance across it in lux.
 */
export interface DirectionalLight {
  color: [number, number, number];
  intensity: number;
  casts: boolean;
  far: number | null;
  type: "directional";
  direction: [number, number, number];
  [k: string]: number | [number, number, number] | boolean | null | "directional";
}
/**
 * A point light inside a cone: full up to the half angle `inner`, none from `outer` on.
 */
export interface SpotLight {
  color: [number, number, number];
  intensity: number;
  casts: boolean;
  far: number | null;
  type: "spot";
  position: [number, number, number];
  direction: [number, number, number];
  inner: number;
  outer: number;
  unit: "candela" | "lumen";
  [k: string]: number | [number, number, number] | boolean | null | "spot" | "candela" | "lumen";
}
/**
 * An outline about (0, 0) under scale, then rotation in degrees, then position.
 *
 * A square has its corners at -1 and 1, a circle the radius 1, a line runs along x from -1 to 1.
 * Position and rotation are in the frame of the parent, which its scale does not stretch; without
 * a parent, in the picture, whose shorter side runs from -1 to 1. `width` of the line in pixels.
 */
export interface Part {
  shape: "square" | "circle" | "line";
  parent: string | null;
  position: [number, number];
  rotation: number;
  scale: [number, number];
  color: [number, number, number];
  width: number;
}
/**
 * All that a renderer needs, and what the panel shows (`settings`, `files`).
 *
 * `signed`: the picture holds negative numbers by right, as a view of normals does.
 */
export interface Plan {
  size: number[];
  targets: {
    [k: string]: PlannedTarget;
  };
  textures: {
    [k: string]: PlannedTexture;
  };
  arrays: {
    [k: string]: PlannedArray;
  };
  tables: {
    [k: string]: PlannedTable;
  };
  programs: Program[];
  passes: PlannedPass[];
  outputs: {
    [k: string]: string;
  };
  signed: boolean;
  settings: string[];
  files: string[];
}
/**
 * A texture: `size` in pixels, `format` as in front matter, `depth` with a depth buffer.
 */
export interface PlannedTarget {
  size: number[];
  format: string;
  depth: boolean;
}
/**
 * An image on surfaces: its key in the asset store.
 */
export interface PlannedTexture {
  encoding: string;
  wrap: string[];
  filter: string;
  anisotropy: number;
  image: string;
}
/**
 * Images of one size as the layers of one texture.
 */
export interface PlannedArray {
  encoding: string;
  wrap: string[];
  filter: string;
  anisotropy: number;
  images: string[];
}
/**
 * Numbers that a shader reads by their place: four a texel, or those of meshes for rays.
 */
export interface PlannedTable {
  texels: number[];
  meshes: string[];
}
/**
 * Both specialised sources of a pass, where their lines come from, the attributes they read.
 */
export interface Program {
  vertex: string;
  fragment: string;
  vertex_lines: string[];
  fragment_lines: string[];
  attributes: string[];
}
/**
 * One pass: the target it writes, its clear colour (null: none), samplers by target.
 *
 * A pass to `keep` need not run again as long as it stays the same.
 */
export interface PlannedPass {
  name: string;
  target: string;
  clear: number[] | null;
  keep: boolean;
  samplers: {
    [k: string]: string;
  };
  batches: Batch[];
}
/**
 * Draws of one program in one state, with the uniforms they share.
 *
 * `tile`: x, y and side of the part of the target that is drawn to (null: all). `cull`: back faces
 * are not drawn. `blend`: null, or "over" and "add", which leave the depth buffer as it is.
 */
export interface Batch {
  program: number;
  tile: number[] | null;
  cull: boolean;
  blend: string | null;
  uniforms: {
    [k: string]: number[];
  };
  draws: Draw[];
}
/**
 * One mesh (null: the screen triangle), the uniforms that are its own.
 *
 * `textures`, `arrays` and `tables` by sampler.
 */
export interface Draw {
  mesh: string | null;
  uniforms: {
    [k: string]: number[];
  };
  textures: {
    [k: string]: string;
  };
  arrays: {
    [k: string]: string;
  };
  tables: {
    [k: string]: string;
  };
}
