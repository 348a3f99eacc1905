"""Alternative forms side by side: who is compared with whom, and how far off each is."""

import json

import pytest

from lightbench.cli import main
from lightbench.forms import Form, Group, compare, groups, table
from tests.support import library

# File: largest and mean relative error, each to a factor of 1.5; 0 is below 1e-5.
ERRORS = {
    "maskings/smith_beckmann_exact.glsl": (0.0, 0.0),
    "maskings/smith_beckmann.glsl": (0.006, 0.0012),
    "maskings/smith_ggx.glsl": (0.0, 0.0),
    "maskings/smith_ggx_textbook.glsl": (0.0, 0.0),
    "maskings/smith_ggx_fast.glsl": (0.28, 0.073),
    "maskings/smith_ggx_uncorrelated.glsl": (0.98, 0.04),
    "fresnels/dielectric.glsl": (0.0, 0.0),
    "fresnels/schlick.glsl": (0.23, 0.1),
    "distributions/ggx.glsl": (0.0, 0.0),
    "transfers/srgb.glsl": (4.6e-5, 0.0),
}


@pytest.fixture(scope="module")
def measured() -> list[Form]:
    return [form for group in groups(library()) for form in compare(library(), group, runs=2)]


def test_every_textbook_form_is_compared() -> None:
    files = {file for group in groups(library()) for file in group.files}
    assert {p for p, f in library().files.items() if f.meta.textbook_of} <= files
    assert {"fresnels/schlick.glsl", "maskings/smith_beckmann_exact.glsl"} <= files


def test_a_folder_that_lacks_a_form_is_compared_without_it() -> None:
    found = library().model_copy(
        update={"files": {p: f for p, f in library().files.items() if "fast" not in p}}
    )
    smith = next(group for group in groups(found) if group.function == "visibility")
    assert "maskings/smith_ggx_fast.glsl" not in smith.files
    assert len(smith.files) == 3


@pytest.mark.parametrize("file", ERRORS)
def test_errors(file: str, measured: list[Form]) -> None:
    form = next(each for each in measured if each.file == file)
    for got, expected in zip((form.largest, form.mean), ERRORS[file], strict=True):
        if expected:
            assert expected / 1.5 < got < expected * 1.5
        else:
            assert got < 1e-5
    assert form.invalid == 0.0


def test_the_textbook_is_worse(measured: list[Form]) -> None:
    by_file = {form.file: form for form in measured}
    for path, file in library().files.items():
        if file.meta.textbook_of and "smith" not in path:
            folder = path.rpartition("/")[0]
            ours, textbook = by_file[f"{folder}/{file.meta.textbook_of}.glsl"], by_file[path]
            assert ours.mean < 1e-5
            assert textbook.mean > 100.0 * ours.mean or textbook.invalid > 0.01


def test_a_time_is_a_number(measured: list[Form]) -> None:
    for form in measured:
        assert form.duration.low <= form.duration.median <= form.duration.high


def test_the_table_names_what_ran_it(measured: list[Form]) -> None:
    text = table(measured)
    for form in measured:
        assert form.title in text
        assert form.group in text
    assert "OpenGL" in text or "Mesa" in text or "ES" in text
    assert max(map(len, text.splitlines())) <= 110


def test_as_json(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    one = Group("sRGB", "transfer", ("transfers/srgb_pow.glsl", "transfers/srgb.glsl"))
    monkeypatch.setattr("lightbench.forms.groups", lambda _: [one])
    with pytest.raises(SystemExit) as stop:
        main(["forms", "--json", "--runs", "1"])
    assert stop.value.code == 0
    data = json.loads(capsys.readouterr().out)
    assert {"renderer", "opengl", "lightbench", "rows", "forms"} == set(data)
    assert [form["file"] for form in data["forms"]] == list(one.files)
    assert {"median", "low", "high"} == set(data["forms"][0]["duration"])
