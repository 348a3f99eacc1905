"""Options of the test run: no skip that goes unnoticed."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, expect

from tests.browser import PATIENCE_MS, browsing, serving

# A test may be skipped in CI only for a reason that starts with one of these.
ALLOWED_SKIPS = ("needs a hardware GPU", "no shared models")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--no-skips",
        action="store_true",
        default=os.environ.get("CI") == "true",
        help="a skipped test fails (always so with CI=true)",
    )
    parser.addoption(
        "--all-mutants",
        action="store_true",
        default=os.environ.get("LIGHTBENCH_ALL_MUTANTS") == "1",
        help="break the shaders in every way of tests/mutations.py, not in a few per file",
    )


NOTE = "note"


@pytest.fixture
def note(request: pytest.FixtureRequest) -> Callable[[str], None]:
    """Adds a line to what the run reports at its end: a measured error, a rate."""
    # Properties travel with the report to the process that prints the summary.
    return lambda line: request.node.user_properties.append((NOTE, line))


@pytest.fixture(scope="module")
def site() -> Iterator[str]:
    """The address of a served playground."""
    with serving() as address:
        yield address


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium on the software rasteriser that the service uses too."""
    expect.set_options(timeout=PATIENCE_MS)
    with browsing("llvmpipe") as found:
        yield found


def pytest_terminal_summary(
    terminalreporter: pytest.TerminalReporter, config: pytest.Config
) -> None:
    reports = (report for group in terminalreporter.stats.values() for report in group)
    found = (p for r in reports for p in getattr(r, "user_properties", ()))
    if notes := [line for name, line in found if name == NOTE]:
        terminalreporter.section("measured")
        for line in dict.fromkeys(notes):
            terminalreporter.line(line)


def _fail_skip(report: pytest.TestReport | pytest.CollectReport, config: pytest.Config) -> None:
    if not report.skipped or hasattr(report, "wasxfail") or not config.getoption("--no-skips"):
        return
    reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
    if not reason.removeprefix("Skipped: ").startswith(ALLOWED_SKIPS):
        report.outcome = "failed"
        report.longrepr = f"This run allows no skip, and {report.nodeid} was skipped: {reason}"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[Any]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    report = yield
    _fail_skip(report, item.config)
    return report


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    report = yield
    _fail_skip(report, collector.config)
    return report
