"""One plan: plan.ts answers as plan.py does, for presets, random settings and mistakes."""

import json
import random
import subprocess
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import lightbench as lb
from lightbench.errors import LightbenchError
from lightbench.library import Library, Parameter, read_library
from lightbench.options import manifest
from lightbench.plan import plan
from lightbench.scene import Scene
from lightbench.schema import schema
from tests.support import ROOT, SCENES, alternatives, copy_of_shaders, library, presets

Case = tuple[str, dict[str, Any], tuple[int, int]]
SIZE = (64, 48)
RANDOM_CASES = 200

# Each is refused, by both sides in the same words.
MISTAKES: list[dict[str, Any]] = [
    {"model": "fong"},
    {"model": 3},
    {"model": None},
    {"modle": "phong"},
    {"samples": 0},
    {"samples": 1.5},
    {"samples": "two"},
    {"samples": True},
    {"sphere_error": 1e-7},
    {"exposure": "nan"},
    {"ambient_color": "#12345"},
    {"ambient_color": [1, 2]},
    {"ambient_color": [1, 2, -3]},
    {"camera.fov": 0.5},
    {"camera.fov": 171.25},
    {"camera.fov": "wide"},
    {"camera.fov": "nan"},
    {"camera.fov": None},
    {"camera.fov": [1]},
    {"camera.eye": "1,2"},
    {"camera.eye": "1,2,x"},
    {"camera.eye": [1, 2]},
    {"camera.eye": [1, 2, 3, 4]},
    {"camera.eye": [1, 2, 1e7]},
    {"camera.eye": "1,2,1e7"},
    {"camera.eye": 5},
    {"camera.eye": [0, 0, 0], "camera.target": [0, 0, 0]},
    {"camera.lens": 5},
    {"camera.eye.x": 5},
    {"camera": 5},
    {".": 5},
    {"lights.nobody.intensity": 1},
    {"lights.LIGHT.intensity": -1},
    {"lights.LIGHT.intensity": 1e31},
    {"lights.LIGHT.intensity": "inf"},
    {"lights.LIGHT.color": "#ff000g"},
    {"lights.LIGHT.color": [0, 0.5, 2]},
    {"lights.LIGHT.type": "area"},
    {"lights.LIGHT.unit": "lux"},
    {"lights.LIGHT.zork": 1},
    {"lights.LIGHT.zork": "x"},
    {"lights.LIGHT.c0": -1},
    {"lights.LIGHT": 5},
    {"materials.MATERIAL.roughness": 2},
    {"materials.MATERIAL.gloss": 1},
    {"materials.MATERIAL.f0": 3},
    {"materials.MATERIAL.f0": [1, 1, 1], "materials.MATERIAL.ior": 1.5},
    {"materials.MATERIAL.ior": "glass"},
    {"materials.MATERIAL.ks": [1, 2, -3]},
    {"materials.MATERIAL": 5},
    {"objects.OBJECT.material": "nothing"},
    {"objects.OBJECT.material": "Nothing"},
    {"objects.OBJECT.material": 3},
    {"objects.OBJECT.shape": "torus"},
    {"objects.OBJECT.stacks": 0},
    {"objects.OBJECT.stacks": 16.5},
    {"objects.OBJECT.stacks": "16.5"},
    {"objects.OBJECT.stacks": 257},
    {"objects.OBJECT.scale": 0},
    {"objects.OBJECT.scale": "x"},
    {"objects.OBJECT.rotation": "0,0,400"},
    {"background.color": 1},
]


@cache
def scene(name: str) -> Scene:
    return lb.load(name)


