/** A small library, scene and plan for the page's own tests. */

import type {
  Choice,
  Folder,
  Manifest,
  Parameter,
  Plan,
  Scene,
  SchemaNode,
} from "../src/core/types";
import type { Values } from "../src/fields";
import type { Situation } from "../src/groups";

function parameter(given: Partial<Parameter>): Parameter {
  const plain = { default: 1, range: [0, 10], step: 0.01, unit: "", label: "" } as const;
  return { kind: "float", scale: "linear", per: "frame", ...plain, ...given } as Parameter;
}

function choice(title: string, given: Partial<Choice> = {}): Choice {
  const texts = { title, equation: "", source: "", unit: "", about: "", textbook_of: "" };
  const none = { domain: {}, breaks: {}, material: [], surface: [], reads: [], parameters: {} };
  return { ...texts, ...none, signed: false, ...given };
}

function folder(setting: string, signature: string, chosen: string): Folder {
  const plain = { title: setting, about: "", per: "frame" } as const;
  return { setting, function: signature, default: chosen, ...plain, optional: [] };
}

const point = (min: number, max: number, kind?: string): SchemaNode => ({
  type: "array",
  prefixItems: Array(3).fill({ type: "number", minimum: min, maximum: max }),
  ...(kind ? { kind } : {}),
});
const number = (minimum: number, maximum: number): SchemaNode => ({
  type: "number",
  minimum,
  maximum,
});
const orAuto = (node: SchemaNode): SchemaNode => ({ anyOf: [node, { type: "null" }] });
const color = point(0, 1, "color");
const pair: SchemaNode = {
  ...{ type: "array", prefixItems: [number(-1e6, 1e6), number(-1e6, 1e6)] },
};

const schema: SchemaNode = {
  $defs: {
    Camera: {
      properties: {
        eye: point(-1e6, 1e6),
        target: point(-1e6, 1e6),
        fov: { ...number(1, 170), unit: "deg", slider: [10, 120] },
        projection: { type: "string", enum: ["perspective", "orthographic"] },
        height: { ...number(1e-6, 1e6), unit: "m", slider: [0.1, 100], scale: "log" },
        light: orAuto({ type: "string" }),
      },
    },
    Material: {
      properties: {
        base_color: color,
        metalness: number(0, 1),
        roughness: number(0, 1),
        f0: orAuto(color),
        ior: orAuto(number(1, 5)),
        kd: orAuto(color),
        ks: orAuto(point(0, 1e30, "color")),
        shininess: orAuto({ ...number(0, 1e6), slider: [1, 1e4], scale: "log" }),
        emissive: point(0, 1e30, "color"),
        opacity: number(0, 1),
        alpha_mode: { type: "string", enum: ["opaque", "mask", "blend"] },
        alpha_cutoff: number(0, 1),
        double_sided: { type: "boolean" },
        unlit: { type: "boolean" },
        normal_scale: number(0, 4),
        occlusion_strength: number(0, 1),
        maps: { type: "object" },
        library: orAuto({ type: "string" }),
      },
    },
    Part: {
      properties: {
        position: pair,
        rotation: { ...number(-360, 360), unit: "deg", slider: [-180, 180] },
        scale: { ...pair, kind: "factors" },
        color: point(0, 1e30, "color"),
        width: { ...number(1, 64), unit: "px", slider: [1, 16] },
      },
    },
    SpotLight: {
      properties: {
        color,
        intensity: number(0, 1e30),
        casts: { type: "boolean" },
        far: orAuto(number(1e-6, 1e6)),
        position: point(-1e6, 1e6),
        direction: point(-1, 1),
        inner: number(0, 180),
        outer: number(0, 180),
        unit: { type: "string", enum: ["candela", "lumen"] },
      },
    },
  },
};

const code = { code: "", functions: {} };

const plain = {
  ...{ metalness: 1, roughness: 0.2, f0: null, ior: null, eta: null, k: null },
  ...{ kd: null, ks: null, shininess: null },
};

