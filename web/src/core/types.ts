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
 * The shader library, the presets and the JSON schema of a scene.
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
  schema: SchemaNode;
}
/**
 * `_choice.toml`: what every file of a choice folder promises.
 */
export interface Folder {
  setting: string;
  title: string;
  function: string;
  optional: string[];
  default: string;
  about: string;
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
  reads: string[];
  parameters: {
    [k: string]: Parameter;
  };
  draw: "screen" | "objects";
  writes: {
    [k: string]: Target;
  };
  when: string;
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
 */
export interface Target {
  format: "rgba32f" | "rgba16f" | "rgba8";
  scale: string;
  depth: boolean;
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
  reads: string[];
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
 * `units = "classic"` marks intensities in which a light of 1 lights a white surface to 1:
 * they are multiplied by pi once, here, and the scene is physical from then on.
 */
export interface Scene {
  title: string;
  about: string;
  units: "physical" | "classic";
  camera: Camera;
  background: [number, number, number];
  materials: {
    [k: string]: Material;
  };
  objects: {
    [k: string]: SceneObject;
  };
  lights: {
    [k: string]: PointLight | DirectionalLight | SpotLight;
  };
  settings: {
    [k: string]: number | boolean | string;
  };
}
/**
 * A perspective camera; `fov` is vertical.
 */
export interface Camera {
  eye: [number, number, number];
  target: [number, number, number];
  up: [number, number, number];
  fov: number;
}
/**
 * Physical parameters, and classic ones that follow from them unless given (null).
 */
export interface Material {
  base_color: [number, number, number];
  metalness: number;
  roughness: number;
  f0: [number, number, number] | null;
  ior: number | null;
  kd: [number, number, number] | null;
  ks: [number, number, number] | null;
  shininess: number | null;
}
/**
 * A shape under scale, then rotation (Euler x, y, z in degrees), then position.
 */
export interface SceneObject {
  shape: "plane" | "cube" | "sphere" | "cone";
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
  type: "point";
  position: [number, number, number];
  unit: "candela" | "lumen";
  [k: string]: number | [number, number, number] | "point" | "candela" | "lumen";
}
/**
 * Parallel light along `direction`; `intensity` is the illuminance across it in lux.
 */
export interface DirectionalLight {
  color: [number, number, number];
  intensity: number;
  type: "directional";
  direction: [number, number, number];
  [k: string]: number | [number, number, number] | "directional";
}
/**
 * A point light inside a cone: full up to the half angle `inner`, none from `outer` on.
 */
export interface SpotLight {
  color: [number, number, number];
  intensity: number;
  type: "spot";
  position: [number, number, number];
  direction: [number, number, number];
  inner: number;
  outer: number;
  unit: "candela" | "lumen";
  [k: string]: number | [number, number, number] | "spot" | "candela" | "lumen";
}
/**
 * All that a renderer needs, and what the panel shows (`settings`, `files`).
 */
export interface Plan {
  size: number[];
  targets: {
    [k: string]: PlannedTarget;
  };
  programs: Program[];
  passes: PlannedPass[];
  outputs: {
    [k: string]: string;
  };
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
 */
export interface PlannedPass {
  name: string;
  target: string;
  clear: number[] | null;
  samplers: {
    [k: string]: string;
  };
  batches: Batch[];
}
/**
 * The draws of one program, with the uniforms they share.
 */
export interface Batch {
  program: number;
  uniforms: {
    [k: string]: number[];
  };
  draws: Draw[];
}
/**
 * One mesh (null: the screen triangle) and the uniforms that are its own.
 */
export interface Draw {
  mesh: string | null;
  uniforms: {
    [k: string]: number[];
  };
}
