"""Front matter and contracts: a file that breaks them is refused with its file and line."""

from pathlib import Path

import pytest

from lightbench.errors import ShaderError
from lightbench.library import read_library
from tests.support import copy_of_shaders, library

TONE = """/*---
title = "T"
{front}
---*/
{code}
"""
GOOD = "vec3 tonemap(vec3 radiance) {{ return radiance; }}".replace("{{", "{").replace("}}", "}")


def refused(folder: Path, path: str, text: str) -> str:
    root = copy_of_shaders(folder, {path: text})
    with pytest.raises(ShaderError) as caught:
        read_library(root)
    return str(caught.value)


@pytest.mark.parametrize(
    ("front", "where", "what"),
    [
        ("titel = 'x'", 3, "titel: no such key; allowed are: title, equation"),
        ("domain = { alpha = 3 }", 3, "domain.alpha"),
        ("unit = 5", 3, "unit: Input should be a valid string"),
        ("unit = ", 3, "Invalid value"),
        ("\nmaterial = ['colour']", 1, "no field 'colour'; fields are: base_color"),
        ("[parameters.x]\ndefault = 3.0", 3, "a number needs its range"),
        ("[parameters.x]\ndefault = 3.0\nrange = [0.0, 1.0]", 3, "outside the range"),
        ("[parameters.x]\ndefault = 1.0\nrange = [0.0, 1.0]\nkind = 'angle'", 6, "kind"),
        ("[parameters.x]\nkind = 'int'\ndefault = 1.5\nrange = [0, 9]", 3, "1.5 is no int"),
    ],
)
def test_wrong_front_matter(tmp_path: Path, front: str, where: int, what: str) -> None:
    text = TONE.format(front=front, code=GOOD)
    message = refused(tmp_path, "tonemaps/t.glsl", text)
    assert message.startswith("tonemaps/t.glsl:"), message
    assert what in message
    assert abs(int(message.split(":")[1]) - where) <= 1, message


@pytest.mark.parametrize(
    ("code", "line", "what"),
    [
        ("vec3 tone(vec3 radiance) { return radiance; }", 1, "must define vec3 tonemap(vec3 rad"),
        ("vec3 tonemap(float x) { return vec3(x); }", 5, "tonemap must be vec3 tonemap(vec3 rad"),
        ("float tonemap(vec3 radiance) { return radiance.x; }", 5, "tonemap must be"),
        ("// caf\u00e9\n" + GOOD, 5, "ASCII"),
    ],
)
def test_wrong_code(tmp_path: Path, code: str, line: int, what: str) -> None:
    message = refused(tmp_path, "tonemaps/t.glsl", TONE.format(front="", code=code))
    assert message.startswith(f"tonemaps/t.glsl:{line}:"), message
    assert what in message


def test_a_parameter_belongs_to_one_folder(tmp_path: Path) -> None:
    front = "[parameters.gamma]\ndefault = 1.0\nrange = [0.0, 1.0]"
    message = refused(tmp_path, "tonemaps/t.glsl", TONE.format(front=front, code=GOOD))
    assert message == "transfers/gamma.glsl:1: parameter 'gamma' is already one of tonemaps/"


def test_no_front_matter(tmp_path: Path) -> None:
    message = refused(tmp_path, "tonemaps/t.glsl", GOOD)
    assert message == "tonemaps/t.glsl:1: the file must begin with front matter, /*--- ... ---*/"


def test_a_pass_needs_its_keys(tmp_path: Path) -> None:
    message = refused(tmp_path, "passes/p.glsl", "/*---\ntitle = 'P'\n---*/\n")
    assert message.startswith("passes/p.glsl:")
    assert "Field required" in message


def test_a_pass_with_a_wrong_condition(tmp_path: Path) -> None:
    text = "/*---\ntitle='P'\ndraw='screen'\nwhen='fog > 0'\n[writes.x]\nformat='rgba8'\n---*/\n"
    assert "'fog' is not defined" in refused(tmp_path, "passes/p.glsl", text)


def test_a_folder_without_its_default(tmp_path: Path) -> None:
    root = copy_of_shaders(tmp_path, {})
    (root / "tonemaps" / "none.glsl").unlink()
    for path in root.glob("tonemaps/*.glsl"):
        path.unlink()
    with pytest.raises(ShaderError, match="default"):
        read_library(root)


@pytest.mark.parametrize(
    ("path", "of", "code", "what"),
    [
        (
            "tonemaps/t.glsl",
            "nope",
            GOOD,
            "'nope' is no file here that is none itself; there is: lab_white, no",
        ),
        (
            "tonemaps/t.glsl",
            "reinhard_extended_textbook",
            GOOD,
            "is no file here that is none itself",
        ),
        ("tonemaps/t.glsl", "t", GOOD, "'t' is no file here"),
        ("lib/t.glsl", "spot", "float other() { return 1.0; }", "no function of spot.glsl"),
    ],
)
def test_a_textbook_form_of_nothing(
    tmp_path: Path, path: str, of: str, code: str, what: str
) -> None:
    message = refused(tmp_path, path, TONE.format(front=f"textbook_of = '{of}'", code=code))
    assert message.startswith(f"{path}:1: ")
    assert what in message


def test_a_textbook_form_is_no_default(tmp_path: Path) -> None:
    text = TONE.format(front="textbook_of = 'none'", code=GOOD)
    root = copy_of_shaders(tmp_path, {"tonemaps/t.glsl": text})
    folder = root / "tonemaps/_choice.toml"
    folder.write_text(folder.read_text().replace('"none"', '"t"'))
    with pytest.raises(ShaderError, match=r"tonemaps/_choice\.toml:1: default 't' is no file here"):
        read_library(root)


def test_every_file_says_what_it_is() -> None:
    """Every choice carries its title and about; every formula its equation and source."""
    menu = library()
    for path, file in menu.files.items():
        if path.split("/")[0] in menu.folders:
            assert file.meta.title, path
            assert file.meta.about, path
        assert len(file.code.splitlines()) <= 150, path


def test_a_library_is_read_once_until_it_changes(tmp_path: Path) -> None:
    root = copy_of_shaders(tmp_path, {})
    first = read_library(root)
    assert read_library(root) is first
    (root / "tonemaps" / "t.glsl").write_text(TONE.format(front="", code=GOOD))
    assert "tonemaps/t.glsl" in read_library(root).files
