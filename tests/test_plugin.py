"""The pytest plugin as another project sees it: what it loads, its options, its fixture `glsl`."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import lightbench as lb
from lightbench.glsl import call
from lightbench.library import read_library
from lightbench.plan import plan
from tests.projects import add_shaders, run
from tests.support import ROOT, copy_of_shaders

pytest_plugins = "pytester"


@pytest.fixture
def project(pytester: pytest.Pytester) -> pytest.Pytester:
    add_shaders(pytester)
    return pytester


def refused(project: pytest.Pytester, body: str) -> str:
    project.makepyfile(f"def test_it(glsl):\n    {body}\n")
    result = run(project)
    result.assert_outcomes(failed=1)
    return result.stdout.str()


def test_loading_it_costs_nothing(project: pytest.Pytester) -> None:
    """A run that asks for no fixture of ours imports nothing of ours but the plugin."""
    project.makepyfile(
        "import sys\n"
        "def test_it():\n"
        "    assert 'pytest_lightbench' in sys.modules\n"
        "    assert not {'lightbench', 'moderngl', 'PIL', 'OpenEXR'} & set(sys.modules)\n"
    )
    project.runpytest_subprocess("-W", "error").assert_outcomes(passed=1)


def test_importing_it_alone() -> None:
    code = "import pytest_lightbench, sys; print({'lightbench', 'moderngl'} & set(sys.modules))"
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert made.stdout.strip() == "set()"


@pytest.mark.parametrize(
    ("option", "given", "value"),
    [("action='store_true'", ["--update-goldens"], True), ("default='all'", [], "all")],
)
def test_an_option_of_the_same_name(
    project: pytest.Pytester, option: str, given: list[str], value: object
) -> None:
    """A project that has its own --update-goldens and fixture `golden` keeps them."""
    project.makeconftest(
        "import pytest\n"
        "def pytest_addoption(parser):\n"
        f"    parser.addoption('--update-goldens', {option})\n"
        "@pytest.fixture\n"
        "def golden(request):\n"
        "    return request.config.getoption('--update-goldens')\n"
    )
    project.makepyfile(f"def test_it(golden):\n    assert golden == {value!r}\n")
    run(project, *given).assert_outcomes(passed=1)


def test_glsl_in_a_folder_that_is_not_ours(project: pytest.Pytester) -> None:
    project.makepyfile(
        "import numpy as np\n"
        "from colorsys import hsv_to_rgb\n"
        "def test_it(glsl):\n"
        "    hue = np.linspace(0, 1, 50)\n"
        "    rgb = glsl('hue.glsl', 'hueToRgb', hue)\n"
        "    assert np.allclose(rgb, [hsv_to_rgb(h, 1, 1) for h in hue], atol=1e-5)\n"
        "    assert glsl('math/unit.glsl', 'unit', [[-1, 0.5, 2]]).tolist() == [[0, 0.5, 1]]\n"
    )
    run(project).assert_outcomes(passed=1)


def test_glsl_in_the_built_in_folder(project: pytest.Pytester) -> None:
    project.makeini("[pytest]\n")
    project.makepyfile(
        "def test_it(glsl):\n"
        "    assert glsl('tonemaps/none.glsl', 'tonemap', [[1, 2, 3]]).tolist() == [[1, 2, 3]]\n"
    )
    run(project).assert_outcomes(passed=1)


def test_plain_files_beside_choices(tmp_path: Path) -> None:
    """A file in the root, or in a folder that is no menu, is there to be called and included."""
    code = "float twice(float x) { return 2.0 * x; }\n"
    root = copy_of_shaders(tmp_path, {"twice.glsl": code})
    (root / "more").mkdir()
    (root / "more" / "twice.glsl").write_text(code)
    for file in ("twice.glsl", "more/twice.glsl"):
        assert call(file, "twice", [1.0, 2.0], shaders=root).tolist() == [2.0, 4.0]
    assert plan(read_library(root), lb.load("box-room"), {}, (8, 8))["passes"]


@pytest.mark.parametrize(
    ("line", "what"),
    [
        (
            "glsl('hui.glsl', 'x')",
            "no shader file 'hui.glsl'; there is: hue.glsl, math/unit.glsl, pa",
        ),
        ("glsl('hue.glsl', 'x')", "hue.glsl: no function 'x'; there is: hueToRgb"),
        ("glsl('hue.glsl', 'hueToRgb')", "hueToRgb takes 1 arrays: float"),
        ("glsl('hue.glsl', 'hueToRgb', [[1, 2]])", "argument 0: a float is (N,), not (1, 2)"),
    ],
)
def test_a_wrong_call(project: pytest.Pytester, line: str, what: str) -> None:
    assert what in refused(project, line)


@pytest.mark.parametrize(
    ("code", "what"),
    [
        ("float f(float x) {\n    return y;\n}", "bad.glsl:2: error: `y' undeclared"),
        ("#ifdef A\n#endif\nfloat f(float x) { return x; }", "bad.glsl:1: #ifdef has no place"),
        ('#include "no.glsl"\nfloat f(float x) { return x; }', "bad.glsl:1: no such file"),
        ("uniform float k;\nfloat f(float x) { return k; }", "uniform k has no value"),
        ("uniform float u_k;\nfloat f(float x) { return u_k; }", "uniform u_k has no value"),
        ("float f(float \u00e9) { return 1.0; }", "bad.glsl:1: shader files are ASCII"),
    ],
)
def test_a_wrong_shader(project: pytest.Pytester, code: str, what: str) -> None:
    (project.path / "shaders" / "bad.glsl").write_text(code, encoding="utf-8")
    assert what in refused(project, "glsl('bad.glsl', 'f', 1.0)")


def test_the_example_of_the_readme(pytester: pytest.Pytester) -> None:
    section = (ROOT / "README.md").read_text().split("### In your own tests")[1].split("\n## ")[0]
    blocks = re.findall(r"```\w+\n(?://|#) (\S+)\n(.*?)```", section, re.DOTALL)
    for path, text in blocks:
        target = pytester.path / path
        target.parent.mkdir(exist_ok=True)
        target.write_text(text)
    assert {path for path, _ in blocks} == {"shaders/hue.glsl", "pytest.ini", "test_hue.py"}
    run(pytester).assert_outcomes(failed=1)
    run(pytester, "--update-goldens").assert_outcomes(passed=1)
    run(pytester).assert_outcomes(passed=1)
    golden = pytester.path / "goldens" / "test_hue.test_hue.npy"
    assert f"`goldens/{golden.name}`" in section
    assert np.load(golden).shape == (32, 256, 3)
    lines = [x for _, text in blocks for x in text.splitlines() if x.strip()]
    assert len(lines) <= 12
