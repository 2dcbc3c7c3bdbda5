"""A measurement of a handful of points: whole, repeatable, and taken up where it broke off."""

from __future__ import annotations

import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rodproof.codegen.measure import atlas, cells, survey
from rodproof.codegen.measure.form import Code, Form, answers
from rodproof.codegen.measure.inputs import Batch, kinds
from rodproof.codegen.measure.records import Measurement, Settings
from rodproof.codegen.measure.rivals import all_forms, form_of
from rodproof.codegen.measure.store import Store
from rodproof.codegen.measure.subjects import subject, subjects

TINY = Settings(20240607, True, batches=1, points=2, rounds=1, timed_points=8)
SMALL = (subject("kirchhoff"),)
FULL = (subject("full_rod"), subject("thrust"))
USUAL = tuple(form for form in all_forms() if not form.needs)


def silent(name: str, done: int, total: int) -> None:
    pass


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> Measurement:
    path = tmp_path_factory.mktemp("m") / "measurement.json"
    return survey.measure(path, TINY, silent, chosen=FULL)


def test_every_function_of_every_scene_has_its_cells() -> None:
    for asked in (survey.settings(quick=True), survey.settings(quick=False)):
        found = cells.error_cells(subjects(), asked)
        for one in subjects():
            for function in one.functions:
                forms = {form.name for form in cells.chosen(one.name, function, asked)}
                assert {"stable float64", "stable float32", "textbook", "lambdify cse"} <= forms
                assert asked.quick or {f.name for f in all_forms() if not f.needs} <= forms
                own = [c for c in found if (c.scene, c.function) == (one.name, function)]
                assert {c.kind for c in own} == set(kinds(one))
                assert {form for c in own for form in c.forms} == forms
        assert len({cells.key(cell, asked) for cell in found}) == len(found)


def test_every_form_is_measured_on_every_sample(measured: Measurement) -> None:
    for one in FULL:
        for function in one.functions:
            for form in cells.chosen(one.name, function, TINY):
                assert measured.time(one.name, function, form.name, 8) is not None
                assert measured.time(one.name, function, form.name, 1) is not None
                assert all(
                    measured.error(one.name, function, form.name, kind) for kind in kinds(one)
                )


def test_errors_are_the_same_again_whoever_computes_them(
    measured: Measurement, tmp_path: Path
) -> None:
    with ThreadPoolExecutor(1) as executor:
        again = survey.measure(
            tmp_path / "again.json", TINY, silent, chosen=FULL[1:], executor=executor
        )
    assert again.errors == tuple(row for row in measured.errors if row.scene == "thrust")


@pytest.mark.parametrize("form", USUAL, ids=lambda form: form.name)
def test_every_form_computes_the_same_thing(measured: Measurement, form: Form) -> None:
    """On ordinary inputs all are right to a few digits, each in its own way."""
    for function in FULL[0].functions:
        row = measured.error("full_rod", function, form.name, "ordinary")
        assert row is not None
        assert row.failures == 0
        assert row.worst is not None
        assert row.worst < 1e12  # of 4.5e15 ulps for a wrong first digit


@pytest.mark.parametrize("name", ["kirchhoff", "planar", "dsdna", "couple", "full_rod_p2"])
def test_rivals_of_other_scenes_too(name: str) -> None:
    one = subject(name)
    for function in one.functions:
        names = tuple(f.name for f in all_forms() if f.name in ("textbook", "lambdify cse"))
        cell = cells.ErrorCell(name, function, names, "ordinary")
        for row in cells.measure_errors(cell, TINY):
            assert row.failures == 0
            assert row.worst is not None
            assert row.worst < 1e11


def test_more_digits_are_nearer(measured: Measurement) -> None:
    rows = [
        measured.error("full_rod", "loads", f"mpmath {digits}", "ordinary")
        for digits in (15, 30, 50)
    ]
    worst = [row.worst for row in rows if row and row.worst is not None]
    assert worst[0] > 1e6 * worst[1] > 1e12 * worst[2]


@pytest.mark.parametrize(("what", "done"), [("survey", 20), ("atlas", 5)])
def test_a_run_killed_in_the_middle_loses_at_most_one_cell(
    what: str, done: int, tmp_path: Path
) -> None:
    path = tmp_path / "data.json"
    script = Path(__file__).with_name("broken.py")
    ended = subprocess.run(
        [sys.executable, script, str(done), path, what], check=False, timeout=300
    )
    assert ended.returncode == -signal.SIGKILL
    kept = path.with_suffix(".cells")
    lines = kept.read_bytes().splitlines(keepends=True)
    assert len(lines) == done
    kept.write_bytes(b"".join(lines[:-1]) + lines[-1][:40])  # the last one was being written
    told: list[int] = []

    def tell(name: str, done: int, total: int) -> None:
        told.append(done)

    if what == "atlas":
        coarse = atlas.Settings(True, coarse=9, choices=1)
        resumed = atlas.measure(path, coarse, tell, chosen=SMALL)
        fresh = atlas.measure(tmp_path / "fresh.json", coarse, silent, chosen=SMALL)
        assert (resumed.summaries, resumed.charts) == (fresh.summaries, fresh.charts)
    else:
        resumed = survey.measure(path, TINY, tell, chosen=SMALL)
        fresh = survey.measure(tmp_path / "fresh.json", TINY, silent, chosen=SMALL)
        assert resumed.errors == fresh.errors
        assert len(resumed.times) == len(fresh.times)
    assert told[0] == done - 1
    assert told[1:] == list(range(done, told[-1] + 1))
    assert sorted(file.name for file in tmp_path.iterdir()) == ["data.json", "fresh.json"]


def test_results_are_kept_by_scene_form_and_version(monkeypatch: pytest.MonkeyPatch) -> None:
    cell = cells.ErrorCell("kirchhoff", "loads", ("textbook",), "ordinary")
    known = {cells.key(cell, TINY)}
    for other in (
        replace(cell, scene="planar"),
        replace(cell, function="stiffness"),
        replace(cell, forms=("lambdify",)),
        replace(cell, kind="limit"),
    ):
        known.add(cells.key(other, TINY))
    known.add(cells.key(cell, replace(TINY, seed=1)))
    known.add(cells.key(cells.TimeCell("kirchhoff", "loads", ("textbook",), 8), TINY))
    monkeypatch.setattr(type(subject("kirchhoff")), "digest", "another text of the module")
    known.add(cells.key(cell, TINY))
    assert len(known) == 8


def test_the_store_reads_what_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "x.cells"
    Store(path).add("a", [1])
    with path.open("a") as file:
        file.write('["b", [2')
    store = Store(path)
    assert "a" in store
    assert "b" not in store
    store.add("c", [3])
    assert Store(path).known == {"a": [1], "c": [3]}
    store.forget()
    assert not path.exists()


def test_a_form_that_raises_has_no_answer_there() -> None:
    """Only the point that fails is lost, not the block it stands in."""

    def bind(code: Code, constants: tuple[float, ...]):
        def call(first, second):
            if np.any(first > 1):
                raise ValueError("past the limit")
            return np.concatenate([first, second])

        return call

    block = Batch((1.0,) * 7, np.array([[0.5, 2.0]] * 3), np.zeros((3, 2)))
    form = Form("x", "", bind, form_of("textbook").prepare)
    found = answers(form, subject("full_rod"), "loads", block)
    assert found == [[0.5] * 3 + [0.0] * 3, None]
