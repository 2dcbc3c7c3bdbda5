"""From statements to verdicts: the one place where a check becomes evidence.

    statement --decide--> decision --confirm, correct, mutate--> evidence --compare--> ledger

The verdict follows from the decisions alone; the recorded one (verdicts.toml) is only compared.
"""

from __future__ import annotations

import difflib
import importlib
import time
import tomllib
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from functools import cache, partial
from pathlib import Path

from rodproof.derivations import workers
from rodproof.derivations.latex import block
from rodproof.derivations.proof.mutants import mutants as broken_twins
from rodproof.derivations.records import VERDICTS, Confirmation, Decision, Evidence, Statement

#: So many names are listed where none is near the one asked for.
FEW = 30

#: One module a section, in the order of the paper.
SECTIONS: Mapping[str, str] = {
    "1": "section_1",
    "2.1": "section_2_1",
    "2.2": "section_2_2",
    "3.1": "section_3_1",
    "3.2": "section_3_2",
    "3.3": "section_3_3",
    "3.4": "section_3_4",
    "4": "section_4",
    "4.1": "section_4_1",
    "4.2": "section_4_2",
    "4.3": "section_4_3",
    "5.1": "section_5_1",
    "5.2": "section_5_2",
}

#: A second route must agree to this many digits of the 50 it works with.
AGREEMENT = 1e-30

Progress = Callable[[str, int, int], None]


class UnknownStatement(ValueError):
    """An id or section that the paper's inventory does not have; the message has the nearest."""


@cache
def _section(name: str) -> tuple[Statement, ...]:
    module = importlib.import_module(f"rodproof.derivations.printed.{SECTIONS[name]}")
    found: tuple[Statement, ...] = module.statements()
    return found


def statements(section: str | None = None) -> tuple[Statement, ...]:
    """The statements of one section, or all of them in the paper's order."""
    if section is not None and section not in SECTIONS:
        raise UnknownStatement(unknown("section", section, SECTIONS))
    names = SECTIONS if section is None else (section,)
    return tuple(s for name in names for s in _section(name))


@cache
def _index() -> Mapping[str, str]:
    """Statement id -> section, from the recorded verdicts (so that one id loads one section)."""
    data = tomllib.loads((Path(__file__).parent / "verdicts.toml").read_text())
    return {name: section for section, rows in data.items() for name in rows}


def recorded() -> Mapping[str, str]:
    """The recorded verdict of every statement."""
    data = tomllib.loads((Path(__file__).parent / "verdicts.toml").read_text())
    return {name: verdict for rows in data.values() for name, verdict in rows.items()}


def find(ids: Iterable[str]) -> tuple[Statement, ...]:
    """The statements with these ids, in the order asked for.

    Raises UnknownStatement naming the id and the nearest ones.
    """
    found = []
    for name in ids:
        section = _index().get(name)
        if section is None:
            raise UnknownStatement(unknown("statement", name, _index()))
        found += [s for s in _section(section) if s.id == name]
    return tuple(found)


def unknown(kind: str, name: str, known: Iterable[str]) -> str:
    """A sentence on a name that does not exist: the nearest ones, or all if they are few."""
    every = list(known)
    near = difflib.get_close_matches(name, every, n=3, cutoff=0.4)
    hint = f"; nearest: {', '.join(near)}" if near else ""
    if not near and len(every) <= FEW:
        hint = f"; known: {', '.join(every)}"
    return f"there is no {kind} {name!r}{hint}"


def check(
    chosen: Iterable[Statement],
    *,
    mutants: bool = False,
    jobs: int = 1,
    progress: Progress = lambda name, done, total: None,
    scheduler: str | None = None,
    executor: Executor | None = None,
) -> tuple[Evidence, ...]:
    """The evidence on each statement, in order; results do not depend on who computes them.

    mutants: also try the broken twins. jobs, scheduler, executor: see `workers.run`. progress:
    called with (id, done, total) as results arrive.
    """
    todo = tuple(chosen)
    if executor is None and scheduler is None and jobs <= 1:
        tasks = [workers.Task(s.id, partial(judge, s, mutants=mutants)) for s in todo]
    else:
        tasks = [workers.Task(s.id, judge_by_id, (s.id, mutants)) for s in todo]
    found: dict[int, Evidence] = {}
    for index, evidence in workers.run(tasks, jobs=jobs, scheduler=scheduler, executor=executor):
        found[index] = evidence
        progress(evidence.id, len(found), len(todo))
    return tuple(found[index] for index in range(len(todo)))