export const manifest: Manifest = {
  folders: {
    models: {
      ...folder("model", "vec3 brdf(Material m, vec3 l, vec3 v)", "matt"),
      per: "material",
    },
    tonemaps: folder("tonemap", "vec3 tonemap(vec3 radiance)", "none"),
    attenuations: folder("attenuation", "float attenuation(float distance, Light light)", "poly"),
    ambients: folder("ambient", "vec3 ambient(Material m)", "none"),
    shadows: {
      ...folder("shadow", "float shadow(int light, Receiver r)", "none"),
      optional: ["bool unshadowed()"],
    },
  },
  files: {
    "models/matt.glsl": { ...code, meta: choice("Matt", { material: ["base_color"] }) },
    "models/shiny.glsl": {
      ...code,
      meta: choice("Shiny", { material: ["kd", "ks", "shininess"] }),
    },
    "tonemaps/none.glsl": { ...code, meta: choice("None") },
    "tonemaps/curve.glsl": {
      ...code,
      meta: choice("Curve", { parameters: { L_white: parameter({ default: 4 }) } }),
    },
    "attenuations/poly.glsl": {
      ...code,
      meta: choice("Polynomial", { parameters: { c0: parameter({ per: "light" }) } }),
    },
    "ambients/none.glsl": { ...code, meta: choice("None") },
    "shadows/none.glsl": { code: "", functions: { unshadowed: 0 }, meta: choice("None") },
    "shadows/hard.glsl": { ...code, meta: choice("Hard") },
    "passes/resolve.glsl": {
      ...code,
      meta: {
        ...choice("Resolve", {
          parameters: { samples: parameter({ kind: "int", range: [1, 8], step: 1 }) },
        }),
        draw: "screen",
        each: "frame",
        writes: {},
        when: "samples > 1",
        blend: "none",
        keep: false,
      },
    },
  },
  material_fields: {},
  icosphere_errors: [],
  materials: { gold: { ...plain, title: "Gold", source: "", base_color: [1, 0.8, 0.3] } },
  scenes: { room: { title: "Room", about: "" } },
  schema,
};

const lens: Omit<Scene["camera"], "eye" | "target" | "up" | "fov"> = {
  ...{ fov_of: "height", mirrored: false, projection: "perspective", height: 5, light: null },
};

export const scene: Scene = {
  title: "Room",
  about: "",
  units: "physical",
  camera: { eye: [0, 0, 5], target: [0, 0, 0], up: [0, 1, 0], fov: 45, ...lens },
  views: {},
  background: [0, 0, 0],
  size: null,
  textures: {},
  meshes: {},
  materials: {
    wall: {
      base_color: [0.8, 0.8, 0.8],
      metalness: 0,
      roughness: 0.5,
      f0: null,
      ior: null,
      eta: null,
      k: null,
      kd: null,
      ks: null,
      shininess: null,
      ambient: [0, 0, 0],
      reflectance: 0,
      transmittance: 0,
      emissive: [0, 0, 0],
      opacity: 1,
      alpha_mode: "opaque",
      alpha_cutoff: 0.5,
      double_sided: false,
      unlit: false,
      normal_scale: 1,
      occlusion_strength: 1,
      maps: {},
      library: null,
    },
  },
  parts: {},
  objects: {
    ball: {
      shape: "sphere",
      mesh: null,
      corners: null,
      material: "wall",
      position: [0, 0, 0],
      rotation: [0, 0, 0],
      scale: [1, 1, 1],
      stacks: 16,
      sectors: 64,
    },
  },
  lights: {
    lamp: {
      type: "spot",
      color: [1, 1, 1],
      intensity: 14,
      casts: true,
      far: null,
      position: [0, 3, 0],
      direction: [0, -1, 0],
      inner: 14,
      outer: 24,
      unit: "candela",
    },
  },
  settings: { tonemap: "curve", L_white: 3 },
};

/** A plan in which these choices are in use. */
export function situation(
  settings: Values,
  choices: Record<string, string>,
  preset = scene,
): Situation {
  const folders = Object.entries(manifest.folders);
  const files = folders
    .filter(([, { setting }]) => setting in choices)
    .map(([name, { setting }]) => `${name}/${choices[setting]}.glsl`);
  const plan: Plan = {
    size: [4, 3],
    targets: {},
    textures: {},
    arrays: {},
    tables: {},
    programs: [],
    passes: [],
    outputs: {},
    signed: false,
    settings: Object.keys(choices),
    files,
  };
  return { manifest, scene: preset, preset, settings, plan };
}
