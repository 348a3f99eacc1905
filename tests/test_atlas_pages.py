"""What the atlas writes: the page, the sheets, the JSON, and one line for a mistake."""

import base64
import io
import json
import re
import sys
from pathlib import Path

import pytest
from PIL import Image as Pillow

from lightbench import atlas_report
from lightbench.atlas import INF, KINDS, NAN, NEGATIVE, Map, chart
from lightbench.atlas_figure import LOUD, overview, strip
from lightbench.cli import main
from lightbench.sweep import sweeps
from tests.support import driver, library

SIZE = 24
GGX = ("distributions/ggx.glsl", "distribution")
FOLDERS = ("distributions/", "maskings/none", "tonemaps/", "lib/")


@pytest.fixture(scope="module")
def maps() -> list[Map]:
    chosen = [sweep for sweep in sweeps(library()) if sweep.file.startswith(FOLDERS)]
    return [chart(library(), sweep, SIZE) for sweep in chosen]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work in an empty folder, and undo what --shaders does to the environment."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LIGHTBENCH_SHADERS", "")
    monkeypatch.delenv("LIGHTBENCH_SHADERS")


# Pages


def pictures(page: str) -> list[Pillow.Image]:
    found = re.findall(r'src="data:image/png;base64,([^"]+)"', page)
    return [Pillow.open(io.BytesIO(base64.b64decode(data))) for data in found]


def colors(picture: Pillow.Image) -> set[str]:
    counted = picture.convert("RGB").getcolors(1 << 24) or []
    return {
        "#{:02x}{:02x}{:02x}".format(*color) for _, color in counted if isinstance(color, tuple)
    }


def test_the_page_holds_all_that_it_shows(tmp_path: Path, maps: list[Map]) -> None:
    chosen = [
        each for each in maps if each.sweep.file.startswith(("distributions/", "maskings/none"))
    ]
    written = atlas_report.write(chosen, tmp_path / "out")
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == sorted(written)
    assert sorted(written) == ["distributions.png", "index.html", "textbook.png"]
    page = (tmp_path / "out/index.html").read_text()
    assert not re.search(r"(src|href)=\"(?!data:|#)", page)
    assert "http" not in page
    assert len(pictures(page)) == 5
    for word in (driver()[0], "GGX", "textbook", "None: masking"):
        assert word in page
    assert set(re.findall(r'href="#([^"]+)"', page)) == set(
        re.findall(r'<figure id="([^"]+)"', page)
    )


def test_what_is_no_value_is_loud(maps: list[Map]) -> None:
    for file, kinds in (
        ("distributions/ggx.glsl", [NAN, INF]),
        ("lib/sphere.glsl", [NEGATIVE]),
        ("tonemaps/reinhard_extended.glsl", [NAN, INF]),
    ):
        each = next(m for m in maps if m.sweep.file == file)
        shown = colors(Pillow.open(io.BytesIO(strip(each))))
        assert {LOUD[kind] for kind in kinds} <= shown
    assert {LOUD[k] for k in (NAN, INF, NEGATIVE)} <= colors(
        Pillow.open(io.BytesIO(overview(maps)))
    )


def test_a_sentence_says_what_one_sees(maps: list[Map]) -> None:
    ggx = next(m for m in maps if (m.sweep.file, m.sweep.function) == GGX)
    text = atlas_report.sentence(ggx)
    assert re.search(
        r"In float32 the textbook form: off by more than 1 % on \d+ % of the map", text
    )
    assert re.search(r"infinite on [\d.]+ %", text)
    assert re.search(r"ours: at most [\d.]+ ULP off\.", text)


# The command


def run(*arguments: str) -> int:
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert isinstance(stop.value.code, int)
    return stop.value.code


def test_json_for_machines(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--function", ":".join(GGX), "--size", "16", "--json", "atlas.json"]
    assert run("atlas", *arguments) == 0
    assert capsys.readouterr().out == "atlas.json: 1 maps\n"
    assert [p.name for p in tmp_path.iterdir()] == ["atlas.json"]
    data = json.loads(Path("atlas.json").read_text(), parse_constant=lambda name: pytest.fail(name))
    assert {"lightbench", "numpy", "renderer", "opengl", "precisions", "maps"} == set(data)
    (only,) = data["maps"]
    assert (only["file"], only["function"]) == GGX
    assert only["x"]["name"] == "alpha"
    assert len(only["x"]["values"]) == len(only["y"]["values"]) == 16
    assert [(p["file"].split("/")[1], p["precision"]) for p in only["panels"]] == [
        ("ggx_textbook.glsl", "float32"), ("ggx_textbook.glsl", "half"),
        ("ggx.glsl", "float32"), ("ggx.glsl", "half"),
    ]  # fmt: skip
    for panel in only["panels"]:
        assert len(panel["grid"]) == 16
        assert {type(v) for row in panel["grid"] for v in row} <= {float, str, type(None)}
        assert {v for row in panel["grid"] for v in row if isinstance(v, str)} <= set(KINDS)


def test_a_page_of_one_function(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--function", "maskings/smith_ggx.glsl:visibility", "--axes", "NoL,NoV"]
    assert run("atlas", *arguments, "--size", "16", "-o", "out") == 0
    assert "out: 1 maps, in textbook.png, maskings.png, index.html" in capsys.readouterr().out
    assert Path("out/index.html").is_file()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ("--function ggx", "'ggx' is not FILE:FUNCTION"),
        ("--function nope.glsl:f", "no map of a file 'nope.glsl'; there is: ambients/"),
        ("--function distributions/ggx.glsl:f", "no 'f'; there is: distribution"),
        ("--axes alpha,theta_h", "--axes is of one --function"),
        ("--function distributions/ggx.glsl:distribution --axes alpha", "'alpha' is not X,Y"),
        ("--function distributions/ggx.glsl:distribution --axes alpha,x", "no input 'x'; there is"),
        ("--function distributions/ggx.glsl:distribution --axes alpha,alpha", "not 'alpha' twice"),
        ("--size 8", "8 is not in the range"),
        ("--function distributions/ggx.glsl:distribution --size 16 --json no/a.json", "no/a.json"),
        ("--function distributions/ggx.glsl:distribution --size 16 -o file", "file: "),
        ("--shaders empty", "empty has no function to map"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_line(
    arguments: str, says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("file").touch()
    Path("empty").mkdir()
    assert run("atlas", *arguments.split(" ")) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert says in err
    assert err.startswith("lightbench: ")
    assert err.count("\n") == 1


def test_without_matplotlib(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.axes", None)
    monkeypatch.delitem(sys.modules, "lightbench.atlas_figure")
    monkeypatch.delitem(sys.modules, "lightbench.atlas_report")
    assert run("atlas", "--function", ":".join(GGX), "--size", "16", "-o", "out") == 2
    assert "-m pip install 'matplotlib" in capsys.readouterr().err
