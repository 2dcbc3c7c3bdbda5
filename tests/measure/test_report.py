"""Pages and plots come from the stored data alone, the same bytes each time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rodproof.codegen.measure import plot, records, table
from rodproof.codegen.measure.inputs import KINDS
from rodproof.codegen.measure.plot import Mark, front
from rodproof.codegen.measure.records import FUNCTIONS, ErrorRow, Measurement, Settings, TimeRow
from rodproof.codegen.measure.report import report

FORMS = tuple(plot.STYLES)


@pytest.fixture
def measurement() -> Measurement:
    """Made up: the i-th form has the error 10^-i and takes 10^(i+1) ns."""
    asked = Settings(1, True, batches=2, points=3, rounds=7, timed_points=64, digest="d")
    errors = [
        ErrorRow(function, form, kind, 6, 0, 10.0**-i, 0.1 * 10.0**-i, 0.0, 0, 5.0)
        for function in FUNCTIONS
        for kind in KINDS
        for i, form in enumerate(FORMS)
    ]
    times = [
        TimeRow(function, form, points, 10.0 ** (i + 1), 10.0**i)
        for function in FUNCTIONS
        for points in (64, 1)
        for i, form in enumerate(FORMS)
    ]
    forms = dict.fromkeys(FORMS, "made up")
    return Measurement(records.this_machine(), asked, forms, tuple(errors), tuple(times))


def failing(measurement: Measurement, form: str) -> Measurement:
    return replace(
        measurement,
        errors=tuple(
            replace(row, failures=2, worst=None, median=None, beyond=None)
            if row.form == form
            else row
            for row in measurement.errors
        ),
    )


def test_report_writes_all_files_twice_alike(tmp_path: Path, measurement: Measurement) -> None:
    data = tmp_path / "measurement.json"
    records.save(measurement, data)
    first = {path.name: path.read_bytes() for path in report(data, tmp_path / "a")}
    second = {path.name: path.read_bytes() for path in report(data, tmp_path / "b")}
    assert first == second
    assert set(first) == {
        "measurement.md",
        *(f"front-{kind}.{end}" for kind in ("ordinary", "extreme") for end in ("svg", "png")),
    }
    assert b"<dc:date>" not in first["front-extreme.svg"]
    assert first["front-extreme.png"][:4] == b"\x89PNG"


def test_every_form_and_function_is_on_the_page(measurement: Measurement) -> None:
    page = table.page(measurement)
    assert all(f"## {function}" in page for function in FUNCTIONS)
    assert all(page.count(f"\n| {form} |") == len(FUNCTIONS) for form in FORMS)


def test_failures_are_shown_as_such(measurement: Measurement) -> None:
    failed = failing(measurement, "textbook")
    (row,) = {line for line in table.page(failed).splitlines() if line.startswith("| textbook")}
    assert "∞ / ∞" in row
    assert row.endswith("| ∞ | 8 |")  # four samples with two failures each
    marks = {mark.form: mark for mark in plot.marks(failed, "loads", "extreme")}
    assert marks["textbook"].worst == plot.NO_NUMBER
    assert marks["lambdify"].worst < 1


def test_front_holds_what_nothing_beats() -> None:
    fast, slow = Mark("fast", 1, 100, 1), Mark("slow", 100, 1, 1)
    beaten, tied = Mark("beaten", 101, 1, 1), Mark("tied", 1, 200, 1)
    assert front([beaten, slow, tied, fast]) == [fast, slow]


def test_numbers_read_well() -> None:
    assert [table.number(x) for x in (None, 0.0, 1.2345, 54321.0, 1.5e12, 1e-30)] == [
        "∞",
        "0",
        "1.23",
        "54,321",
        "1.5e+12",
        "1.0e-30",
    ]