def node(script: str, *arguments: str, data: Any) -> str:
    """What a script of web/scripts prints, given JSON on its standard input."""
    done = subprocess.run(
        ["node", f"scripts/{script}", *arguments],
        cwd=ROOT / "web",
        input=json.dumps(data),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def in_browser(menu: Library, cases: list[Case]) -> list[dict[str, Any]]:
    """What the TypeScript planner answers, one node process for all cases."""
    request = {
        "manifest": manifest(menu, SCENES),
        "scenes": {name: scene(name).data() for name in presets()},
        "cases": cases,
    }
    answers: list[dict[str, Any]] = json.loads(node("plans.mjs", data=request))
    return answers


def offline(menu: Library, case: Case) -> dict[str, Any]:
    name, settings, size = case
    try:
        return {"plan": plan(menu, scene(name), settings, size)}
    except LightbenchError as error:
        return {"error": [type(error).__name__, str(error)]}


def difference(ours: Any, theirs: Any, path: str = "plan") -> str | None:
    """Where two JSON values first differ; numbers are equal or they are not."""
    if isinstance(ours, dict) and isinstance(theirs, dict):
        if ours.keys() != theirs.keys():
            return f"{path}: {sorted(ours)} and {sorted(theirs)}"
        pairs = [(f"{path}.{key}", ours[key], theirs[key]) for key in ours]
    elif isinstance(ours, list) and isinstance(theirs, list):
        if len(ours) != len(theirs):
            return f"{path}: {len(ours)} and {len(theirs)} items"
        pairs = [(f"{path}[{i}]", a, b) for i, (a, b) in enumerate(zip(ours, theirs, strict=True))]
    else:
        return None if ours == theirs else f"{path}: {ours!r} and {theirs!r}"
    return next((found for p, a, b in pairs if (found := difference(a, b, p))), None)


def check(menu: Library, cases: list[Case], kind: str = "plan") -> None:
    """Both sides answer alike, and with a plan or an error as `kind` says."""
    expected = [json.loads(json.dumps(offline(menu, case))) for case in cases]
    answers = in_browser(menu, cases)
    for case, ours, theirs in zip(cases, expected, answers, strict=True):
        assert kind in ours, (case, ours)
        assert difference(ours, theirs) is None, (case, difference(ours, theirs))


def every_choice() -> Iterator[Case]:
    for name in presets():
        yield name, {}, SIZE
        for settings in alternatives():
            yield name, settings, SIZE


def number(chance: random.Random, parameter: Parameter) -> Any:
    low, high = parameter.range or (0.0, 1.0)
    return (
        chance.randint(int(low), int(high))
        if parameter.kind == "int"
        else chance.uniform(low, high)
    )


def color(chance: random.Random) -> Any:
    if chance.random() < 0.5:
        return f"#{chance.randrange(1 << 24):06x}"
    return [chance.random() for _ in range(3)]


def menu_settings(chance: random.Random) -> dict[str, Any]:
    """A choice of every folder, and a few parameters."""
    menu = library()
    chosen = {f.setting: chance.choice(menu.choices(name)) for name, f in menu.folders.items()}
    known = {k: p for file in menu.files.values() for k, p in file.meta.parameters.items()}
    for name in chance.sample(sorted(known), k=min(4, len(known))):
        parameter = known[name]
        if parameter.kind in ("float", "int"):
            chosen[name] = number(chance, parameter)
        elif parameter.kind == "bool":
            chosen[name] = chance.choice(["true", "false"])
        else:
            chosen[name] = color(chance)
    return chosen


def vector(chance: random.Random, reach: float) -> Any:
    values = [chance.uniform(-reach, reach) for _ in range(3)]
    return values if chance.random() < 0.5 else ",".join(map(repr, values))


def angles(chance: random.Random) -> list[float]:
    """Round angles too: their sines cancel."""
    return [chance.choice([0, 30, 45, 60, 90, 180, chance.uniform(-360, 360)]) for _ in range(3)]


def scene_settings(chance: random.Random, there: Scene) -> dict[str, Any]:
    """Edits of the camera and of one of each kind of thing."""
    edits: dict[str, Any] = {}
    if chance.random() < 0.7:
        edits["camera.eye"] = vector(chance, 10)
        edits["camera.fov"] = chance.uniform(1, 170)
    for name, light in there.lights.items():
        edits[f"lights.{name}.intensity"] = chance.uniform(0, 1000)
        edits[f"lights.{name}.color"] = color(chance)
        if light.type == "point":
            edits[f"lights.{name}.type"] = chance.choice(["point", "spot"])
        if light.type != "directional":
            edits[f"lights.{name}.unit"] = chance.choice(["candela", "lumen"])
    name = chance.choice(sorted(there.materials))
    edits[f"materials.{name}.roughness"] = chance.random()
    edits[f"materials.{name}.metalness"] = str(chance.random())
    edits[f"materials.{name}.base_color"] = color(chance)
    edits[f"materials.{name}.shininess"] = chance.choice([None, "auto", chance.uniform(0, 1e4)])
    name = chance.choice(sorted(there.objects))
    edits[f"objects.{name}.rotation"] = angles(chance)
    edits[f"objects.{name}.scale"] = chance.choice(["2", chance.uniform(0.1, 5), "1,2,0.5"])
    edits[f"objects.{name}.shape"] = chance.choice(["plane", "cube", "sphere", "cone"])
    return edits


def random_cases() -> Iterator[Case]:
    chance = random.Random(20240229)
    for _ in range(RANDOM_CASES):
        name = chance.choice(presets())
        settings = {**menu_settings(chance), **scene_settings(chance, scene(name))}
        yield name, settings, (chance.randint(1, 2000), chance.randint(1, 2000))


def mistakes() -> Iterator[Case]:
    """MISTAKES, with names of a scene put in."""
    there = scene("box-room")
    names = {
        "LIGHT": next(iter(there.lights)),
        "MATERIAL": next(iter(there.materials)),
        "OBJECT": next(iter(there.objects)),
    }
    for settings in MISTAKES:
        yield (
            "box-room",
            {".".join(names.get(p, p) for p in k.split(".")): v for k, v in settings.items()},
            SIZE,
        )
    yield "box-room", {}, (0, 1)
    yield "box-room", {}, (1, 20000)


SCREEN = """/*---
title = "Made for a test"
draw  = "screen"
reads = {reads}
when  = "{when}"
[writes.{writes}]
format = "rgba16f"
scale  = "{scale}"
---*/
#include "lib/screen.glsl"
#if FRAGMENT
{code}
#endif
"""


def screen(
    reads: list[str], writes: str, *, when: str = "1", scale: str = "1", code: str = ""
) -> str:
    """A pass over the screen that samples all it reads."""
    samples = " + ".join(f"texelFetch(u_{read}, ivec2(0), 0)" for read in reads)
    main = f"out vec4 o;\nvoid main() {{ o = {samples or 'vec4(0.0)'}; }}"
    return SCREEN.format(reads=reads, writes=writes, when=when, scale=scale, code=code or main)


def test_every_choice() -> None:
    check(library(), list(every_choice()))


def test_other_passes(tmp_path: Path) -> None:
    """Refined targets, targets of another size, passes left out."""
    files = {
        "passes/glow.glsl": screen(["linear", "half"], "linear", when="samples > 1"),
        "passes/half.glsl": screen(["radiance"], "half", scale="0.5"),
        "passes/last.glsl": screen(["display", "linear"], "display", when="model == 'phong'"),
        "passes/unread.glsl": screen(["half"], "nobody"),
    }
    menu = read_library(copy_of_shaders(tmp_path, files))
    choices: list[dict[str, Any]] = [{}, {"samples": 2}, {"samples": 3, "model": "phong"}]
    check(menu, [("box-room", settings, (5, 7)) for settings in choices])


BROKEN = {
    "two writers": {"two": screen([], "display")},
    "a circle": {
        "one": screen(["b"], "a"),
        "two": screen(["a"], "b"),
        "three": screen(["linear", "a"], "linear"),
    },
    "nothing to read": {"one": screen(["linear", "nothing"], "linear")},
    "an unknown uniform": {
        "one": screen(["linear"], "linear", code="uniform float u_mystery;\nu_linear;")
    },
    "an undefined name": {"one": screen(["linear"], "linear", code="#if MYSTERY\n#endif")},
}


@pytest.mark.parametrize("case", BROKEN)
def test_broken_passes(tmp_path: Path, case: str) -> None:
    files = {f"passes/{name}.glsl": text for name, text in BROKEN[case].items()}
    check(read_library(copy_of_shaders(tmp_path, files)), [("box-room", {}, SIZE)], "error")


def test_random_settings() -> None:
    check(library(), list(random_cases()))


def test_mistakes() -> None:
    check(library(), list(mistakes()), "error")


def test_types() -> None:
    """web/src/core/types.ts is what the Python models say."""
    node("types.mjs", "--check", data=schema())
