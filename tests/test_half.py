"""Emulated half precision: what is rounded, and that it is rounded as a half is."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from lightbench.assemble import Request, assemble
from lightbench.batches import light_lists
from lightbench.errors import ShaderError
from lightbench.glsl import call
from lightbench.half import HALF, halved
from lightbench.scene import Scene
from lightbench.traced import UNTRACED, UNTRACED_LISTS, scene_defines
from tests.samples import single
from tests.support import copy_of_shaders, library

HEAD = "#version 300 es\nprecision highp float;\nprecision highp int;\n"
X = np.float32(1.0) + np.linspace(0.0, 1.0, 400, dtype=np.float32) ** 2


def body(code: str) -> str:
    """What becomes of code below the prologue."""
    return halved(HEAD + code).removeprefix(halved(HEAD).rstrip("\n")).lstrip("\n")


def half(values: Any) -> NDArray[np.float32]:
    """Rounded by NumPy."""
    with np.errstate(over="ignore"):
        return np.asarray(values, np.float16).astype(np.float32)


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("float a = b;", "float a = toHalf(b);"),
        ("highp vec3 a = b, c, d = vec3(0.0, e, f);",
         "highp vec3 a = toHalf(b), c, d = toHalf(vec3(0.0, e, f));"),
        ("const float a = 2.0;", "float a = toHalf(2.0);"),
        ("int i = j;", "int i = j;"),
        ("float a; a += b;", "float a; a = toHalf(a + (b));"),
        ("vec3 a; a.xy = b;", "vec3 a; a.xy = toHalf(b);"),
        ("int i; i = j; i *= 2;", "int i; i = j; i *= 2;"),
        ("float a; if (a == b) a = c; else a /= d;",
         "float a; if (a == b) a = toHalf(c); else a = toHalf(a / (d));"),
        ("float a; for (int i = 0; i < 3; ++i) { a = f(a, i); }",
         "float a; for (int i = 0; i < 3; ++i) { a = toHalf(f(a, i)); }"),
        ("mat3 m = n;", "mat3 m = n;"),
        ("return (a + b) * c;", "return toHalf((a + b) * c);"),
        ("if (a) { return b; }", "if (a) { return toHalf(b); }"),
        ("while (a < b) a *= 2.0;", "while (a < b) a *= 2.0;"),
    ],
)  # fmt: skip
def test_a_store_is_rounded(code: str, expected: str) -> None:
    got = body(f"float f() {{ {code} }}\n")
    assert " ".join(got.split()) == " ".join(f"float f() {{ {expected} }}".split())


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("float f(float a, const vec2 b, int c, out float d) {}",
         "float f(float a, const vec2 b, int c, out float d) { a = toHalf(a);}"),
        ("bool f(vec3 a) { return b; }", "bool f(vec3 a) { a = toHalf(a); return b; }"),
        ("const float PI = 3.14159265;", "const float PI = 3.140625;"),
        ("const float A = 1e-9;", "const float A = 0.0;"),
        ("const float A = 1e30;", "const float A = 65504.0;"),
        ("const vec3 A = vec3(1.0, 0.1, .5);", "const vec3 A = vec3(1.0, 0.0999755859375, 0.5);"),
        ("const float B = A * 3.3;", "const float B = A * 3.3;"),
        ("const int A = 70000;", "const int A = 70000;"),
        ("struct S { vec3 a; int b; };", "struct S { vec3 a; int b; };"),
        ("struct S { vec3 a; int b; };\nvoid f(S s) { s.a = c; s.b = d; s.a.x *= e; }",
         "struct S { vec3 a; int b; };\nvoid f(S s) { s.a = toHalf(c); s.b = d; "
         "s.a.x = toHalf(s.a.x * (e)); }"),
        ("float A;\nvoid f() { A = b; }", "float A;\nvoid f() { A = toHalf(b); }"),
        ("#define TWICE(x) float y = x; y\nvoid f() {}",
         "#define TWICE(x) float y = x; y\nvoid f() {}"),
    ],
)  # fmt: skip
def test_what_is_rounded_and_what_is_not(code: str, expected: str) -> None:
    assert body(code + "\n").strip() == expected


def test_lines_stay_where_they_are() -> None:
    text = HEAD + "\nfloat f(float a) {\n  float b =\n    a;\n  return b;\n}\n"
    lines = halved(text).split("\n")
    assert [line.strip()[:1] for line in lines] == [x.strip()[:1] for x in text.split("\n")]


def shaders(folder: Path, code: str) -> Path:
    return copy_of_shaders(folder, {"lib/mine.glsl": code})


def test_rounding_is_that_of_a_half(tmp_path: Path) -> None:
    """To the nearest, ties to even; subnormals; beyond 65520 infinite."""
    random = np.random.default_rng(0)
    values = random.normal(size=4000) * 10.0 ** random.uniform(-9.0, 6.0, 4000)
    ends = [0.0, 65504.0, 65519.9, 65520.0, -7e4, 2.9e-8, 3e-8, 6.1e-5, np.inf, -np.inf, np.nan]
    x = single([*values, *ends])
    folder = shaders(tmp_path, "float same(float x) { return x; }\n")
    got = call("lib/mine.glsl", "same", x, shaders=folder, half=True)
    np.testing.assert_array_equal(got, half(x))


def test_every_step_is_rounded(tmp_path: Path) -> None:
    code = """
