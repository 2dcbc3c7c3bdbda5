"""Every statement: the verdict that the record has, from decisions and not from the record."""

from __future__ import annotations

import csv
import dataclasses
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
import sympy as sp

from rodproof.derivations import ledger
from rodproof.derivations.notation import equal, m
from rodproof.derivations.records import VERDICTS, Statement

ALL = [s.id for s in ledger.statements()]
#: Definitions of ranges, indices and regions: nothing in them is a number to compare.
NO_NUMBERS = {
    "tb-hypotheses", "constants-positive", "greek-index-range", "cross-section-disk",
    "reference-body", "couple-theta-range",
}  # fmt: skip
SHARED = Path(__file__).resolve().parents[3] / "shared" / "paper" / "inventory.tsv"


@pytest.mark.parametrize("name", ALL)
def test_verdict(name: str, record_property: Callable[[str, object], None]) -> None:
    """The decisions lead to the recorded verdict, and the second route agrees."""
    (statement,) = ledger.find((name,))
    evidence = ledger.judge(statement)
    assert evidence.verdict == ledger.recorded()[name]
    assert evidence.verdict in VERDICTS[:-1]
    assert (evidence.residual is None) == (name in NO_NUMBERS)
    if evidence.residual is not None:
        assert evidence.residual < ledger.AGREEMENT
    if evidence.verdict == "refuted":
        assert evidence.counterexample and evidence.correction_latex
    if evidence.verdict == "reading":
        assert evidence.reading
    record_property("verdict", evidence.verdict)


@pytest.mark.parametrize("section", sorted(ledger.SECTIONS))
def test_every_broken_twin_is_rejected_or_the_same(section: str) -> None:
    """All mutants of the statements of a section; none may survive undecided."""
    for evidence in ledger.check(ledger.statements(section), mutants=True):
        assert evidence.survivors == (), evidence.id
        assert evidence.mutants_tried == (
            (evidence.mutants_killed or 0) + (evidence.mutants_equivalent or 0)
        )


def test_the_record_lists_each_statement_once() -> None:
    assert len(set(ALL)) == len(ALL)
    assert set(ALL) == set(ledger.recorded())


@pytest.mark.skipif(not SHARED.exists(), reason="the inventory is not at hand")
def test_the_ledger_is_the_inventory() -> None:
    """Ids, sections and labels, where the inventory is at hand: none missing, none invented."""
    with SHARED.open() as file:
        wanted = {
            row["id"]: (row["section"], row["label"])
            for row in csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE)
        }
    ours = {s.id: (s.section, s.label) for s in ledger.statements()}
    assert {k: x for k, x in ours.items() if not k.startswith("extra-")} == {
        k: x for k, x in wanted.items() if x[0] in ledger.SECTIONS
    }


def test_a_wrong_transcription_changes_the_verdict() -> None:
    """A check that agrees with a wrong formula would be the worst bug here."""
    (statement,) = ledger.find(("const-u-mu",))
    left, right = statement.printed.sides  # type: ignore[attr-defined]
    broken = dataclasses.replace(statement, printed=equal(left, 2 * right))
    assert ledger.judge(broken).verdict == "undecided"


def test_a_correction_must_be_true() -> None:
    (statement,) = ledger.find(("small-strain-n-mu",))
    worse = dataclasses.replace(statement, correction=equal(sp.Integer(0), m[1]))
    assert ledger.judge(worse).verdict == "undecided"
    kept = dataclasses.replace(statement, correction=statement.printed)
    assert ledger.judge(kept).verdict == "undecided"


def test_a_true_statement_cannot_be_recorded_as_refuted() -> None:
    (statement,) = ledger.find(("const-u-3",))
    claimed = dataclasses.replace(statement, correction=statement.printed)
    assert ledger.judge(claimed).verdict == "undecided"


def test_unknown_ids_and_sections_name_the_nearest() -> None:
    with pytest.raises(ledger.UnknownStatement, match="const-u-mu"):
        ledger.find(("const-u-muu",))
    with pytest.raises(ledger.UnknownStatement, match=r"no section 'x'; known: 1, 2\.1, .*, 5\.2$"):
        ledger.statements("x")
    with pytest.raises(ledger.UnknownStatement, match=r"^there is no statement 'xx'$"):
        ledger.find(("xx",))


def _rows(statements: tuple[Statement, ...], jobs: int) -> list[dict[str, object]]:
    rows = [e.as_row() for e in ledger.check(statements, jobs=jobs)]
    return [{k: x for k, x in row.items() if k != "seconds"} for row in rows]


def test_results_do_not_depend_on_jobs() -> None:
    chosen = ledger.statements("3.1")[8:16]
    assert _rows(chosen, 1) == _rows(chosen, 2)


def test_results_do_not_depend_on_the_hash_seed() -> None:
    code = (
        "from rodproof.derivations import ledger\n"
        "for e in ledger.check(ledger.statements('3.1')[5:14], mutants=True):\n"
        "    print({k: v for k, v in e.as_row().items() if k != 'seconds'})\n"
    )
    runs = [
        subprocess.run(
            [sys.executable, "-c", code], env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True, text=True, check=True,
        ).stdout
        for seed in ("1", "77")
    ]  # fmt: skip
    assert runs[0] == runs[1] and "constants-hypothesis" in runs[0]
