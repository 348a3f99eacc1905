// Which symbol of a formula a slider moves, and the formula's TeX with those symbols marked.

const GREEK =
  /^(alpha|beta|gamma|delta|epsilon|eta|theta|kappa|lambda|mu|nu|rho|sigma|tau|phi|psi|omega)$/;

// How the formulas of the shader folder write the material's fields.
const FIELDS: Record<string, string> = {
  base_color: "\\rho",
  roughness: "\\alpha",
  f0: "F_0",
  ior: "F_0",
  kd: "k_d",
  ks: "k_s",
  shininess: "s",
  light_radius: "r",
  ambient_color: "L_s",
  ambient_level: "L_s",
};

/** The symbol of a setting in TeX: `materials.wall.roughness` moves alpha, `L_white` is L_w. */
export function symbolOf(name: string): string {
  const last = name.split(".").at(-1)!;
  const [head = "", tail = ""] = last.split("_");
  if (FIELDS[last]) return FIELDS[last];
  if (GREEK.test(last)) return `\\${last}`;
  const index = /^([a-z])(\d)$/i.exec(last);
  if (index) return `${index[1]}_${index[2]}`;
  return /^[a-z]$/i.test(head) && tail ? `${head}_${tail[0]}` : `\\mathrm{${last}}`;
}

/** The TeX with every occurrence of a symbol in an element of the class `symbol-INDEX`. */
export function mark(tex: string, symbols: readonly string[]): string {
  const order = [...symbols.keys()].sort((a, b) => symbols[b]!.length - symbols[a]!.length);
  if (!order.length) return tex;
  const any = order.map((index) => `(${pattern(symbols[index]!)})`).join("|");
  return tex.replace(new RegExp(any, "g"), (found, ...groups) => {
    const at = groups.findIndex((group) => group !== undefined);
    return `{\\htmlClass{symbol-${order[at]}}{${found}}}`;
  });
}

/** The symbol alone: not a letter of a command or of a longer name, nor with another index. */
function pattern(symbol: string): string {
  const text = symbol.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&");
  const start = /^[a-z]/i.test(symbol) ? "(?<![A-Za-z\\\\_])" : "";
  const end = /[a-z0-9]$/i.test(symbol) ? "(?![A-Za-z0-9_])" : "";
  return `${start}${text}${end}(?:\\^(?:\\{[^{}]*\\}|\\w))?`;
}
