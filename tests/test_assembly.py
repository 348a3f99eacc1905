"""The expression language and the assembler, on the cases that web/tests runs on their twins."""

import json
from collections.abc import Mapping
from typing import Any

import pytest

from lightbench.assemble import Request, assemble
from lightbench.errors import LightbenchError, ShaderError
from lightbench.expression import evaluate
from lightbench.library import Library
from lightbench.shader_log import explain
from tests.support import ROOT

FIXTURES = ROOT / "tests" / "fixtures"
EXPRESSIONS = json.loads((FIXTURES / "expressions.json").read_text())
ASSEMBLY = json.loads((FIXTURES / "assembly.json").read_text())
VERSION = ["#version 300 es", "precision highp float;", "precision highp int;"]


def by_name(case: Mapping[str, Any]) -> str:
    return str(case["name"])


def library(case: Mapping[str, Any]) -> Library:
    """The library of a case; a file is its lines, or its front matter with `code`."""
    files = {}
    for path, given in case["files"].items():
        meta = dict(given) if isinstance(given, dict) else {"code": given}
        code, functions = "\n".join(meta.pop("code")), meta.pop("functions", {})
        files[path] = {"meta": meta, "code": code, "functions": functions}
    folders = {
        name: {"title": "", "default": "", **folder}
        for name, folder in case.get("folders", {}).items()
    }
    return Library.model_validate_json(json.dumps({"folders": folders, "files": files}))


def request(case: Mapping[str, Any]) -> Request:
    given = {"entry": "passes/p.glsl", "stage": "FRAGMENT", "choices": {}, "values": {}}
    return Request(**{**given, **case.get("request", {})})


@pytest.mark.parametrize("case", EXPRESSIONS, ids=lambda case: case["text"] or "nothing")
def test_expression(case: Mapping[str, Any]) -> None:
    names = case.get("names", {})
    if "error" in case:
        with pytest.raises(LightbenchError) as caught:
            evaluate(case["text"], names)
        assert str(caught.value) == case["error"]
    else:
        assert evaluate(case["text"], names) == case["value"]


@pytest.mark.parametrize("case", [c for c in ASSEMBLY["cases"] if "error" not in c], ids=by_name)
def test_assembled(case: Mapping[str, Any]) -> None:
    source = assemble(library(case), request(case))
    prologue = [*VERSION, *case.get("prologue", [])]
    assert source.text.split("\n") == [
        *prologue,
        *(line for _, line in case["body"] or [("", "")]),
        "",
    ]
    numbers = [f"prologue:{number}" for number in range(1, len(prologue) + 1)]
    assert list(source.lines) == [*numbers, *(where for where, _ in case["body"])]
    assert list(source.settings) == case.get("settings", [])
    assert source.uniforms == case.get("uniforms", {})
    assert source.attributes == case.get("attributes", {})
    if "used" in case:
        assert list(source.files) == case["used"]


@pytest.mark.parametrize("case", [c for c in ASSEMBLY["cases"] if "error" in c], ids=by_name)
def test_refused(case: Mapping[str, Any]) -> None:
    with pytest.raises(ShaderError) as caught:
        assemble(library(case), request(case))
    assert str(caught.value) == case["error"]


@pytest.mark.parametrize("case", ASSEMBLY["logs"], ids=by_name)
def test_explained(case: Mapping[str, Any]) -> None:
    assert explain(case["log"], case["text"], case["lines"]) == case["explained"]
