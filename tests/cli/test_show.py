"""Tables in a pipe: everything is there, aligned, and nothing is cut."""

from __future__ import annotations

import pytest

from rodproof.codegen import show
from rodproof.derivations.records import Evidence


def row(name: str, verdict: str) -> Evidence:
    return Evidence(
        *(name, "3.1", "eq:x", verdict, "exact identity", 50, 3, 0.25),
        *(None, None, None, None, None, None),
    )


def test_a_pipe_gets_aligned_text(capsys: pytest.CaptureFixture[str]) -> None:
    long = "x" * 300
    show.table(("id", "text"), [("a", long), ("long-id", "b")])
    assert capsys.readouterr().out.splitlines() == [
        "id       text",
        f"a        {long}",
        "long-id  b",
    ]


def test_totals_name_only_what_there_is() -> None:
    rows = [row("a", "proved"), row("b", "refuted"), row("c", "proved")]
    assert show.totals(rows) == "3 statements: 2 proved, 1 refuted"
    assert show.totals(rows[:1]) == "1 statement: 1 proved"


def test_what_differs_from_the_record_is_named() -> None:
    rows = [row("a", "proved"), row("b", "proved"), row("c", "undecided"), row("d", "proved")]
    recorded = {"a": "proved", "b": "checked", "c": "undecided"}
    assert show.differences(rows, recorded) == [
        "b: proved, recorded as checked",
        "c: undecided, recorded as undecided",
        "d: proved, recorded as nothing",
    ]


def test_progress_in_a_pipe_is_at_most_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    with show.progress("check") as tell:
        tell("a", 0, 2)
    assert capsys.readouterr() == ("", "")
    with show.progress("measure", kept=True) as tell:
        tell("loads", 0, 2)
        tell("", 2, 2)
    assert capsys.readouterr() == ("", "measure\n")
