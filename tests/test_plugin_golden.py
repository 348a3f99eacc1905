"""The pytest plugin's fixture `golden` and its report, as another project sees them."""

import re

import pytest

from lightbench.golden import safe_name
from tests.projects import FEWER, add_shaders, run

pytest_plugins = "pytester"

PICTURE = """
import numpy as np
def test_picture(golden):
    codes = np.arange(192, dtype=np.uint8).reshape(8, 8, 3)
    golden({picture}, {arguments})
"""


@pytest.fixture
def project(pytester: pytest.Pytester) -> pytest.Pytester:
    add_shaders(pytester)
    return pytester


def picture(project: pytest.Pytester, picture: str = "codes", arguments: str = "") -> None:
    project.makepyfile(test_it=PICTURE.format(picture=picture, arguments=arguments))


@pytest.mark.parametrize(
    ("value", "ending"), [("codes", ".png"), ("codes / np.float32(64)", ".npy")]
)
def test_missing_stored_compared(project: pytest.Pytester, value: str, ending: str) -> None:
    picture(project, value)
    path = project.path / "goldens" / f"test_it.test_picture{ending}"
    missing = run(project)
    missing.assert_outcomes(failed=1)
    missing.stdout.fnmatch_lines([f"*no golden {path}; look at the picture, then keep it with: *"])
    assert not path.exists()

    stored = run(project, "--update-goldens")
    stored.assert_outcomes(passed=1)
    stored.stdout.fnmatch_lines([f"golden written: {path}"])
    assert [p.name for p in path.parent.iterdir()] == [path.name]

    before = path.stat().st_mtime_ns
    run(project).assert_outcomes(passed=1)
    run(project, "--update-goldens").assert_outcomes(passed=1)
    assert path.stat().st_mtime_ns == before


def test_an_image_is_its_display_codes(project: pytest.Pytester) -> None:
    image = "Image(codes / np.float32(64), codes, 0.0, 'the renderer')"
    project.makepyfile("from lightbench import Image" + PICTURE.format(picture=image, arguments=""))
    run(project, "--update-goldens").assert_outcomes(passed=1)
    assert [p.suffix for p in (project.path / "goldens").iterdir()] == [".png"]


@pytest.mark.parametrize(
    ("changed", "limits", "passes"),
    [
        ("codes + np.uint8(1)", "", True),
        ("codes + np.uint8(2)", "", False),
        ("codes + np.uint8(2)", "tolerance=2", True),
        ("codes + np.uint8(1)", "flip_mean=1e-4", False),
        ("codes + np.uint8(1)", "flip_p99=1e-4", False),
        ("codes + np.uint8(1)", "relmse=1e-9", False),
        ("np.where(codes == 60, 90, codes).astype(np.uint8)", "max_share=1/64", True),
        ("np.where(codes == 60, 90, codes).astype(np.uint8)", "max_share=1/65", False),
        ("codes[:4]", "max_share=1", False),
    ],
)
def test_limits(project: pytest.Pytester, changed: str, limits: str, passes: bool) -> None:
    picture(project)
    run(project, "--update-goldens").assert_outcomes(passed=1)
    picture(project, changed, limits)
    run(project).assert_outcomes(passed=int(passes), failed=int(not passes))


@pytest.mark.parametrize(("factor", "passes"), [(1.0005, True), (1.002, False)])
def test_linear_floats_have_a_limit(project: pytest.Pytester, factor: float, passes: bool) -> None:
    picture(project, "codes / np.float32(64)")
    run(project, "--update-goldens").assert_outcomes(passed=1)
    picture(project, f"codes / np.float32(64) * {factor}", "tolerance=255")
    run(project).assert_outcomes(passed=int(passes), failed=int(not passes))


@pytest.mark.parametrize(
    ("value", "arguments", "what"),
    [
        ("codes * np.nan", "", "actual: 64 pixels hold a NaN or an infinity"),
        ("codes.astype(int)", "", "a picture is uint8 codes or linear floats, not int64"),
        ("codes", "'a/b'", "golden name 'a/b': letters, digits and . _ - only"),
        ("codes", "'x'); golden(codes, 'x'", "this test has compared x.png before"),
    ],
)
def test_a_wrong_picture(project: pytest.Pytester, value: str, arguments: str, what: str) -> None:
    picture(project, value, arguments)
    result = run(project, "--update-goldens")
    result.assert_outcomes(failed=1)
    assert what in result.stdout.str()


