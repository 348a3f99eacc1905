// What a field set to "auto" comes to, so that its slider can show it.
import type { Triple } from "./color";
import type { Scene } from "./core/types";
import { materialValues } from "./core/values";
import { lightMap } from "./core/viewpoint";
import { AUTO, type Value } from "./fields";
import { shorten } from "./number";

// The refractive index of common dielectrics, which reflect 4 % at normal incidence.
const DIELECTRIC_IOR = 1.5;
// Any width of a light's map: how far it reaches does not follow from it.
const SIDE = 1024;

/** The value that holds for a field, followed through where it is "auto". */
export function derived(scene: Scene, name: string): Value {
  const [group, material = "", field = ""] = name.split(".");
  const light = group === "lights" ? scene.lights[material] : undefined;
  if (light) return field === "far" ? shorten(lightMap(scene, light, SIDE).far, 5) : AUTO;
  const own = scene.materials[material];
  if (!own) return AUTO;
  if (field === "ior") return own.ior ?? DIELECTRIC_IOR;
  if (field === "f0") {
    const ior = own.ior ?? DIELECTRIC_IOR;
    return own.f0 ?? (Array(3).fill(shorten(((ior - 1) / (ior + 1)) ** 2, 5)) as Triple);
  }
  const found = materialValues(own)[`u_${field}`];
  if (!found) return AUTO;
  const factor = field === "kd" || field === "ks" ? Math.PI : 1;
  const values = found.map((value) => shorten(value * factor, 5));
  return values.length === 1 ? values[0]! : values;
}

/** The other settings that have to change along with this one, for the scene to stay valid. */
export function coupled(scene: Scene, name: string, value: Value): Record<string, Value> {
  const at = name.slice(0, name.lastIndexOf("."));
  const [group = "", member = "", field = ""] = name.split(".");
  const light = group === "lights" ? scene.lights[member] : undefined;
  if (light?.type === "spot" && typeof value === "number") {
    if (field === "inner" && value > light.outer) return { [`${at}.outer`]: value };
    if (field === "outer" && value < light.inner) return { [`${at}.inner`]: value };
  }
  if (group === "materials" && value !== AUTO) {
    if (field === "f0") return { [`${at}.ior`]: AUTO };
    if (field === "ior") return { [`${at}.f0`]: AUTO };
  }
  return group === "materials" && (field === "eta" || field === "k")
    ? withPartner(scene, at, field, value)
    : {};
}

/** Both parts of a complex index are given, or neither. */
function withPartner(
  scene: Scene,
  at: string,
  field: "eta" | "k",
  value: Value,
): Record<string, Value> {
  const other = field === "eta" ? "k" : "eta";
  if (value === AUTO) return { [`${at}.${other}`]: AUTO };
  const given = scene.materials[at.slice("materials.".length)]?.[other];
  return given ? {} : { [`${at}.${other}`]: derived(scene, `${at}.${other}`) };
}