def judge_by_id(name: str, mutants: bool) -> Evidence:
    """`judge` for another process, where only the id needs to travel."""
    (statement,) = find((name,))
    return judge(statement, mutants=mutants)


def judge(statement: Statement, *, mutants: bool = False) -> Evidence:
    """Decide one statement, confirm it by the second route, correct it if false."""
    started = time.perf_counter()
    printed = statement.check.decide(statement.printed)
    accepted = statement.accepted
    decision = printed if accepted is statement.printed else statement.check.decide(accepted)
    confirmation = statement.check.confirm(accepted) if decision.holds else None
    verdict = _verdict(statement, printed, decision, confirmation)
    tried = _Teeth.of(statement) if mutants else None
    return Evidence(
        id=statement.id,
        section=statement.section,
        label=statement.label,
        verdict=verdict,
        method=decision.method,
        digits=confirmation.digits if confirmation else None,
        points=confirmation.points if confirmation else 0,
        seconds=round(time.perf_counter() - started, 4),
        mutants_tried=tried.tried if tried else None,
        mutants_killed=tried.killed if tried else None,
        mutants_equivalent=tried.equivalent if tried else None,
        counterexample=str(printed.counterexample) if printed.counterexample else None,
        correction_latex=block(statement.correction) if statement.correction else None,
        reading=statement.reading or None,
        claim=statement.claim,
        latex=statement.latex,
        residual=confirmation.residual if confirmation else None,
        route=confirmation.route if confirmation else None,
        note=statement.note,
        survivors=tried.survivors if tried else (),
        repaired_by=tried.repaired_by if tried else None,
    )


def _verdict(
    statement: Statement,
    printed: Decision,
    accepted: Decision,
    confirmation: Confirmation | None,
) -> str:
    """The verdict that the decisions allow; anything short of it is `undecided`."""
    if confirmation is not None and not confirmation.residual < AGREEMENT:
        return "undecided"
    if statement.correction is not None:
        refuted = printed.holds is False and printed.counterexample is not None
        return "refuted" if refuted and accepted.holds and accepted.exact else "undecided"
    if statement.reading:
        return "reading" if accepted.holds and accepted.exact else "undecided"
    if printed.holds is False:
        return "undecided"
    if printed.holds and printed.exact:
        return "definition" if statement.introduces else "proved"
    agrees = confirmation is not None and printed.holds is None and "digits" in printed.method
    return "checked" if agrees else "undecided"


def totals(evidence: Iterable[Evidence]) -> dict[str, object]:
    """Counts per verdict, and what became of all broken twins (None if they were not tried)."""
    rows = tuple(evidence)
    tried = [row for row in rows if row.mutants_tried is not None]
    return {
        "statements": len(rows),
        "verdicts": {v: sum(row.verdict == v for row in rows) for v in VERDICTS},
        "mutants_tried": sum(row.mutants_tried or 0 for row in tried) if tried else None,
        "mutants_killed": sum(row.mutants_killed or 0 for row in tried) if tried else None,
        "mutants_equivalent": sum(row.mutants_equivalent or 0 for row in tried) if tried else None,
        "survivors": {row.id: list(row.survivors) for row in tried if row.survivors},
    }


class _Teeth:
    """What became of the broken twins of the accepted transcription."""

    def __init__(self, tried: int, equivalent: int, survivors: tuple[str, ...]) -> None:
        self.tried, self.equivalent, self.survivors = tried, equivalent, survivors
        self.killed = tried - equivalent - len(survivors)
        self.repaired_by: str | None = None

    @classmethod
    def of(cls, statement: Statement) -> _Teeth:
        equivalent, survivors = 0, []
        twins = broken_twins(statement.accepted)
        for twin in twins:
            found = statement.check.decide(twin.tree, explain=False)
            if found.holds and found.exact:
                equivalent += 1
            elif found.holds is not False:
                survivors.append(twin.change)
        teeth = cls(len(twins), equivalent, tuple(survivors))
        if statement.correction is not None:
            teeth.repaired_by = next(
                (
                    twin.change
                    for twin in broken_twins(statement.printed)
                    if statement.check.decide(twin.tree, explain=False).holds
                ),
                None,
            )
        return teeth
