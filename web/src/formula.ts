// Formulas, typeset once the first picture stands: KaTeX is larger than the rest of the page.
import { mark } from "./symbols";

type Katex = typeof import("katex");

let loading: Promise<Katex> | undefined;
// Smallest size, relative to the text, to which a formula shrinks before it scrolls.
const SMALLEST = 0.72;
// What stands between the parts of a formula.
const PART = /,\s*\\q?quad\s*/;

/** Fetch the typesetter and its style; called once there is time for it. */
export function loadTypesetter(): Promise<Katex> {
  loading ??= Promise.all([import("katex"), import("katex/dist/katex.min.css")]).then(
    ([module]) => module,
  );
  return loading;
}

/** An element that becomes the formula; its symbols light up through `light`. */
export class Formula {
  readonly element = document.createElement("div");
  private katex: Katex | null = null;

  constructor(
    private tex: string,
    private readonly symbols: readonly string[],
  ) {
    this.element.className = "formula";
    this.element.tabIndex = -1;
    void this.typeset();
  }

  /** Mark a symbol (none: no symbol) while its slider is hovered or focused. */
  light(symbol: string | null): void {
    for (const lit of this.element.querySelectorAll(".lit")) lit.classList.remove("lit");
    const index = symbol === null ? -1 : this.symbols.indexOf(symbol);
    if (index < 0) return;
    for (const found of this.element.querySelectorAll(`.symbol-${index}`))
      found.classList.add("lit");
  }

  /** Make it fit: called when the panel's width may have changed. */
  fit(): void {
    const style = this.element.style;
    style.fontSize = "";
    const share = this.element.clientWidth / Math.max(this.element.scrollWidth, 1);
    if (share > 0 && share < SMALLEST && this.katex && this.breakLines()) {
      this.fit();
      return;
    }
    if (share > 0 && share < 1) style.fontSize = `${Math.max(share * 0.99, SMALLEST)}em`;
  }

  private async typeset(): Promise<void> {
    this.katex = await loadTypesetter();
    this.render(this.katex);
    await document.fonts?.ready;
    this.fit();
  }

  /** A formula too wide for one line stands in several, if it has parts; false where it has not. */
  private breakLines(): boolean {
    const parts = this.tex.split(PART);
    if (parts.length < 2) return false;
    this.tex = `\\begin{gathered}${parts.join(",\\\\[0.6em]")}\\end{gathered}`;
    this.render(this.katex!);
    return true;
  }

  private render(katex: Katex): void {
    const options = {
      displayMode: true,
      throwOnError: false,
      strict: false,
      trust: ({ command }: { command: string }) => command === "\\htmlClass",
    };
    this.element.innerHTML = katex.renderToString(mark(this.tex, this.symbols), options);
  }
}
