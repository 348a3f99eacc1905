"""The pytest plugin: fixtures `glsl` and `golden`, and the report of golden comparisons.

Every pytest run loads this file wherever Lightbench is installed. So it lies beside the package,
and imports of it nothing before a test asks for a fixture.
"""

from __future__ import annotations

from collections.abc import Generator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from lightbench.golden import Golden
    from lightbench.golden_report import Record

UPDATE = "--update-goldens"
REPORT = "golden_report"
RECORDS = pytest.StashKey[list["Record"]]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Where shaders, goldens and the report lie."""
    parser.getgroup("lightbench").addoption(
        "--golden-report",
        metavar="FILE",
        help="write an HTML report of every golden comparison to FILE; without this option those "
        "that fail are written to pytest's cache, d/lightbench/golden-report.html",
    )
    parser.addini(
        "lightbench_shaders",
        "folder that the fixture glsl reads, relative to the rootdir (default: the built-in one)",
        default="",
    )
    parser.addini(
        "lightbench_goldens",
        "folder of the golden pictures, relative to the test's file (default: goldens)",
        default="goldens",
    )


@pytest.hookimpl(wrapper=True)
def pytest_load_initial_conftests(parser: pytest.Parser) -> Generator[None, object, object]:
    """Add --update-goldens last: a conftest.py or plugin that has an option so named keeps it."""
    result = yield
    if _is_free(parser, UPDATE):
        parser.getgroup("lightbench").addoption(
            UPDATE, action="store_true", help="write the golden pictures instead of comparing"
        )
    return result


def _is_free(parser: pytest.Parser, option: str) -> bool:
    try:
        return option in parser.parse_known_and_unknown_args([option])[1]
    except pytest.UsageError:  # it is somebody's, and asks for a value
        return False


@pytest.fixture(scope="session")
def glsl(pytestconfig: pytest.Config) -> Callable[..., NDArray[np.float32]]:
    """`glsl(file, function, *arrays, settings=None)`: run a GLSL function for each row of arrays.

    As `lightbench.glsl.call`, in the folder that the ini option `lightbench_shaders` names.
    """
    from lightbench.errors import LightbenchError
    from lightbench.glsl import call

    folder = pytestconfig.getini("lightbench_shaders")
    shaders = pytestconfig.rootpath / folder if folder else None

    def glsl(file: str, function: str, *arrays: Any, settings: Any = None) -> NDArray[np.float32]:
        __tracebackhide__ = True
        try:
            return call(file, function, *arrays, settings=settings, shaders=shaders)
        except LightbenchError as error:  # the caller's mistake: show the caller's line
            raise error.with_traceback(None) from None

    return glsl


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Golden:
    """`golden(picture, name=None, tolerance=1, ...)`: compare a picture with its golden one.

    The call is described at `lightbench.golden.Golden`.
    """
    from lightbench.golden import Golden, safe_name

    config, path = request.config, request.path
    parts = request.node.nodeid.split("::")[1:]
    result = Golden(
        folder=path.parent / config.getini("lightbench_goldens"),
        test=request.node.nodeid,
        default_name=safe_name(".".join([path.stem, *parts])),
        update=bool(config.getoption(UPDATE, default=False)),
        show_all=bool(config.getoption(REPORT)),
        from_gl="glsl" in request.fixturenames,
    )
    request.node.stash[RECORDS] = result.records
    return result


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[Any]
) -> Generator[None, object, object]:
    """Let the report carry the comparisons to the process that writes them."""
    report: Any = yield
    if call.when == "teardown" and RECORDS in item.stash:
        report.golden_records = item.stash[RECORDS]
    return report


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """Write the report, and say where it is and which goldens are new."""
    reports = (report for group in terminalreporter.stats.values() for report in group)
    records = [record for r in reports for record in getattr(r, "golden_records", ())]
    for record in records:
        if record["status"] == "written":
            terminalreporter.write_line(f"golden written: {record['path']}")
    if path := _report_path(config, records):
        terminalreporter.write_line(f"golden report: {_written(path, records)}")


def _written(path: Path, records: list[Record]) -> str:
    from lightbench.errors import LightbenchError
    from lightbench.golden_report import write

    try:
        write(path, records)
    except LightbenchError as error:
        return str(error)
    return str(path)


def _report_path(config: pytest.Config, records: list[Record]) -> Path | None:
    """The file that was asked for, or one in the cache where a comparison failed."""
    if asked := config.getoption(REPORT):
        return Path(config.invocation_params.dir / asked)
    cache = getattr(config, "cache", None)
    if cache is None or not {"failed", "missing"} & {record["status"] for record in records}:
        return None
    return Path(cache.mkdir("lightbench")) / "golden-report.html"
