/**
 * The small expression language of `#if`, of a pass's `when` and of a target's `scale`.
 *
 * Numbers, names, 'strings', `|| && == != < <= > >= + - * ! ( )`, C precedence; a comparison is 0
 * or 1. Twin of expression.py.
 */

import { LightbenchError } from "./errors";

export type Value = number | string;
export type Names = Readonly<Record<string, Value>>;

interface Token {
  readonly kind: "number" | "name" | "string" | "operator";
  readonly text: string;
}

const TOKEN =
  /\s*(?:(?<number>\d+\.?\d*|\.\d+)|(?<name>[A-Za-z_]\w*)|'(?<string>[^']*)'|(?<operator>\|\||&&|[=!<>]=|[<>!+\-*()]))/y;
const LEVELS = [["||"], ["&&"], ["==", "!="], ["<", "<=", ">", ">="], ["+", "-"], ["*"]];
const NUMERIC: Record<string, (a: number, b: number) => number> = {
  "||": (a, b) => Number(Boolean(a) || Boolean(b)),
  "&&": (a, b) => Number(Boolean(a) && Boolean(b)),
  "<": (a, b) => Number(a < b),
  "<=": (a, b) => Number(a <= b),
  ">": (a, b) => Number(a > b),
  ">=": (a, b) => Number(a >= b),
  "+": (a, b) => a + b,
  "-": (a, b) => a - b,
  "*": (a, b) => a * b,
};

/**
 * The value of `text` with `names` bound.
 *
 * Throws LightbenchError when the text does not parse, a name is not defined or a string is used as
 * a number.
 */
export function evaluate(text: string, names: Names): Value {
  return new Parser(text, names).parse();
}

function tokens(text: string): Token[] {
  const found: Token[] = [];
  const end = text.trimEnd().length;
  let position = 0;
  while (position < end) {
    TOKEN.lastIndex = position;
    const groups = TOKEN.exec(text)?.groups;
    if (!groups) {
      const rest = text.slice(position).trim();
      throw new LightbenchError(`'${text.trim()}' does not parse at '${rest}'`);
    }
    for (const kind of ["number", "name", "string", "operator"] as const) {
      const token = groups[kind];
      if (token !== undefined) found.push({ kind, text: token });
    }
    position = TOKEN.lastIndex;
  }
  return found;
}

class Parser {
  private readonly tokens: readonly Token[];
  private at = 0;

  constructor(
    private readonly text: string,
    private readonly names: Names,
  ) {
    this.tokens = tokens(text);
  }

  parse(): Value {
    const value = this.binary(0);
    if (this.at < this.tokens.length) throw this.unexpected();
    return value;
  }

  private unexpected(): LightbenchError {
    const token = this.tokens[this.at];
    const found = token ? `'${token.text}'` : "its end";
    return new LightbenchError(`'${this.text.trim()}' does not parse at ${found}`);
  }

  private accept(...operators: readonly string[]): string | null {
    const token = this.tokens[this.at];
    if (token?.kind !== "operator" || !operators.includes(token.text)) return null;
    this.at += 1;
    return token.text;
  }

  private binary(level: number): Value {
    const operators = LEVELS[level];
    if (!operators) return this.unary();
    let left = this.binary(level + 1);
    for (;;) {
      const operator = this.accept(...operators);
      if (operator === null) return left;
      left = this.apply(operator, left, this.binary(level + 1));
    }
  }

  private apply(operator: string, left: Value, right: Value): Value {
    if (operator === "==" || operator === "!=") {
      return Number((left === right) === (operator === "=="));
    }
    return NUMERIC[operator]!(this.number(left), this.number(right));
  }

  private number(value: Value): number {
    if (typeof value === "string") {
      throw new LightbenchError(`'${this.text.trim()}' uses the text '${value}' as a number`);
    }
    return value;
  }

  private unary(): Value {
    if (this.accept("!")) return Number(!this.number(this.unary()));
    if (this.accept("-")) return -this.number(this.unary());
    if (this.accept("(")) {
      const value = this.binary(0);
      if (!this.accept(")")) throw this.unexpected();
      return value;
    }
    return this.primary();
  }

  private primary(): Value {
    const token = this.tokens[this.at];
    if (!token || token.kind === "operator") throw this.unexpected();
    this.at += 1;
    if (token.kind === "number") return Number(token.text);
    if (token.kind === "string") return token.text;
    const value = Object.hasOwn(this.names, token.text) ? this.names[token.text] : undefined;
    if (value === undefined) {
      const known = Object.keys(this.names).sort().join(", ");
      throw new LightbenchError(`'${token.text}' is not defined; defined are: ${known}`);
    }
    return value;
  }
}
