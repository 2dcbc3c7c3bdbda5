"""Deterministic property tests, and a last word that says what the run proved."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from hypothesis import settings

ROOT = Path(__file__).resolve().parent.parent

settings.register_profile("rodproof", derandomize=True, deadline=None, database=None)
settings.load_profile("rodproof")


@pytest.fixture(scope="session")
def root() -> Path:
    """The root of the working tree."""
    return ROOT


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Count the verdicts that passing tests recorded (``record_property("verdict", ...)``)."""
    passed = terminalreporter.stats.get("passed", [])
    verdicts = Counter(
        value for report in passed for name, value in report.user_properties if name == "verdict"
    )
    folders = Counter(report.nodeid.split("/")[1] for report in passed if "/" in report.nodeid)
    terminalreporter.section("what this run shows")
    for folder, count in sorted(folders.items()):
        terminalreporter.write_line(f"{folder:<14} {count:>5} tests passed")
    for verdict, count in sorted(verdicts.items()):
        terminalreporter.write_line(f"statements {verdict:<14} {count:>5}")
