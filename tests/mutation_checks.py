"""Whether anything notices a broken shader: the tests themselves, run on a folder that holds it.

Every case of the formula and law tests, and of those of whole pictures, is a check. Which files a
check reads is noted when it passes, so that it is not asked again about one that it never sees.
"""

from __future__ import annotations

import importlib
import inspect
import itertools
import os
import re
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from lightbench import glsl, library
from lightbench.assemble import Source
from lightbench.golden import Golden
from tests import (
    functions,
    support,
    test_bvh,
    test_extreme_surfaces,
    test_extremes,
    test_formulas,
    test_fresnels,
    test_golden,
    test_guards,
    test_lab_scenes,
    test_laws,
    test_limits,
    test_listed,
    test_opacity,
    test_outlines,
    test_parts,
    test_quantisation,
    test_ray_images,
    test_ray_shapes,
    test_scene,
    test_shadows,
    test_sphere_tree,
    test_surface_maps,
    test_textbook,
    test_toon,
    test_views,
    test_whitted,
)
from tests.mutations import Mutant

# How a test says that it failed; numpy's warnings are errors in this project's runs.
FAILURES = (AssertionError, RuntimeWarning, pytest.fail.Exception)
# Tests that say nothing of the shaders, or that break them on purpose.
LEFT_OUT = ("test_a_broken_shader_is_noticed", "test_every_golden_has_its_render")


@dataclass(frozen=True)
class Check:
    """One case of a test."""

    name: str
    run: Callable[[Path, pytest.MonkeyPatch], None]

    @property
    def test(self) -> str:
        """The test's name alone, `module.function`."""
        return self.name.partition("[")[0]


def cases(module: ModuleType, only: Sequence[str] = ()) -> Iterator[Check]:
    """Every case of a module's tests, or of those named."""
    for name, test in vars(module).items():
        if not name.startswith("test_") or test.__module__ != module.__name__ or name in LEFT_OUT:
            continue
        if only and name not in only:
            continue
        marks = [m for m in getattr(test, "pytestmark", ()) if m.name == "parametrize"]
        for given in itertools.product(*(list(parameters(mark)) for mark in marks)):
            arguments = {name: value for _, part in given for name, value in part.items()}
            label = f"{module.__name__.removeprefix('tests.')}.{name}"
            shown = "-".join(shown for shown, _ in given)
            yield Check(f"{label}[{shown}]" if given else label, runner(test, arguments))


def parameters(mark: pytest.Mark) -> Iterator[tuple[str, dict[str, Any]]]:
    """What to call each set of arguments that a mark gives, and the arguments by name."""
    names = mark.args[0]
    names = [n.strip() for n in names.split(",")] if isinstance(names, str) else list(names)
    label = mark.kwargs.get("ids")
    for values in mark.args[1]:
        every = (values,) if len(names) == 1 else values
        shown = label(values) if callable(label) else "-".join(map(str, every))
        yield shown, dict(zip(names, every, strict=True))


def runner(
    test: Callable[..., None], arguments: dict[str, Any]
) -> Callable[[Path, pytest.MonkeyPatch], None]:
    """The case as a function of the folder that its fixtures may write to."""
    fixtures = set(inspect.signature(test).parameters) - set(arguments)

    def run(folder: Path, patch: pytest.MonkeyPatch) -> None:
        given = dict(arguments)
        if "tmp_path" in fixtures:
            given["tmp_path"] = folder
        if "monkeypatch" in fixtures:
            given["monkeypatch"] = patch
        if "golden" in fixtures:
            given["golden"] = Golden(support.GOLDEN, "mutation", "picture")
        if "note" in fixtures:
            given["note"] = lambda line: None
        test(**given)

    return run


FORMULAS = [
    check
    for module in (
        test_formulas,
        test_fresnels,
        test_guards,
        test_limits,
        test_quantisation,
        test_ray_shapes,
        test_textbook,
        test_toon,
    )
    for check in cases(module)
]
LAWS = list(cases(test_laws))
PICTURES = [
    *cases(test_golden, ["test_golden"]),
    *(
        check
        for module in (test_views, test_surface_maps, test_opacity, test_outlines, test_shadows)
        for check in cases(module)
    ),
    *cases(test_extreme_surfaces),
    *cases(test_parts, test_parts.PICTURES),
    *cases(test_bvh, test_bvh.TRACED),
    *cases(test_lab_scenes),
    *cases(test_whitted),
    *cases(test_sphere_tree, test_sphere_tree.TRACED),
    *cases(test_listed),
    *cases(test_ray_images),
    *cases(test_scene, test_extremes.SCENE_LAWS),
    *cases(test_extremes, test_extremes.IMAGE_LAWS),
]


def with_code(text: str, code: str) -> str:
    """A shader file with its front matter kept and its code, of as many lines, replaced."""
    front = re.match(r"\s*/\*---.*?---\*/", text, re.DOTALL)
    head = front[0] if front else ""
    return head + "\n".join(code.split("\n")[head.count("\n") :])


@dataclass
class Workbench:
    """A copy of the shader folder in `root`, in which one file at a time is broken."""

    root: Path
    files: dict[str, frozenset[str]] = field(default_factory=dict)
    count: int = 0

    def __post_init__(self) -> None:
        self.shaders = support.copy_of_shaders(self.root, {})

    def caught(self, mutant: Mutant, checks: Sequence[Check]) -> str | None:
        """The first check that fails on the mutant: those of its own file, then those given first.

        Raises ShaderError where the mutant does not compile.
        """
        target = self.shaders / mutant.path
        original = target.read_text()
        self.write(target, with_code(original, mutant.code))
        try:
            return next((c.name for c in self.ordered(mutant, checks) if self.fails(c)), None)
        finally:
            self.write(target, original)

    def write(self, target: Path, text: str) -> None:
        """A library is read anew when a file's time has changed, which two quick writes share."""
        self.count += 1
        target.write_text(text)
        os.utime(target, ns=(self.count, self.count))
        library._read_library.cache_clear()

    def ordered(self, mutant: Mutant, checks: Sequence[Check]) -> list[Check]:
        """Without those that passed without reading the file; what is named for it comes first."""
        seen = [c for c in checks if mutant.path in self.files.get(c.name, {mutant.path})]
        named = {test for (path, _), test in functions.ELSEWHERE.items() if path == mutant.path}
        return sorted(seen, key=lambda c: (mutant.path not in c.name, c.test not in named))

    def fails(self, check: Check) -> bool:
        """Run a check on the folder as it is now, and note which of its files it reads."""
        read: set[str] = set()
        with (
            tempfile.TemporaryDirectory(dir=self.root) as folder,
            pytest.MonkeyPatch.context() as patch,
        ):
            patch.setenv("LIGHTBENCH_SHADERS", str(self.shaders))
            patch.setattr(support, "SHADERS", self.shaders)
            for owner, name in READERS:
                patch.setattr(owner, name, noting(getattr(owner, name), read))
            try:
                check.run(Path(folder), patch)
            except FAILURES:
                return True
        self.files[check.name] = frozenset(read)
        return False


# What turns files into sources, for one function and for a picture.
READERS = (
    (glsl, "assemble"),
    (importlib.import_module("lightbench.batches"), "_assembled"),
)


def noting(assemble: Callable[..., Source], read: set[str]) -> Callable[..., Source]:
    """The same, adding the files of each source to `read`."""

    def noted(*given: Any) -> Source:
        source = assemble(*given)
        read.update(source.files)
        return source

    return noted
