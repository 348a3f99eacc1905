"""One plan: plan.ts answers as plan.py does, for presets, random settings and mistakes."""

import json
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from lightbench.errors import LightbenchError
from lightbench.library import Library, read_library
from lightbench.options import manifest
from lightbench.plan import plan
from lightbench.schema import schema
from tests.plan_cases import (
    SIZE,
    Case,
    crowds,
    library_cases,
    part_cases,
    random_cases,
    random_scene_cases,
    scenes,
)
from tests.plan_mistakes import mistakes
from tests.support import ROOT, SCENES, alternatives, copy_of_shaders, library, presets


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


def in_browser(menu: Library, cases: Sequence[Case]) -> list[dict[str, Any]]:
    """What the TypeScript planner answers, one node process for all cases."""
    request = {
        "manifest": manifest(menu, SCENES),
        "scenes": {name: scene.data() for name, scene in scenes().items()},
        "cases": cases,
    }
    answers: list[dict[str, Any]] = json.loads(node("plans.mjs", data=request))
    return answers


def offline(menu: Library, case: Case) -> dict[str, Any]:
    name, settings, size, *attachment = case
    try:
        return {"plan": plan(menu, scenes()[name], settings, size, *attachment)}
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


def check(menu: Library, cases: Sequence[Case], kind: str = "plan") -> None:
    """Both sides answer alike, and with a plan or an error as `kind` says."""
    expected = [json.loads(json.dumps(offline(menu, case))) for case in cases]
    answers = in_browser(menu, cases)
    for case, ours, theirs in zip(cases, expected, answers, strict=True):
        assert kind in ours, (case, ours)
        assert difference(ours, theirs) is None, (case, difference(ours, theirs))


def every_choice() -> Iterator[Case]:
    for name in presets():
        yield name, {}, SIZE
        # The lab's scenes differ in what there is, not in what may be chosen: one stands for all.
        if not name.startswith("lab/") or name == "lab/reflectance2":
            for settings in alternatives():
                yield name, dict(settings), SIZE


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
    reads: list[str], writes: str, *, when: str = "", scale: str = "1", code: str = ""
) -> str:
    """A pass over the screen that samples all it reads."""
    samples = " + ".join(f"texelFetch(u_{read}, ivec2(0), 0)" for read in reads)
    main = f"out vec4 o;\nvoid main() {{ o = {samples or 'vec4(0.0)'}; }}"
    return SCREEN.format(reads=reads, writes=writes, when=when, scale=scale, code=code or main)


def test_every_choice() -> None:
    check(library(), list(every_choice()))


def test_every_choice_of_rays() -> None:
    """Objects by name and of a list, images in arrays, meshes in tables."""
    rays = {"technique": "whitted", "shadow": "ray"}
    check(library(), [("normal-maps", {**rays, **own}, SIZE) for own in alternatives()])
    check(library(), [(name, rays, SIZE) for name in ("model-room", "toon-garden", "box-room")])


def test_trees_of_many_objects() -> None:
    """Where centres, sizes and distances are alike, too."""
    check(library(), [(name, {"camera.fov": 40}, SIZE) for name in crowds()])


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
        "one": screen(["linear"], "linear", code="uniform float u_mystery;\nu_mystery + u_linear;")
    },
    "an undefined name": {"one": screen(["linear"], "linear", code="#if MYSTERY\n#endif")},
}


@pytest.mark.parametrize("case", BROKEN)
def test_broken_passes(tmp_path: Path, case: str) -> None:
    files = {f"passes/{name}.glsl": text for name, text in BROKEN[case].items()}
    check(read_library(copy_of_shaders(tmp_path, files)), [("box-room", {}, SIZE)], "error")


def test_random_settings() -> None:
    check(library(), list(random_cases()))


def test_random_scenes() -> None:
    """Maps, meshes, transparency: a plan needs no asset, only its name."""
    check(library(), list(random_scene_cases()))


def test_parts() -> None:
    """Hanging on one another in any order, edited in any spelling."""
    check(library(), list(part_cases()))


def test_a_mesh_left_for_a_shape() -> None:
    """As every field that may be null, `mesh` is so as "auto" too: a link has no null."""
    name, there = next((n, s) for n, s in scenes().items() if s.meshes)
    thing = next(n for n, o in there.objects.items() if o.mesh is not None)
    settings = [
        {f"objects.{thing}.shape": "cube", f"objects.{thing}.mesh": m} for m in ("auto", None)
    ]
    check(library(), [(name, edits, SIZE) for edits in settings])


def with_attachments(*names: str) -> list[Case]:
    settings = {"shadow": "hard", "outline": "sobel", "lights.lamp.casts": False}
    return [("box-room", settings, SIZE, name) for name in names]


def test_attachments() -> None:
    names = ("linear", "display", "radiance", "normal_distance", "shadow_map.1", "shadow_map.2")
    check(library(), with_attachments(*names))
    check(library(), [("box-room", {}, SIZE, "shadow_map.0")])


def test_missing_attachments() -> None:
    names = ("nothing", "radiance.0", "shadow_map", "shadow_map.0", "shadow_map.9", "")
    check(library(), with_attachments(*names), "error")


def test_more_maps_than_texture_units() -> None:
    check(library(), [("crowd", {"shadow": "hard"}, SIZE)], "error")


def test_library_materials() -> None:
    check(library(), list(library_cases()))


def test_mistakes() -> None:
    check(library(), list(mistakes()), "error")


def test_types() -> None:
    """web/src/core/types.ts is what the Python models say."""
    node("types.mjs", "--check", data=schema())
