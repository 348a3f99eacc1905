// One row of the panel as data: a slider with its reach, a switch, a colour, a menu.
import type { Manifest, Parameter, Scene, SchemaNode } from "./core/types";
import { fieldSchema, given, isOptional } from "./fields";
import { niceStep } from "./number";
import type { Part } from "./parts";

/** One row: a slider (`low` to `high` is its reach, `min` to `max` what may be typed), a switch… */
export interface Control {
  kind: "number" | "bool" | "color" | "option";
  name: string;
  part?: Part;
  label: string;
  unit: string;
  low: number;
  high: number;
  min: number;
  max: number;
  step: number;
  log: boolean;
  optional: boolean;
  options: Option[];
}

/** What may be chosen; `hint` says more about it. */
export interface Option {
  value: string | number;
  title: string;
  hint?: string;
}

/** Where fields are looked up. */
interface Place {
  manifest: Manifest;
  scene: Scene;
}

const LABELS: Record<string, string> = {
  base_color: "Base colour",
  color: "Colour",
  f0: "Reflectance f₀",
  ior: "Refractive index",
  eta: "Index η",
  k: "Index k",
  kd: "Diffuse kd",
  ks: "Specular ks",
  fov: "Field of view",
  inner: "Inner angle",
  outer: "Outer angle",
  height: "View height",
  casts: "Casts shadows",
  far: "Shadow range",
  emissive: "Emitted light",
  alpha_mode: "Transparency",
  alpha_cutoff: "Mask cutoff",
  double_sided: "Both sides",
  normal_scale: "Normal map strength",
};

// Metals stay below this in visible light, index and extinction.
const LARGEST_INDEX = 10;

const BLANK: Omit<Control, "kind" | "name" | "label"> = {
  unit: "",
  low: 0,
  high: 1,
  min: Number.NEGATIVE_INFINITY,
  max: Number.POSITIVE_INFINITY,
  step: 0.01,
  log: false,
  optional: false,
  options: [],
};

/** A parameter of a shader file. */
export function parameterControl(name: string, parameter: Parameter): Control {
  const [min = 0, max = 1] = parameter.range ?? [];
  const whole = parameter.kind === "int";
  return {
    ...BLANK,
    kind: parameter.kind === "color" || parameter.kind === "bool" ? parameter.kind : "number",
    name,
    label: parameter.label || name,
    unit: parameter.unit,
    low: min,
    high: max,
    min,
    max,
    step: parameter.step ?? (whole ? 1 : niceStep(max - min)),
    log: parameter.scale === "log",
  };
}

/** A field of the scene, as its schema describes it; a bright colour takes two rows. */
export function fieldControls(where: Place, path: string, unit = ""): Control[] {
  const node = fieldSchema(where.manifest, where.scene, path);
  if (!node) return [];
  const field = path.split(".").at(-1)!;
  const inner = given(node);
  const base: Control = {
    ...BLANK,
    kind: "number",
    name: path,
    label: LABELS[field] ?? words(field),
    unit: unit || inner.unit || "",
    optional: isOptional(node),
  };
  if (inner.kind === "color") return colorControls(base, inner);
  if (inner.type === "boolean") return [{ ...base, kind: "bool" }];
  if (inner.enum) {
    const options = inner.enum.map((value) => ({ value, title: words(value) }));
    return [{ ...base, kind: "option", options }];
  }
  if (inner.type === "array") return channels(base, inner);
  return inner.type === "number" || inner.type === "integer" ? [ranged(base, inner)] : [];
}

/** Three numbers for red, green and blue that are no colour; "auto" is that of all three. */
function channels(base: Control, node: SchemaNode): Control[] {
  if (node.kind || node.prefixItems?.length !== 3) return [];
  const { minimum: min = 0, maximum: max = 1 } = node.prefixItems[0]!;
  const reach = { low: min, high: Math.min(max, LARGEST_INDEX), min, max, step: 0.01 };
  return (["red", "green", "blue"] as const).map((part) => ({
    ...{ ...base, ...reach, part },
    ...{ label: `${base.label}, ${part}`, optional: base.optional && part === "red" },
  }));
}

/** A menu. */
export function optionControl(name: string, label: string, options: Option[]): Control {
  return { ...BLANK, kind: "option", name, label, options };
}

function ranged(base: Control, node: SchemaNode): Control {
  const min = node.minimum ?? base.min;
  const max = node.maximum ?? base.max;
  const [low = min, high = max] = node.slider ?? [];
  const step = node.type === "integer" ? 1 : niceStep(high - low);
  return { ...base, min, max, low, high, step, log: node.scale === "log" };
}

/** A colour that may be brighter than white has its brightness beside it. */
function colorControls(base: Control, node: SchemaNode): Control[] {
  const bright = (node.prefixItems?.[0]?.maximum ?? 1) > 1;
  if (!bright) return [{ ...base, kind: "color" }];
  const max = node.prefixItems?.[0]?.maximum ?? 1;
  const level = { low: 0, high: 100, min: 0, max, step: 0.01, log: true };
  return [
    { ...base, kind: "color", part: "hue" },
    { ...base, ...level, part: "level", label: `${base.label}, strength`, optional: false },
  ];
}

/** Three sliders of a point, `reach` metres to each side. */
export function position(name: string, label: string, reach: number): Control[] {
  return onAxes(name, label, reach, ["x", "y", "z"], "m");
}

/** A slider for each axis, `reach` to each side. */
export function onAxes(
  name: string,
  label: string,
  reach: number,
  axes: readonly Part[],
  unit: string,
): Control[] {
  return axes.map((part) => ({
    ...BLANK,
    kind: "number",
    name,
    part,
    label: `${label} ${part}`,
    unit,
    low: -reach,
    high: reach,
    min: -1e6,
    max: 1e6,
    step: niceStep(reach, 100),
  }));
}

/** Two angles of a direction. */
export function direction(name: string): Control[] {
  const base: Control = { ...BLANK, kind: "number", name, label: "", unit: "°", step: 0.5 };
  return [
    { ...base, part: "azimuth", label: "Azimuth", low: -180, high: 180, min: -360, max: 360 },
    { ...base, part: "elevation", label: "Elevation", low: -90, high: 90, min: -90, max: 90 },
  ];
}

/** `sphere_error` as a person writes it. */
export function words(name: string): string {
  const text = name.replaceAll("_", " ");
  return text[0]!.toUpperCase() + text.slice(1);
}