def test_a_golden_that_is_no_picture(project: pytest.Pytester) -> None:
    picture(project)
    path = project.path / "goldens" / "test_it.test_picture.png"
    path.parent.mkdir()
    path.write_text("half a file")
    result = run(project)
    result.assert_outcomes(failed=1)
    assert f"golden {path} cannot be read" in result.stdout.str()


def test_names(project: pytest.Pytester) -> None:
    """A golden is named after its test; another folder is the ini option's."""
    project.makeini("[pytest]\nlightbench_goldens = kept/here\n")
    project.makepyfile(
        test_it="import numpy as np, pytest\n"
        "@pytest.mark.parametrize('x', ['a-1', 'a/1', 'a:1'])\n"
        "class TestAll:\n"
        "    def test_one(self, golden, x):\n"
        "        golden(np.zeros((2, 2, 3), np.uint8))\n"
        "        golden(np.zeros((2, 2, 3), np.uint8), name='second.' + x[0])\n"
    )
    run(project, "--update-goldens").assert_outcomes(passed=3)
    names = sorted(path.name for path in (project.path / "kept/here").iterdir())
    assert names[0] == "second.a.png"
    assert "test_it.TestAll.test_one.a-1.png" in names
    assert len(names) == 4


def test_safe_names() -> None:
    assert safe_name("test_a.test_b[x-1]") == "test_a.test_b.x-1"
    ugly = ["..", "a b", "a/b", "a\\b", "a\u00e9", "x" * 300, "x" * 301]
    made = [safe_name(text) for text in ugly]
    assert len(set(made)) == len(ugly)
    assert all(re.fullmatch(r"[\w-][\w.-]{0,140}", name, re.ASCII) for name in made)


def test_the_report(project: pytest.Pytester) -> None:
    picture(project, "codes", "'a'); golden(codes, 'b'")
    run(project, "--update-goldens").assert_outcomes(passed=1)
    picture(project, "codes", "'a'); golden(codes + np.uint8(9), 'b', flip_mean=1e-5")
    result = run(project, "--golden-report", "out/r.html")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines([f"golden report: {project.path / 'out' / 'r.html'}"])
    text = (project.path / "out" / "r.html").read_text()
    assert "Golden report: 1 failed, 1 passed" in text
    assert text.count("data:image/png;base64,") == 8
    for word in ("Reference", "Actual", "Difference of codes × 8", "FLIP, black 0", "test_it.py"):
        assert word in text
    for metric in ("relMSE", "RMSE", "FLIP mean", "FLIP p99", "FLIP max", "8-bit codes"):
        assert f"{metric}</td>" in text
    assert not re.search(r"https?:|src=\"(?!data:)|<script|<link|@import|url\(", text)


def test_a_report_that_cannot_be_written(project: pytest.Pytester) -> None:
    picture(project)
    (project.path / "file").write_text("")
    result = run(project, "--golden-report", "file/r.html")
    result.stdout.fnmatch_lines(["golden report: *r.html: cannot be written: *"])
    result.assert_outcomes(failed=1)


def test_the_report_escapes_what_it_shows(project: pytest.Pytester) -> None:
    project.makepyfile(
        "import numpy as np, pytest\n"
        "@pytest.mark.parametrize('x', ['<b>&'])\n"
        "def test_it(golden, x):\n"
        "    golden(np.zeros((2, 2, 3), np.uint8))\n"
    )
    run(project, "--golden-report", "r.html").assert_outcomes(failed=1)
    text = (project.path / "r.html").read_text()
    assert "&lt;b&gt;&amp;" in text
    assert "<b>" not in text


def test_without_the_option_only_failures_are_reported(project: pytest.Pytester) -> None:
    path = project.path / ".pytest_cache" / "d" / "lightbench" / "golden-report.html"
    picture(project)
    assert (
        "golden report"
        not in project.runpytest_inprocess(*FEWER[:2], "--update-goldens").stdout.str()
    )
    assert "golden report" not in project.runpytest_inprocess(*FEWER[:2]).stdout.str()
    assert not path.exists()
    picture(project, "255 - codes")
    project.runpytest_inprocess(*FEWER[:2]).stdout.fnmatch_lines([f"golden report: {path}"])
    assert "1 failed" in path.read_text()


def test_the_renderer_is_named(project: pytest.Pytester) -> None:
    project.makepyfile(
        "import numpy as np\n"
        "def test_it(glsl, golden):\n"
        "    golden(np.tile(glsl('hue.glsl', 'hueToRgb', np.ones(4)), (4, 1, 1)))\n"
    )
    run(project, "--golden-report", "r.html").assert_outcomes(failed=1)
    assert "<dt>renderer</dt>" in (project.path / "r.html").read_text()
