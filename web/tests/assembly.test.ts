import { describe, expect, test } from "vitest";
import { assemble } from "../src/core/assemble";
import { LightbenchError, ShaderError } from "../src/core/errors";
import { evaluate } from "../src/core/expression";
import { explain } from "../src/core/shader_log";
import { assembly, expressions, libraryOf, requestOf } from "./fixtures";

const VERSION = ["#version 300 es", "precision highp float;", "precision highp int;"];

describe("the expression language", () => {
  test.each(expressions)("$text", ({ text, names = {}, value, error }) => {
    if (error === undefined) expect(evaluate(text, names)).toBe(value);
    else expect(() => evaluate(text, names)).toThrow(new LightbenchError(error));
  });
});

describe("the assembler", () => {
  test.each(assembly.cases.filter((one) => one.body))("$name", (one) => {
    const { body = [], prologue = [] } = one;
    const source = assemble(libraryOf(one), requestOf(one));
    const head = [...VERSION, ...prologue];
    const lines = body.length ? body.map(([, line]) => line) : [""];
    expect(source.text.split("\n")).toEqual([...head, ...lines, ""]);
    const numbers = head.map((_, index) => `prologue:${index + 1}`);
    expect(source.lines).toEqual([...numbers, ...body.map(([where]) => where)]);
    expect(source.settings).toEqual(one.settings ?? []);
    expect(source.uniforms).toEqual(one.uniforms ?? {});
    expect(source.attributes).toEqual(one.attributes ?? {});
    if (one.used) expect(source.files).toEqual(one.used);
  });

  test.each(assembly.cases.filter((one) => one.error))("refuses: $name", (one) => {
    const error = new ShaderError(one.error);
    expect(() => assemble(libraryOf(one), requestOf(one))).toThrow(error);
  });

  test.each(assembly.logs)("explains the log of $name", ({ log, text, lines, explained }) => {
    expect(explain(log, text, lines)).toBe(explained);
  });
});
