"""How results reach a reader: tables and progress on a terminal, plain text in a pipe, JSON."""

from __future__ import annotations

import json
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rodproof.codegen.generate import Difference
    from rodproof.derivations.records import Evidence

#: Tells that step ``name`` is being done, as number ``done`` of ``total``.
Tell = Callable[[str, int, int], None]

STYLES = {
    "definition": "blue",
    "proved": "green",
    "checked": "cyan",
    "reading": "yellow",
    "refuted": "red",
    "undecided": "bold white on red",
}


def table(columns: Sequence[str], rows: Sequence[Sequence[str]], title: str = "") -> None:
    """A table that nothing is cut from: columns on a terminal, aligned text in a pipe."""
    if not sys.stdout.isatty():
        _plain_table(columns, rows, title)
        return
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    shown = Table(
        title=title or None,
        title_justify="left",
        header_style="bold",
        box=None,
        show_header=any(columns),
    )
    for column in columns:
        shown.add_column(column, overflow="fold")
    for row in rows:
        shown.add_row(*(Text(cell, STYLES.get(cell, "")) for cell in row))
    Console().print(shown)


def _plain_table(columns: Sequence[str], rows: Sequence[Sequence[str]], title: str) -> None:
    widths = [max(len(row[i]) for row in (columns, *rows)) for i in range(len(columns))]
    if title:
        print(title)
    for row in (columns, *rows) if any(columns) else rows:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        print("  ".join(cells).rstrip())


def as_json(value: object) -> None:
    """Indented JSON on standard output."""
    print(json.dumps(value, indent=2, ensure_ascii=False))


@contextmanager
def progress(title: str, *, kept: bool = False) -> Iterator[Tell]:
    """A bar on standard error if that is a terminal; ``kept`` stays, and is a line in a pipe."""
    if not sys.stderr.isatty():
        if kept:
            print(title, file=sys.stderr, flush=True)
        yield _silent
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    look = (
        TextColumn("{task.description:<10}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[step]}"),
    )
    slow = 600.0  # seconds whose pace the time left is estimated by
    with Progress(
        *look, console=Console(stderr=True), transient=not kept, speed_estimate_period=slow
    ) as bars:
        task = bars.add_task(title, total=None, step="")

        def tell(name: str, done: int, total: int) -> None:
            if bars.tasks[0].total is None:  # what was done before does not set the pace
                bars.reset(task, completed=done, total=total)
            bars.update(task, completed=done, total=total, step=name)

        yield tell


def _silent(name: str, done: int, total: int) -> None:
    """Nothing to tell: the output is a pipe."""


def evidence_table(evidence: Sequence[Evidence]) -> None:
    """One line a statement; the mutants where they were tried."""
    tried = any(row.mutants_tried is not None for row in evidence)
    columns = ("id", "label", "verdict", "method", "time", *(("mutants",) if tried else ()))
    table(
        columns,
        [
            (row.id, row.label, row.verdict, row.method, _seconds(row.seconds))
            + ((_mutants(row),) if tried else ())
            for row in evidence
        ],
    )


def _seconds(seconds: float) -> str:
    return f"{seconds:.2f} s"


def _mutants(row: Evidence) -> str:
    if row.mutants_tried is None:
        return "-"
    return f"{row.mutants_killed} of {row.mutants_tried}, {row.mutants_equivalent} equivalent"


def totals(evidence: Sequence[Evidence]) -> str:
    """``9 statements: 7 proved, 2 refuted``."""
    counts = Counter(row.verdict for row in evidence)
    parts = ", ".join(f"{counts[verdict]} {verdict}" for verdict in STYLES if counts[verdict])
    line = f"{len(evidence)} statement{'s' * (len(evidence) != 1)}: {parts or 'none'}"
    tried = [row for row in evidence if row.mutants_tried is not None]
    if tried:
        killed = sum(row.mutants_killed or 0 for row in tried)
        same = sum(row.mutants_equivalent or 0 for row in tried)
        total = sum(row.mutants_tried or 0 for row in tried)
        left = total - killed - same
        line += f"; {total} mutants: {killed} killed, {same} equivalent, {left} survive"
    return line


def story(row: Evidence, steps: Sequence[tuple[str, str, str]] = ()) -> None:
    """Everything that is known of one statement.

    steps: where the derivation settles it, as (label and number, title, rule).
    """
    facts = {
        "statement": f"{row.id} (section {row.section}, {row.label})",
        "claim": row.claim,
        "as printed": row.latex,
        "verdict": row.verdict,
        "method": row.method,
        **{f"derived in {where}": f"{title}. {rule}" for where, title, rule in steps},
        "second route": _route(row),
        "counterexample": row.counterexample,
        "corrected": row.correction_latex,
        "smallest repair": row.repaired_by,
        "reading": row.reading,
        "mutants": _mutants(row) if row.mutants_tried is not None else None,
        "survivors": "; ".join(row.survivors),
        "note": row.note,
        "time": _seconds(row.seconds),
    }
    table(("", ""), [(name, fact) for name, fact in facts.items() if fact])


def _route(row: Evidence) -> str | None:
    if row.route is None:
        return None
    residual = "" if row.residual is None else f", residual {row.residual:.1e}"
    return f"{row.route}: {row.points} points at {row.digits} digits{residual}"


def errata(evidence: Sequence[Evidence]) -> None:
    """What is false in print, then what needs a reading."""
    refuted = [row for row in evidence if row.verdict == "refuted"]
    read = [row for row in evidence if row.verdict == "reading"]
    for row in refuted:
        print(f"{row.id} ({row.label}) is refuted")
        print(f"  printed         {row.latex or row.claim}")
        print(f"  counterexample  {row.counterexample}")
        print(f"  corrected       {row.correction_latex}")
    for row in read:
        print(f"{row.id} ({row.label}) needs a reading")
        print(f"  printed         {row.latex or row.claim}")
        print(f"  reading         {row.reading}")
    print(f"{len(refuted)} refuted, {len(read)} with a reading, of {len(evidence)} statements")


def differences(evidence: Sequence[Evidence], recorded: Mapping[str, str]) -> list[str]:
    """What makes the check fail: a verdict that is not the recorded one, or none."""
    return [
        f"{row.id}: {row.verdict}, recorded as {recorded.get(row.id, 'nothing')}"
        for row in evidence
        if row.verdict == "undecided" or row.verdict != recorded.get(row.id)
    ]


def file_differences(found: Sequence[Difference], json_wanted: bool) -> None:
    """How generated files differ from what the source gives."""
    if json_wanted:
        as_json([asdict(difference) for difference in found])
        return
    for difference in found:
        print(f"generated/{difference.path}: {difference.kind}\n{difference.diff}", end="")
    if not found:
        print("generated/ is what the source gives")
