/** Materials of the library in a scene's. Twin of materials.py. */

import type { LibraryMaterial, Manifest } from "./types";

type Data = Record<string, unknown>;

/** The fields of a material that belong to its library material. */
export const LIBRARY_FIELDS = [
  ...(["base_color", "metalness", "roughness", "f0", "ior", "eta", "k"] as const),
  ...(["kd", "ks", "shininess"] as const),
];
/** What a material has one of, at most. */
const ALTERNATIVES = [["f0", "ior"] as const, ["ior", "f0"] as const];

/** A material that a link gives another library material: all else is that one's. */
export function withoutLibraryFields(draft: Data): Data {
  const kept = Object.entries(draft).filter(
    ([name]) => !(LIBRARY_FIELDS as readonly string[]).includes(name),
  );
  return Object.fromEntries(kept);
}

/** A material with the values of its library material under its own. */
export function completed(given: Data, materials: Manifest["materials"]): Data {
  const name = given.library;
  if (typeof name !== "string" || !Object.hasOwn(materials, name)) return given;
  const found: LibraryMaterial = materials[name]!;
  const own: Data = {};
  for (const field of LIBRARY_FIELDS) if (found[field] !== null) own[field] = found[field];
  for (const [one, other] of ALTERNATIVES) {
    if (given[one] !== undefined && given[one] !== null && given[one] !== "auto") delete own[other];
  }
  return { ...own, ...given };
}
