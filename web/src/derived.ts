// What a field set to "auto" comes to, so that its slider can show it.
import type { Triple } from "./color";
import type { Scene } from "./core/types";
import { drawValues } from "./core/values";
import { AUTO, type Value } from "./fields";
import { shorten } from "./number";

// The refractive index of common dielectrics, which reflect 4 % at normal incidence.
const DIELECTRIC_IOR = 1.5;

/** The value that holds for a material's field, followed through where it is "auto". */
export function derived(scene: Scene, name: string): Value {
  const [, material = "", field = ""] = name.split(".");
  const own = scene.materials[material];
  if (!own) return AUTO;
  if (field === "ior") return own.ior ?? DIELECTRIC_IOR;
  if (field === "f0") {
    const ior = own.ior ?? DIELECTRIC_IOR;
    return own.f0 ?? (Array(3).fill(shorten(((ior - 1) / (ior + 1)) ** 2, 5)) as Triple);
  }
  const thing = Object.values(scene.objects).find((object) => object.material === material);
  const found = thing && drawValues(scene, thing)[`u_${field}`];
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
  return {};
}
