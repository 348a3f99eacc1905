/** A small library, scene and plan for the page's own tests. */

import type { Situation } from "../src/controls";
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

function parameter(given: Partial<Parameter>): Parameter {
  const plain = { default: 1, range: [0, 10], step: 0.01, unit: "", label: "" } as const;
  return { kind: "float", scale: "linear", per: "frame", ...plain, ...given } as Parameter;
}

function choice(title: string, given: Partial<Choice> = {}): Choice {
  const none = { textbook_of: "", domain: {}, breaks: {}, material: [], reads: [], parameters: {} };
  return { title, equation: "", source: "", unit: "", about: "", ...none, ...given };
}

function folder(setting: string, signature: string, chosen: string): Folder {
  return { setting, title: setting, function: signature, optional: [], default: chosen, about: "" };
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

const schema: SchemaNode = {
  $defs: {
    Camera: {
      properties: {
        eye: point(-1e6, 1e6),
        target: point(-1e6, 1e6),
        fov: { ...number(1, 170), unit: "deg", slider: [10, 120] },
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
      },
    },
    SpotLight: {
      properties: {
        color,
        intensity: number(0, 1e30),
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

export const manifest: Manifest = {
  folders: {
    models: folder("model", "vec3 brdf(Material m, vec3 l, vec3 v)", "matt"),
    tonemaps: folder("tonemap", "vec3 tonemap(vec3 radiance)", "none"),
    attenuations: folder("attenuation", "float attenuation(float distance, Light light)", "poly"),
    ambients: folder("ambient", "vec3 ambient(Material m)", "none"),
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
    "passes/resolve.glsl": {
      ...code,
      meta: {
        ...choice("Resolve", {
          parameters: { samples: parameter({ kind: "int", range: [1, 8], step: 1 }) },
        }),
        draw: "screen",
        writes: {},
        when: "samples > 1",
      },
    },
  },
  material_fields: {},
  icosphere_errors: [],
  scenes: { room: { title: "Room", about: "" } },
  schema,
};

export const scene: Scene = {
  title: "Room",
  about: "",
  units: "physical",
  camera: { eye: [0, 0, 5], target: [0, 0, 0], up: [0, 1, 0], fov: 45 },
  background: [0, 0, 0],
  materials: {
    wall: {
      base_color: [0.8, 0.8, 0.8],
      metalness: 0,
      roughness: 0.5,
      f0: null,
      ior: null,
      kd: null,
      ks: null,
      shininess: null,
    },
  },
  objects: {
    ball: {
      shape: "sphere",
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
export function situation(settings: Values, choices: Record<string, string>): Situation {
  const folders = Object.entries(manifest.folders);
  const files = folders
    .filter(([, { setting }]) => setting in choices)
    .map(([name, { setting }]) => `${name}/${choices[setting]}.glsl`);
  const plan: Plan = {
    size: [4, 3],
    targets: {},
    programs: [],
    passes: [],
    outputs: {},
    settings: Object.keys(choices),
    files,
  };
  return { manifest, scene, preset: scene, settings, plan };
}
