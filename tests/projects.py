"""Another project, with shaders of its own, whose tests run within a test of ours."""

import flip_evaluator
import pytest
from PIL import PngImagePlugin

# Loaded before the runs within this process, each of which forgets what it loaded itself.
LOADED = (flip_evaluator, PngImagePlugin)
# Plugins that those runs do without: one loads Hypothesis anew each time, one leaves a folder.
FEWER = ("-p", "no:hypothesispytest", "-p", "no:cacheprovider")

HUE = """// \u00a9 a comment that is not ASCII
#include "math/unit.glsl"
vec3 hueToRgb(float hue) {
    return unit(abs(mod(6.0 * hue + vec3(0.0, 4.0, 2.0), 6.0) - 3.0) - 1.0);
}
"""
UNIT = "vec3 unit(vec3 x) { return clamp(x, 0.0, 1.0); }\n"


def run(project: pytest.Pytester, *options: str) -> pytest.RunResult:
    """Run the project's tests in this process."""
    return project.runpytest_inprocess(*FEWER, *options)


def add_shaders(project: pytest.Pytester) -> None:
    """A folder of shaders without any choice, and the ini file that names it."""
    for path, text in (("hue.glsl", HUE), ("math/unit.glsl", UNIT), ("passes/blur.glsl", UNIT)):
        target = project.path / "shaders" / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    project.makeini("[pytest]\nlightbench_shaders = shaders\n")
