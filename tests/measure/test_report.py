"""Pages and pictures come from the stored data alone, the same bytes each time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rodproof.codegen.measure import atlas, fronts, plot, records, table
from rodproof.codegen.measure.atlas import Atlas, Chart, Summary
from rodproof.codegen.measure.extremes import Outcome
from rodproof.codegen.measure.fronts import Mark, front, winner
from rodproof.codegen.measure.inputs import KINDS
from rodproof.codegen.measure.records import ErrorRow, Measurement, Settings, TimeRow
from rodproof.codegen.measure.report import drawn
from rodproof.codegen.measure.rivals import all_forms

FORMS = tuple(plot.STYLES)
FUNCTIONS = ("strains", "loads", "stiffness", "compliance")


@pytest.fixture
def measurement() -> Measurement:
    """Made up: the i-th form has the error 10^-i and takes 10^(i+1) ns."""
    asked = Settings(1, True, batches=2, points=3, rounds=7, timed_points=64)
    errors = [
        ErrorRow("planar", function, form, kind, 6, 0, 10.0**-i, 0.1 * 10.0**-i, 0.0, 0)
        for function in FUNCTIONS
        for kind in KINDS
        for i, form in enumerate(FORMS)
    ]
    times = [
        TimeRow("planar", function, form, points, 10.0 ** (i + 1), 10.0**i)
        for function in FUNCTIONS
        for points in (64, 1)
        for i, form in enumerate(FORMS)
    ]
    forms = dict.fromkeys(FORMS, "made up")
    scenes = {"planar": "d"}
    return Measurement(records.this_machine(), asked, forms, scenes, tuple(errors), tuple(times))


@pytest.fixture
def mapped() -> Atlas:
    """Made up: two functions of a scene, one of them wrong somewhere."""
    marks = [[0.5, 9.0, 2e4], [1e8, 1e14, "nan"], ["refused", "-", 3.0]]
    charts = [
        Chart("planar", f, chart, "p", "Q", ("1", "2", "3"), ("a", "b", "c"), marks, marks[::-1])
        for f in FUNCTIONS[:2]
        for chart in ("limit", "load", "moduli")
    ]
    summaries = [
        Summary("planar", f, precision, 9, 1, 1, wrong, worst, 0.5, "the.spot", (1.0,), (0.0,), 3)
        for f, wrong, worst in (("strains", 0, 2.5), ("loads", 2, None))
        for precision in ("float64", "float32")
    ]
    cases = (Outcome("a case", "strains", "right", "error 0 ulps"),)
    settings = atlas.Settings(True, 3, 1)
    machine = records.this_machine()
    return Atlas(machine, settings, {"planar": "d"}, tuple(summaries), tuple(charts), cases)


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


def test_the_styles_are_those_of_the_forms() -> None:
    assert {form.name for form in all_forms()} == set(FORMS)


def test_report_writes_all_files_twice_alike(
    tmp_path: Path, measurement: Measurement, mapped: Atlas
) -> None:
    records.save(measurement, tmp_path / "measurement.json")
    atlas.save(mapped, tmp_path / "atlas.json")
    first = {path.name: path.read_bytes() for path in drawn(tmp_path, tmp_path / "a")}
    apart = [
        p
        for name in ("measurement", "atlas")
        for p in drawn(tmp_path / f"{name}.json", tmp_path / "b")
    ]
    second = {path.name: path.read_bytes() for path in apart}
    assert first == second
    assert set(first) == {"measurement.md", "front-planar.svg", "atlas.md", "atlas-planar.png"}
    assert b"<dc:date>" not in first["front-planar.svg"]
    assert first["atlas-planar.png"][:4] == b"\x89PNG"


def test_a_folder_without_data_names_the_command(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="holds nothing measured; run `rodproof mea"):
        drawn(tmp_path, tmp_path)


def test_every_form_and_function_is_on_the_page(measurement: Measurement) -> None:
    page = table.page(measurement)
    assert all(f"### planar.{function}" in page for function in FUNCTIONS)
    assert all(page.count(f"\n| {form} |") == len(FUNCTIONS) for form in FORMS)


def test_failures_are_shown_as_such(measurement: Measurement) -> None:
    failed = failing(measurement, "textbook")
    (row,) = {line for line in table.page(failed).splitlines() if line.startswith("| textbook")}
    assert "∞ / ∞" in row
    assert row.endswith("| ∞ | 8 |")  # four samples with two failures each
    marks = {mark.form: mark for mark in fronts.marks(failed, "planar", "loads", "all")}
    assert marks["textbook"].worst == fronts.NO_NUMBER
    assert marks["lambdify"].worst < 1


def test_front_holds_what_nothing_beats() -> None:
    fast, slow = Mark("fast", 1, 100, 1), Mark("slow", 100, 1, 1)
    beaten, tied = Mark("beaten", 101, 1, 1), Mark("tied", 1, 200, 1)
    assert front([beaten, slow, tied, fast]) == [fast, slow]


def test_the_winner_is_the_cheapest_that_is_good_enough(measurement: Measurement) -> None:
    fast, slow = Mark("fast", 1, 100, 1), Mark("slow", 100, 1, 1)
    assert winner([slow, fast], 1e3) == fast
    assert winner([slow, fast], 8) == slow
    assert winner([slow, fast], 0.5) is None
    row = next(line for line in table.page(measurement).splitlines() if "| loads |" in line)
    assert row.count("stable float64 (10)") == 8


def test_single_precision_counts_in_ulps_of_a_double(measurement: Measurement) -> None:
    rows = tuple(replace(row, beyond=2.0) for row in measurement.errors)
    found = fronts.marks(replace(measurement, errors=rows), "planar", "loads", "all")
    worst = {mark.form: mark.worst for mark in found}
    assert worst["stable float64"] == 2
    assert worst["stable float32"] == 2.0**30


def test_the_atlas_page_tells_what_is_wrong(tmp_path: Path, mapped: Atlas) -> None:
    path = tmp_path / "atlas.json"
    atlas.save(mapped, path)
    assert atlas.load(path) == mapped
    drawn(path, tmp_path)
    page = (tmp_path / "atlas.md").read_text()
    assert "Ours is wrong at 4 of them" in page
    assert "| strains | 18 | 0 | 2.5 | 0.5 | 2.5 | 2 | 2 | 3 of 9 | `the.spot` |" in page
    assert "| loads | 18 | 4 | ∞ |" in page
    assert "| a case | strains | right | error 0 ulps |" in page
    path.write_text("{}")
    with pytest.raises(ValueError, match=r"atlas\.json: not a stability atlas"):
        atlas.load(path)


def test_numbers_read_well() -> None:
    assert [table.number(x) for x in (None, 0.0, 1.2345, 54321.0, 1.5e12, 1e-30)] == [
        "∞",
        "0",
        "1.23",
        "54,321",
        "1.5e+12",
        "1.0e-30",
    ]