float third(float x) {
    float y = x / 3.0, z = y * y;
    if (x > 1.5) z += 0.1; else { z -= 0.1; }
    for (int i = 0; i < 2; ++i) { z = z * x; }
    return z + y;
}
"""
    got = call("lib/mine.glsl", "third", X, shaders=shaders(tmp_path, code), half=True)
    x = half(X)
    y = half(x / np.float32(3.0))
    z = half(y * y)
    z = half(np.where(x > 1.5, z + np.float32(0.1), z - np.float32(0.1)))
    z = half(half(z * x) * x)
    # The last sum is rounded once; a fused multiplication of the driver may move it by a step.
    assert np.abs(got / half(z + y) - 1.0).max() <= 2.0**-10
    assert (got == half(z + y)).mean() > 0.95
    plain = call("lib/mine.glsl", "third", X, shaders=shaders(tmp_path / "b", code))
    assert (plain != got).mean() > 0.9


def test_structs_and_parameters_arrive_rounded() -> None:
    m = {"f0": single([[0.1, 0.2, 0.3]])}
    got = call("fresnels/schlick.glsl", "fresnel", m, single([1.0]), half=True)
    assert (got == half(m["f0"])).all()
    white = single([0.1])
    grey = single([[1.0, 1.0, 1.0]])
    rounded = half(white)
    want = call("tonemaps/reinhard_extended.glsl", "tonemap", grey, settings={"L_white": rounded})
    got = call(
        "tonemaps/reinhard_extended.glsl", "tonemap", grey, settings={"L_white": white}, half=True
    )
    assert np.abs(got / want - 1.0).max() < 4 * 2.0**-11


def test_results_are_halves() -> None:
    h = single([[np.sin(t), 0.0, np.cos(t)] for t in np.linspace(0.0, 1.5, 50)])
    got = call("distributions/ggx.glsl", "distribution", h, single([0.3]), half=True)
    assert (got == half(got)).all()
    full = call("distributions/ggx.glsl", "distribution", h, single([0.3]))
    assert np.abs(got / full - 1.0).max() < 0.01


def test_a_mistake_still_has_its_line(tmp_path: Path) -> None:
    folder = shaders(tmp_path, "float f(float x) {\n    float y = x;\n    return z;\n}\n")
    with pytest.raises(ShaderError, match=r"lib/mine\.glsl:3: "):
        call("lib/mine.glsl", "f", X, shaders=folder, half=True)


def test_every_file_is_halved_on_its_own_lines() -> None:
    """Each function of the shader folder is still there, rounding what it returns."""
    found = library()
    names = {f.setting: f.default for f in found.folders.values()}
    values = {n: 0.0 for file in found.files.values() for n in file.meta.parameters}
    values |= {**UNTRACED, "draws_objects": 1.0, "orthographic": 0.0, "signed": 0.0}
    values |= dict(scene_defines(Scene(materials={}, objects={}), 0))
    lamp = {"index": "0", "point": "1", "directional": "0", "spot": "0", "positional": "1"}
    lists = light_lists((tuple({**lamp, "casts": "1", "cube": "1"}.items()),))
    lists |= dict.fromkeys(UNTRACED_LISTS, ())
    for path, file in found.files.items():
        if path.startswith("passes/") or path == "lib/screen.glsl":
            continue
        text = assemble(found, Request(path, "FRAGMENT", names, values, lists)).text
        after = halved(text)
        assert after.count("\n") == text.count("\n")
        for name in file.functions:
            assert (f" {name}(" in after) == (f" {name}(" in text)
        floats = text.count("return ")
        assert after.count(f"return {HALF}(") <= floats
