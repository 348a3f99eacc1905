import { describe, expect, test } from "vitest";
import { declarations, type Source, UNIFORM } from "../src/core/assemble";
import { link } from "../src/core/link";

const HEAD = "#version 300 es\nprecision highp float;\n";
const MAIN = "void main() {\n    light_0();\n}\n";

/** A source whose lines say that they are of a file `name`. */
function source(text: string, name: string): Source {
  const whole = HEAD + text;
  const count = whole.split("\n").length - 1;
  return {
    text: whole,
    lines: Array.from({ length: count }, (_, index) => `${name}:${index + 1}`),
    files: [name, "lib"],
    settings: [`set_${name}`, "set"],
    uniforms: declarations(whole, UNIFORM),
    attributes: {},
    varyings: [],
  };
}

function linked(parts: readonly string[], main = MAIN, variables: readonly string[] = []): Source {
  const made = parts.map((part, index) => source(part, `part${index}`));
  return link(made, "light", source(main, "main"), new Set(variables));
}

const light = (call: string) => `float light() {\n    return ${call};\n}\n`;
const of = (kind: string, value: string) => `float of(${kind} x) {\n    return ${value};\n}\n`;

describe("parts before main", () => {
  test("have their entries numbered", () => {
    const [one, two] = ["1.0", "2.0"].map((value, index) =>
      light(value).replace("light", `light_${index}`),
    );
    expect(linked([light("1.0"), light("2.0")]).text).toBe(HEAD + one + two + MAIN);
  });

  test("share what is alike", () => {
    const shared = "const float HALF = 0.5;\nfloat half(float x) {\n    return HALF * x;\n}\n";
    const parts = [shared + light("half(1.0)"), shared + light("half(2.0)")];
    expect(linked(parts, shared + MAIN).text.split(shared)).toHaveLength(2);
  });

  test("number what differs, and what mentions it follows", () => {
    const twice = "float twice(float x) {\n    return 2.0 * of(x);\n}\n";
    const parts = ["x", "-x"].map((value) => of("float", value) + twice + light("twice(1.0)"));
    const { text } = linked(parts);
    expect(text).toContain(of("float", "x") + twice);
    const second = (of("float", "-x") + twice).replaceAll("of(", "of_1(");
    expect(text).toContain(second.replace("twice(", "twice_1("));
    expect(text).toContain("float light_1() {\n    return twice_1(1.0);\n}\n");
  });

  test("number what main means otherwise", () => {
    const part = `#define SIZE 1\n${light("SIZE")}`;
    const { text } = linked([part], `#define SIZE 2\n${MAIN}`);
    expect(text).toContain("#define SIZE_0 1\nfloat light_0() {\n    return SIZE_0;");
    expect(text).toContain("#define SIZE 2\nvoid main");
  });

  test("keep a name whose overloads are alike, though one part has one more", () => {
    const more = of("vec3", "of(x.x)");
    const { text } = linked([
      of("float", "x") + light("1.0"),
      of("float", "x") + more + light("2.0"),
    ]);
    expect(text.split(of("float", "x"))).toHaveLength(2);
    expect(text).toContain(more);
  });

  test("number every overload where one differs", () => {
    const parts = ["x.x", "x.y"].map((v) => of("float", "x") + of("vec3", v) + light("of(1.0)"));
    const { text } = linked(parts);
    expect(text).toContain((of("float", "x") + of("vec3", "x.y")).replaceAll("of(", "of_1("));
    expect(text).toContain("float light_1() {\n    return of_1(1.0);\n}\n");
  });
});

test("uniforms that main sets become variables", () => {
  const both = "uniform float u_rough;\nuniform highp sampler2D u_map;\n";
  const part = both + light("u_rough");
  const { text, uniforms } = linked([part, part], both + MAIN, ["u_rough"]);
  expect(text.split("float u_rough;\n")).toHaveLength(2);
  expect(text).not.toContain("uniform float u_rough");
  expect(uniforms).toEqual({ u_map: "sampler2D" });
});

test("every line says where it is from, and files and settings are those of all", () => {
  const { text, lines, files, settings } = linked([light("1.0"), light("2.0")]);
  const texts = text.split("\n");
  expect(lines).toHaveLength(texts.length - 1);
  expect(lines[0]).toBe("main:1");
  expect(lines[texts.indexOf("    return 1.0;")]).toBe("part0:4");
  expect(lines[texts.indexOf("    light_0();")]).toBe("main:4");
  expect(files).toEqual(["part0", "lib", "part1", "main"]);
  expect(settings).toEqual(["set_part0", "set", "set_part1", "set_main"]);
});
