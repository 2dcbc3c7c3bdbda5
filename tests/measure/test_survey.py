"""A measurement of a handful of points: whole, repeatable, and taken up where it broke off."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rodproof.codegen.measure import records, survey
from rodproof.codegen.measure.inputs import KINDS, Batch
from rodproof.codegen.measure.records import FUNCTIONS, Measurement, TimeRow
from rodproof.codegen.measure.rivals import Form, all_forms, answers

TINY = replace(survey.settings(quick=True), batches=1, points=2, rounds=1, timed_points=8)


def silent(name: str, done: int, total: int) -> None:
    pass


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> Measurement:
    return survey.measure(tmp_path_factory.mktemp("m") / "measurement.json", TINY, silent)


def test_every_form_is_measured_on_every_sample(measured: Measurement) -> None:
    for function in FUNCTIONS:
        for form in all_forms():
            assert measured.time(function, form.name, 8) is not None
            assert measured.time(function, form.name, 1) is not None
            assert all(measured.error(function, form.name, kind) for kind in KINDS)


def test_errors_are_the_same_again(measured: Measurement) -> None:
    again = survey.errors("loads", all_forms(), TINY)
    assert again == [row for row in measured.errors if row.function == "loads"]


@pytest.mark.parametrize("form", all_forms(), ids=lambda form: form.name)
def test_every_form_computes_the_same_thing(measured: Measurement, form: Form) -> None:
    """On ordinary inputs all are right to a few digits, each in its own way."""
    for function in FUNCTIONS:
        row = measured.error(function, form.name, "ordinary")
        assert row is not None
        assert row.failures == 0
        assert row.worst is not None
        assert row.worst < 1e12  # of 4.5e15 ulps for a wrong first digit


def test_more_digits_are_nearer(measured: Measurement) -> None:
    rows = [measured.error("loads", f"mpmath {digits}", "ordinary") for digits in (15, 30, 50)]
    worst = [row.worst for row in rows if row and row.worst is not None]
    assert worst[0] > 1e6 * worst[1] > 1e12 * worst[2]


def test_a_broken_off_run_goes_on(measured: Measurement, tmp_path: Path) -> None:
    path = tmp_path / "measurement.json"
    mark = TimeRow("strains", "a mark that measuring would not leave", 8, 1.0, 1.0)
    start = replace(measured, times=(mark, *measured.times))
    records.save(start, path.with_suffix(".partial.json"))
    told: list[str] = []
    went_on = survey.measure(path, TINY, lambda name, done, total: told.append(name))
    assert went_on == start
    assert told == [*FUNCTIONS, "done"]
    assert [file.name for file in tmp_path.iterdir()] == ["measurement.json"]


def test_a_partial_of_other_settings_is_not_taken(measured: Measurement, tmp_path: Path) -> None:
    partial = tmp_path / "measurement.partial.json"
    records.save(measured, partial)
    other = replace(TINY, seed=TINY.seed + 1)
    assert survey.resumed(partial, other, all_forms()).done() == frozenset()
    assert survey.resumed(partial, TINY, all_forms()).done() == set(FUNCTIONS)


def test_a_form_that_raises_has_no_answer_there() -> None:
    """Only the point that fails is lost, not the block it stands in."""
    import numpy as np

    def bind(function: str, constants: tuple[float, ...]):
        def call(first, second):
            if np.any(first > 1):
                raise ValueError("past the limit")
            return np.concatenate([first, second])

        return call

    block = Batch((1.0,) * 7, np.array([[0.5, 2.0]] * 3), np.zeros((3, 2)))
    assert answers(Form("x", "", bind), "loads", block) == [[0.5] * 3 + [0.0] * 3, None]
